// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kernels of loops: they run the functors and bodies of the engine. Each functor or body makes a kernel of its own.
// What it computes does not depend on the numbers of lanes and blocks.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH

#include <CGAL/Tandem/internal/cuda/execution/Cuda_block.cuh>

#include <cub/block/block_reduce.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// Lanes of a block, for items and for cells. For cells, this number is fastest.
constexpr unsigned item_lanes = 256;
constexpr unsigned cell_lanes = 512;

// f(i) for i in [0, n). There may be fewer lanes than items, so a lane takes every stride-th item.
template <class F>
__global__ void __launch_bounds__(item_lanes) run_items(std::size_t n, const F f)
{
  const std::size_t stride = std::size_t(gridDim.x) * blockDim.x;
  for(std::size_t i = std::size_t(blockIdx.x) * blockDim.x + threadIdx.x; i < n; i += stride)
    f(i);
}

constexpr unsigned sum_lanes = 256;

// Adds what f(i, sums) adds for the items of a block to N sums, and writes them to the place of the block.
template <int N, class F>
__global__ void __launch_bounds__(sum_lanes) sum_items(std::size_t n, const F f, std::int64_t* of_block)
{
  std::int64_t sums[N] = {};
  const std::size_t stride = std::size_t(gridDim.x) * sum_lanes;
  for(std::size_t i = std::size_t(blockIdx.x) * sum_lanes + threadIdx.x; i < n; i += stride)
    f(i, sums);
  __shared__ typename cub::BlockReduce<std::int64_t, sum_lanes>::TempStorage memory;
  for(int k = 0; k < N; ++k) {
    const std::int64_t sum = cub::BlockReduce<std::int64_t, sum_lanes>(memory).Sum(sums[k]);
    if(threadIdx.x == 0)
      of_block[blockIdx.x * N + k] = sum;
    __syncthreads(); // the memory is used again
  }
}

// So many blocks run on a multiprocessor at once, if their scratch leaves room; the compiler uses fewer registers for
// that. Bodies wait for memory most of the time, so more blocks are worth it. Growth profits most, since it waits for
// rows of neighbors and for labels.
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ == 750
constexpr unsigned cell_blocks = 2; // it holds 1024 threads, all others 1536 and more
#else
constexpr unsigned cell_blocks = 3;
#endif

// One block for each cell, with its scratch in shared memory. Block b has cell order[b], or cell b if there is no
// order. Blocks begin about in the order of their numbers, so `order` decides which cells are early.
template <class Scratch, class Body>
__global__ void __launch_bounds__(cell_lanes, cell_blocks) run_cells(const std::uint32_t* order, const Body body)
{
  // One type for all bodies: a declaration of shared memory cannot depend on a template parameter.
  extern __shared__ __align__(16) unsigned char memory[];
  Cuda_block<cell_lanes> block;
  body(block, *reinterpret_cast<Scratch*>(memory), order != nullptr ? order[blockIdx.x] : blockIdx.x);
}

// For scratches that are too large for shared memory: each block has one in global memory. There are fewer blocks than
// cells, to bound that memory, so a block works on one cell after the other.
template <class Scratch, class Body>
__global__ void __launch_bounds__(cell_lanes) run_cells_in_turns(std::uint32_t cells, const Body body, Scratch* scratch)
{
  Cuda_block<cell_lanes> block;
  for(std::uint32_t c = blockIdx.x; c < cells; c += gridDim.x)
    body(block, scratch[blockIdx.x], c);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH
