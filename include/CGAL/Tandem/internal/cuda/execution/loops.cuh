// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One kernel for several small loops, one after the other: see Loop_queue.cuh. It calls their functions by address.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_LOOPS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_LOOPS_CUH

#include <CGAL/Tandem/internal/cuda/execution/kernels.cuh>
#include <CGAL/Tandem/internal/cuda/execution/warp.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/Loop_queue.cuh>

#include <cooperative_groups.h>

#include <algorithm>
#include <atomic>

namespace CGAL::Tandem::internal {

// A lane among those of a loop. Whole warps work on a loop.
struct Loop_lane {
  std::uint32_t number, lanes;

  __device__ std::uint32_t warp() const { return number / warp_size; }
  __device__ std::uint32_t warps() const { return lanes / warp_size; }
  __device__ std::uint32_t in_warp() const { return number % warp_size; }
};

using Loop_function = void (*)(const void* loop, std::uint32_t n, Loop_lane lane);

// The kernel and the functions that it calls are of one library, which has set aside registers for them: if several
// libraries are linked, each has its own.
namespace {

// Loops have loop(n, lane). A copy, since what a loop writes could be the functor for all that the compiler knows.
template <class Loop>
__device__ void run_loop(const void* loop, std::uint32_t n, Loop_lane lane)
{
  const Loop own = *static_cast<const Loop*>(loop);
  own(n, lane);
}

template <class Loop>
__device__ Loop_function function_of_loop = run_loop<Loop>;

// The address on the current device, which is asked for it once. 0 if it has not been asked.
template <class Loop>
std::uint64_t address_of_loop()
{
  constexpr int devices = 64; // others are asked each time
  static std::atomic<std::uint64_t> known[devices];
  const int device = current_device();
  std::uint64_t address = device < devices ? known[device].load(std::memory_order_relaxed) : 0;
  if(address != 0)
    return address;
  CGAL_TANDEM_CUDA(cudaMemcpyFromSymbolAsync(&address, function_of_loop<Loop>, sizeof(address), 0,
                                             cudaMemcpyDeviceToHost, stream_of_thread()));
  wait_for_stream();
  if(device < devices)
    known[device].store(address, std::memory_order_relaxed);
  return address;
}

template <std::size_t Bytes>
struct Loops {
  std::uint32_t bytes;
  alignas(Loop_queue::alignment) unsigned char memory[Bytes];
};

// A barrier after each loop; it also makes its writes visible to all lanes. With several blocks it needs a cooperative
// launch. Warps take turns among the blocks, so that few items are spread over many multiprocessors.
template <std::size_t Bytes>
__global__ void __launch_bounds__(item_lanes) run_loops(const __grid_constant__ Loops<Bytes> loops)
{
  __shared__ uint4 memory[Bytes / sizeof(uint4)];
  for(unsigned i = threadIdx.x; i * sizeof(uint4) < loops.bytes; i += item_lanes)
    memory[i] = reinterpret_cast<const uint4*>(loops.memory)[i];
  __syncthreads();
  const unsigned warp = threadIdx.x / warp_size * gridDim.x + blockIdx.x;
  const Loop_lane lane = {warp * warp_size + threadIdx.x % warp_size, gridDim.x * item_lanes};
  for(std::uint32_t at = 0; at < loops.bytes;) {
    const auto* const header = reinterpret_cast<const Loop_header*>(reinterpret_cast<const char*>(memory) + at);
    reinterpret_cast<Loop_function>(header->function)(header + 1, header->items, lane);
    at += header->bytes;
    if(at >= loops.bytes)
      break;
    if(gridDim.x == 1)
      __syncthreads();
    else
      cooperative_groups::this_grid().sync();
  }
}

// A block has a multiprocessor of its own, whatever registers the loops need.
template <std::size_t Bytes>
void launch_loops_of_size(const unsigned char* loops, std::size_t bytes, unsigned blocks)
{
  Loops<Bytes> list;
  list.bytes = std::uint32_t(bytes);
  std::memcpy(list.memory, loops, bytes);
  if(blocks == 1) {
    run_loops<Bytes><<<1, item_lanes, 0, cudaStreamPerThread>>>(list);
    CGAL_TANDEM_CUDA_LAUNCHED();
    return;
  }
  ++Device_work::of_thread().launches;
  void* arguments[] = {&list};
  CGAL_TANDEM_CUDA(
    cudaLaunchCooperativeKernel(run_loops<Bytes>, dim3(blocks), dim3(item_lanes), arguments, 0, cudaStreamPerThread));
}

constexpr std::size_t maximum_loop_blocks = 128;

inline void launch_loops(const unsigned char* loops, std::size_t bytes, std::size_t lanes)
{
  const unsigned blocks =
    unsigned((std::min)({(lanes + item_lanes - 1) / item_lanes, number_of_multiprocessors(), maximum_loop_blocks}));
  if(bytes <= 512)
    launch_loops_of_size<512>(loops, bytes, blocks);
  else
    launch_loops_of_size<Loop_queue::maximum_bytes>(loops, bytes, blocks);
}

} // namespace

// --- The loops.

// f(i) for i in [0, n).
template <class F>
struct Item_loop {
  F f;

