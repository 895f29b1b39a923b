// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All rounds of a label propagation in one kernel, which takes less time than to launch one for each step: see
// propagate_labels.h.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LABEL_PROPAGATION_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_LABEL_PROPAGATION_CUH

#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>

#include <cooperative_groups.h>

#include <algorithm>

namespace CGAL {
namespace Tandem {
namespace internal {

// All blocks run at the same time: they wait for each other after each step.
template <class Rounds>
__global__ void __launch_bounds__(item_lanes) run_steps(std::size_t maximum_rounds, const Rounds rounds)
{
  const cooperative_groups::grid_group grid = cooperative_groups::this_grid();
  const std::size_t items = std::size_t(gridDim.x) * item_lanes;
  const std::size_t i = std::size_t(blockIdx.x) * item_lanes + threadIdx.x;
  for(std::size_t round = 0; round < maximum_rounds; ++round) {
    rounds.accept(round, items)(i);
    grid.sync();
    if(rounds.is_last(round)) // for all of them
      return;
    rounds.propose_again(round, items)(i);
    grid.sync();
  }
}

// Few points join a shape in a round, and the more blocks there are the longer they wait for each other.
constexpr std::size_t points_of_lane = 64;

inline void propagate_labels_cuda(std::size_t maximum_rounds, Label_propagation<Cuda_backend> rounds)
{
  const auto kernel = run_steps<Label_propagation<Cuda_backend>>;
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
