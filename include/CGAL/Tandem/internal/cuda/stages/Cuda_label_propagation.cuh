// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All rounds of a label propagation in one kernel: launches and waits between the steps would take longer. The functors
// are those of propagate_labels.h, so labels are the same as on the host.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LABEL_PROPAGATION_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LABEL_PROPAGATION_CUH

#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>

#include <cooperative_groups.h>

#include <algorithm>

namespace CGAL {
namespace Tandem {
namespace internal {

// A cooperative launch: all blocks run at the same time, and wait for each other after each step. A barrier also makes
// the writes of a step visible to all blocks. All lanes leave in the same round, since they read the same numbers.
template <class Rounds>
__global__ void __launch_bounds__(item_lanes) run_steps(std::size_t maximum_rounds, const Rounds rounds)
{
  const cooperative_groups::grid_group grid = cooperative_groups::this_grid();
  const std::size_t items = std::size_t(gridDim.x) * item_lanes;
  const std::size_t i = std::size_t(blockIdx.x) * item_lanes + threadIdx.x;
  for(std::size_t round = 0; round < maximum_rounds; ++round) {
    rounds.accept(round, items)(i);
    grid.sync();
    if(rounds.is_last(round))
      return;
    rounds.propose_again(round, items)(i);
    grid.sync();
  }
}

// Few blocks for many points: grid barriers get slower with more blocks, and few points change in a round.
constexpr std::size_t points_of_lane = 64;

// Launches the kernel and does not wait. The grid must fit on the device as a whole, else the barrier would never be
// passed.
inline void propagate_labels_cuda(std::size_t maximum_rounds, Label_propagation<Cuda_backend> rounds)
{
  const auto kernel = run_steps<Label_propagation<Cuda_backend>>;
  // As many blocks as are useful, but at most those that run at the same time.
  int multiprocessors = 0, blocks = 0; // on each of them at the same time
  CGAL_TANDEM_CUDA(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, current_device()));
  CGAL_TANDEM_CUDA(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, int(item_lanes), 0));
  const std::size_t maximum = std::size_t(multiprocessors) * std::size_t(blocks);
  const std::size_t useful = rounds.proposal.cloud.size / (item_lanes * points_of_lane) + 1;
  Table_arena::of_thread().flush();
  void* arguments[] = {&maximum_rounds, &rounds};
  CGAL_TANDEM_CUDA(cudaLaunchCooperativeKernel(kernel, dim3(unsigned((std::min)(maximum, useful))), dim3(item_lanes),
                                               arguments, 0, stream_of_thread()));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LABEL_PROPAGATION_CUH
