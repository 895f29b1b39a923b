// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calls of CUB: temporary memory is of the pool, and work is in the order of the stream of the thread.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUB_CALLS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUB_CALLS_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>

#include <cub/device/device_radix_sort.cuh>

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// call(memory, bytes) runs twice. With a null pointer it only computes how many bytes it needs. One byte more is
// allocated, since a null pointer would mean the same in the second call.
template <class Call>
void with_cub_memory(Call call)
{
  std::size_t bytes = 0;
  CGAL_TANDEM_CUDA(call(nullptr, bytes));
  Device_buffer<unsigned char> memory(bytes + 1);
  ++Device_work::of_thread().launches;
  CGAL_TANDEM_CUDA(call(memory.data(), bytes));
}

// Sorts pairs by the lower `bits` of their keys, with ties in their former order. The buffers that are current
// afterwards are sorted; the alternate ones have no defined contents.
template <class Key>
void sort_pairs(cub::DoubleBuffer<Key>& keys, cub::DoubleBuffer<std::uint32_t>& values, std::size_t n, int bits)
{
  with_cub_memory([&](void* memory, std::size_t& bytes) {
    return cub::DeviceRadixSort::SortPairs(memory, bytes, keys, values, std::int64_t(n), 0, bits, stream_of_thread());
  });
}

// f.has() as a predicate for CUB.
template <class F>
struct Has_item {
  F f;

  __device__ bool operator()(std::uint32_t i) const { return f.has(i); }
};

template <class T, class F>
struct Take_item {
  F f;
  const std::uint32_t* found;
  T* item;

  __device__ void operator()(std::size_t i) const { item[i] = f.take(found[i]); }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUB_CALLS_CUH
