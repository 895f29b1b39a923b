// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rounds of steps in one kernel: launches and waits between the steps would take longer.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_ROUNDS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_ROUNDS_CUH

#include <CGAL/Tandem/internal/cuda/execution/kernels.cuh>
#include <CGAL/Tandem/internal/cuda/execution/warp.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>

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
  const std::size_t lanes = std::size_t(gridDim.x) * item_lanes;
  const std::size_t lane = std::size_t(blockIdx.x) * item_lanes + threadIdx.x;
  for(std::size_t round = 0; round < maximum_rounds; ++round)
    for(int step = 0; step < Rounds::steps; ++step) {
      if(step + 1 == Rounds::steps && rounds.is_last(round))
        return;
      rounds.run(step, round, lane, lanes);
      if(gridDim.x == 1)
        __syncthreads(); // takes less time
      else
        grid.sync();
    }
}

// A warp for each item, since some take long; but not more blocks than run at the same time, else the barrier would
// never be passed. It takes hardly longer with more blocks.
template <class Rounds>
void launch_rounds(std::size_t maximum_rounds, std::size_t items, Rounds rounds)
{
  const auto kernel = run_steps<Rounds>;
  int multiprocessors = 0, blocks = 0; // on each of them at the same time
  CGAL_TANDEM_CUDA(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, current_device()));
  CGAL_TANDEM_CUDA(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, int(item_lanes), 0));
  const std::size_t maximum = std::size_t(multiprocessors) * std::size_t(blocks);
  const std::size_t useful = items / (item_lanes / warp_size) + 1;
  void* arguments[] = {&maximum_rounds, &rounds};
  ++Device_work::of_thread().launches;
  CGAL_TANDEM_CUDA(cudaLaunchCooperativeKernel(kernel, dim3(unsigned((std::min)(maximum, useful))), dim3(item_lanes),
                                               arguments, 0, stream_of_thread()));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_ROUNDS_CUH
