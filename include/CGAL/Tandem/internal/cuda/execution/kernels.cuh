// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The blocks of CUDA, and the kernels of loops: they run the functors and bodies of the engine. Each functor or body
// makes a kernel of its own. What it computes does not depend on the numbers of lanes and blocks.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH

#include <CGAL/Tandem/internal/base/Moments.h>

#include <cub/block/block_reduce.cuh>

namespace CGAL::Tandem::internal {

// --- The model of Block whose lanes are the threads of a CUDA block. With CUDA's atomic functions, not
// cuda::atomic_ref: that one takes generic addresses where the memory is shared, and kernels with it spill more
// registers.

// The address as those functions take it: of 64 bits, they know only one type.
template <class T>
__device__ auto* atomic_address(T& target)
{
  if constexpr(sizeof(T) == sizeof(unsigned long long))
    return reinterpret_cast<unsigned long long*>(&target);
  else
    return &target;
}

// Each operation begins and ends with a barrier: what lanes have read between two
// operations is not overwritten before all have read it.
template <unsigned Lanes>
struct Cuda_block {
  static constexpr std::uint32_t lookahead = 32;

  template <class F>
  __device__ void for_each(std::uint32_t n, F f)
  {
    __syncthreads();
    in_step(n, f);
    __syncthreads();
  }

  template <class Sum, class F, class Add>
  __device__ void accumulate(std::uint32_t n, F f, Add add)
  {
    __syncthreads();
    Sum sum;
    in_step(n, [&](std::uint32_t i) { f(i, sum); });
    add(sum);
    __syncthreads();
  }

  // A lane takes one neighbor at a time, so that those of a source are read together. It reads the
  // next one before it is done with the last.
  template <class Row, class F>
  __device__ void for_each_neighbor(std::uint32_t n, int k, Row row, F f)
  {
    __syncthreads();
    const std::uint32_t width = std::uint32_t(k);
    std::uint32_t next = threadIdx.x / width, j = threadIdx.x % width, q = no_index;
    const std::uint32_t* neighbors = nullptr;
    const auto read = [&] {
      neighbors = next < n ? row(next) : nullptr;
      q = neighbors != nullptr ? neighbors[j] : no_index;
    };
    read();
    for(std::uint32_t first = 0; first < n * width; first += Lanes) {
      const bool is_visited = neighbors != nullptr;
      const std::uint32_t s = next, neighbor = q;
      next += Lanes / width;
      j += Lanes % width;
      if(j >= width) {
        j -= width;
        ++next;
      }
      read();
      if(is_visited)
        f(s, neighbor);
      __syncwarp();
    }
    __syncthreads();
  }

  // Block by block of items, so that a search that succeeds early ends early. All lanes leave it together.
  template <class F>
  __device__ std::uint32_t find_first(std::uint32_t first, std::uint32_t n, F f)
  {
    __shared__ std::uint32_t found;
    __syncthreads();
    for(std::uint32_t base = first; base < n; base += Lanes) {
      const std::uint32_t i = base + threadIdx.x;
      const bool is_hit = i < n && f(i);
      if(threadIdx.x == 0)
        found = n;
      if(__syncthreads_or(is_hit)) {
        if(is_hit)
          atomicMin(&found, i);
        __syncthreads();
        const std::uint32_t result = found;
        __syncthreads();
        return result;
      }
    }
    return n;
  }

  // The rank of a hit is the number of hits before it: those of earlier items, of earlier warps, of earlier lanes. So
  // the order is that of the items, whatever the lanes do.
  template <class F, class Take>
  __device__ std::uint32_t find(std::uint32_t first, std::uint32_t n, std::uint32_t maximum, F f, Take take)
  {
    __shared__ std::uint32_t hits_of_warp[Lanes / 32];
    const unsigned warp = threadIdx.x / 32, lane = threadIdx.x % 32;
    std::uint32_t size = 0;
    __syncthreads();
    for(std::uint32_t base = first; base < n && size < maximum; base += Lanes) {
      const std::uint32_t i = base + threadIdx.x;
      const unsigned hits = __ballot_sync(0xffffffffu, i < n && f(i));
      if(lane == 0)
        hits_of_warp[warp] = std::uint32_t(__popc(hits));
      __syncthreads();
      std::uint32_t rank = size + std::uint32_t(__popc(hits & ((1u << lane) - 1)));
      for(unsigned w = 0; w < Lanes / 32; ++w) {
        rank += w < warp ? hits_of_warp[w] : 0;
        size += hits_of_warp[w];
      }
      if((hits >> lane & 1) != 0 && rank < maximum)
        take(rank, i);
      __syncthreads();
    }
    return size < maximum ? size : maximum;
  }

