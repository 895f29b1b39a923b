// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kernels: they run the functors and bodies of the engine.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH

#include <CGAL/Tandem/internal/cuda/execution/Cuda_block.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr unsigned item_lanes = 256;
constexpr unsigned cell_lanes = 512;

template <class F>
__global__ void __launch_bounds__(item_lanes) run_items(std::size_t n, const F f)
{
  const std::size_t stride = std::size_t(gridDim.x) * item_lanes;
  for(std::size_t i = std::size_t(blockIdx.x) * item_lanes + threadIdx.x; i < n; i += stride)
    f(i);
}

// So many blocks run on a multiprocessor at once, if their scratch leaves room: bodies wait for
// memory most of the time, which is worse than the few registers that they have to give up.
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ == 750
constexpr unsigned cell_blocks = 2; // it holds 1024 threads, all others 1536 and more
#else
constexpr unsigned cell_blocks = 3;
#endif

// One block for each cell, its scratch in shared memory. In an order, or if that is null as they are numbered.
template <class Scratch, class Body>
__global__ void __launch_bounds__(cell_lanes, cell_blocks) run_cells(const std::uint32_t* order, const Body body)
{
  extern __shared__ __align__(16) unsigned char memory[];
  Cuda_block<cell_lanes> block;
  body(block, *reinterpret_cast<Scratch*>(memory), order != nullptr ? order[blockIdx.x] : blockIdx.x);
}

// A few blocks take turns with the cells: each has a scratch in global memory,
// because it is too large for the shared one.
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
