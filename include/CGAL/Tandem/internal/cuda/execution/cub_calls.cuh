// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUB_CALLS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUB_CALLS_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Device_buffer.cuh>

#include <cub/device/device_radix_sort.cuh>

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// Algorithms of CUB are called twice: how much memory they need, then with it.
template <class Call>
void with_cub_memory(Call call)
{
  std::size_t bytes = 0;
  CGAL_TANDEM_CUDA(call(nullptr, bytes));
  Device_buffer<unsigned char> memory(bytes + 1);
  CGAL_TANDEM_CUDA(call(memory.data(), bytes));
}

// So many bits hold the numbers up to this one.
inline int bits_of(std::size_t largest)
{
  int bits = 1;
  while(largest >> bits)
    ++bits;
  return bits;
}

// Stable, by the lower bits of the keys; what is current afterwards is sorted.
template <class Key>
void sort_pairs(cub::DoubleBuffer<Key>& keys, cub::DoubleBuffer<std::uint32_t>& values, std::size_t n, int bits)
{
  with_cub_memory([&](void* memory, std::size_t& bytes) {
    return cub::DeviceRadixSort::SortPairs(memory, bytes, keys, values, std::int64_t(n), 0, bits, stream_of_thread());
  });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_CUB_CALLS_CUH