  template <class F>
  __device__ void single(F f)
  {
    __syncthreads();
    if(threadIdx.x == 0)
      f();
    __syncthreads();
  }

  // A volatile read: the compiler must not keep the value of an earlier one.
  __device__ std::uint32_t load(const std::uint32_t& target)
  {
    return *static_cast<const volatile std::uint32_t*>(&target);
  }

  __device__ std::uint32_t fetch_min(std::uint32_t& target, std::uint32_t value) { return atomicMin(&target, value); }

  template <class T>
  __device__ void add(T& target, T value)
  {
    atomicAdd(atomic_address(target), value);
  }

  __device__ std::uint32_t append(std::uint32_t& size) { return atomicAdd(&size, 1u); }

  // Reads first: most lanes come too late, and can find that out all at once.
  __device__ std::uint32_t exchange_if(std::uint32_t& target, std::uint32_t expected, std::uint32_t value)
  {
    const std::uint32_t now = load(target);
    return now != expected ? now : atomicCAS(&target, expected, value);
  }

  // A slot is taken once and keeps its value, so a read that finds one needs no exchange.
  template <class T>
  __device__ bool count_pair(std::uint64_t& slot, T& count, std::uint64_t value)
  {
    const std::uint64_t none = ~std::uint64_t(0);
    std::uint64_t owner = *static_cast<const volatile std::uint64_t*>(&slot);
    if(owner == none)
      owner = atomicCAS(atomic_address(slot), none, value);
    if(owner != none && owner != value)
      return false;
    add(count, T(1));
    return true;
  }

  // Lanes of a warp mostly add to the same few shapes. They sum first, since atomics on one address follow each other.
  __device__ void add_moments(Cell_moments& target, Cell_moments m)
  {
    if(!gather_from_peers(&target, m))
      return;
    atomicAdd(atomic_address(target.count), m.count);
    atomicAdd(atomic_address(target.squared_tolerances), m.squared_tolerances);
    for(int i = 0; i < 3; ++i)
      atomicAdd(atomic_address(target.sum[i]), m.sum[i]);
    for(int i = 0; i < 6; ++i)
      atomicAdd(atomic_address(target.product[i]), m.product[i]);
  }

  __device__ void add_box(Box& target, const Box& b)
  {
    for(int a = 0; a < 3; ++a) {
      if(b.low[a] < target.low[a]) // it only ever falls, so an old value does no harm
        atomicMin(&target.low[a], b.low[a]);
      if(b.high[a] > target.high[a])
        atomicMax(&target.high[a], b.high[a]);
    }
  }

private:
  // f(i) for the items of this lane. Where lanes have gone different ways, those of a warp wait for
  // each other after each item: else they go on one by one to the end.
  template <class F>
  __device__ static void in_step(std::uint32_t n, F f)
  {
    for(std::uint32_t first = 0; first < n; first += Lanes) {
      if(first + threadIdx.x < n)
        f(first + threadIdx.x);
      __syncwarp();
    }
  }

  // Of the lanes of a warp with the same target, the first one gets the sum of all, in a
  // tree; false for the others.
  __device__ static bool gather_from_peers(const void* target, Cell_moments& m)
  {
    const unsigned active = __activemask();
    const unsigned lane = threadIdx.x % 32, below = (1u << lane) - 1;
    const unsigned peers = __match_any_sync(active, reinterpret_cast<unsigned long long>(target));
    unsigned rank = __popc(peers & below);
    const bool is_first = rank == 0;
    for(unsigned above = peers & ~below & ~(1u << lane); __any_sync(active, above); rank /= 2) {
      const int next = above != 0 ? __ffs(int(above)) - 1 : int(lane);
      add_from_lane(active, next, above != 0, m);
      above &= __ballot_sync(active, rank % 2 == 0);
    }
    return is_first;
  }

  __device__ static void add_from_lane(unsigned active, int lane, bool is_added, Cell_moments& m)
  {
    const auto add = [&](std::int64_t& value) {
      const std::int64_t other = __shfl_sync(active, static_cast<long long>(value), lane);
      value += is_added ? other : 0;
    };
    add(m.count);
    add(m.squared_tolerances);
    for(std::int64_t& value : m.sum)
      add(value);
    for(std::int64_t& value : m.product)
      add(value);
  }
};

// --- The kernels.

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

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_KERNELS_CUH