  __device__ void operator()(std::uint32_t n, Loop_lane lane) const
  {
    for(std::uint32_t i = lane.number; i < n; i += lane.lanes)
      f(std::size_t(i));
  }
};

// Adds what f(i, sums) adds to N sums, of each warp that has items: sums[N * warp] ... in memory of the host.
template <int N, class F>
struct Sum_loop {
  F f;
  std::int64_t* of_warp;

  __device__ void operator()(std::uint32_t n, Loop_lane lane) const
  {
    if(lane.warp() * warp_size >= n)
      return;
    std::int64_t sums[N] = {};
    for(std::uint32_t i = lane.number; i < n; i += lane.lanes)
      f(std::size_t(i), sums);
    __syncwarp();
    for(int k = 0; k < N; ++k) {
      const std::int64_t sum = warp_reduce(sums[k], cooperative_groups::plus<std::int64_t>());
      if(lane.in_warp() == 0)
        of_warp[lane.warp() * N + k] = sum;
    }
  }
};

// A selection has two loops: one that tests the items, a bit for each, and one that puts those that are kept in a list.
template <class F>
struct Test_loop {
  F is_kept;
  std::uint32_t* kept; // by 32 items

  __device__ void operator()(std::uint32_t n, Loop_lane lane) const
  {
    for(std::uint32_t w = lane.warp(); w * warp_size < n; w += lane.warps()) {
      const std::uint32_t i = w * warp_size + lane.in_warp();
      const unsigned bits = __ballot_sync(all_lanes, i < n && is_kept(i));
      if(lane.in_warp() == 0)
        kept[w] = bits;
    }
  }
};

// Each warp counts the bits before its own. The size goes to memory of the host.
struct List_loop {
  const std::uint32_t* kept;
  std::uint32_t* list;
  std::int64_t* size;

  __device__ void operator()(std::uint32_t n, Loop_lane lane) const
  {
    const std::uint32_t words = (n + warp_size - 1) / warp_size;
    for(std::uint32_t w = lane.warp(); w < words; w += lane.warps()) {
      std::uint32_t own = 0;
      for(std::uint32_t j = lane.in_warp(); j < w; j += warp_size)
        own += __popc(kept[j]);
      const std::uint32_t before = warp_sum(own), bits = kept[w];
      if(bits >> lane.in_warp() & 1u)
        list[before + __popc(bits & ((1u << lane.in_warp()) - 1))] = w * warp_size + lane.in_warp();
      if(w + 1 == words && lane.in_warp() == 0)
        *size = before + __popc(bits);
    }
  }
};

// Words, from or to memory of the host.
struct Copy_loop {
  const std::uint32_t* source;
  std::uint32_t* target;

  __device__ void operator()(std::uint32_t n, Loop_lane lane) const
  {
    for(std::uint32_t i = lane.number; i < n; i += lane.lanes)
      target[i] = source[i];
  }
};

// Of the first items of which only the device knows how many there are, each of so many words. The number goes to memory
// of the host, too.
struct Copy_first_loop {
  Copy_loop copy;
  const std::int64_t* number;
  std::size_t words;
  std::int64_t* size;

  __device__ void operator()(std::uint32_t n, Loop_lane lane) const
  {
    const std::size_t all = std::size_t(*number) * words;
    copy(all < n ? std::uint32_t(all) : n, lane);
    if(lane.number == 0)
      *size = *number;
  }
};

// --- Their queue.

// A loop of n items, with work for so many lanes.
template <class Loop>
void queue_loop(std::size_t n, std::size_t lanes, const Loop& loop)
{
  const std::uint64_t address = address_of_loop<Loop>();
  Loop_queue::of_thread().add(address, n, lanes, loop, launch_loops);
}

// One of both is pinned memory.
template <class T>
void queue_copy(const T* source, std::size_t n, T* target)
{
  const std::size_t words = n * sizeof(T) / sizeof(std::uint32_t);
  queue_loop(words, words,
             Copy_loop{reinterpret_cast<const std::uint32_t*>(source), reinterpret_cast<std::uint32_t*>(target)});
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_LOOPS_CUH
