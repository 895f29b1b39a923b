// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Batcher's odd-even merge sort of an array in registers: all indices are constants of the compilation. The compiler
// removes the comparisons of results that are not used.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_SORTING_NETWORK_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_SORTING_NETWORK_CUH

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// Puts the smaller of two numbers first.
__device__ __forceinline__ void order(std::uint32_t& a, std::uint32_t& b)
{
  const std::uint32_t smaller = min(a, b);
  b = max(a, b);
  a = smaller;
}

// Merges the sorted halves of every Step-th entry of a[First .. First + Size).
template <int First, int Size, int Step, int N>
__device__ __forceinline__ void merge_odd_even(std::uint32_t (&a)[N])
{
  if constexpr(2 * Step < Size) {
    merge_odd_even<First, Size, 2 * Step>(a);
    merge_odd_even<First + Step, Size, 2 * Step>(a);
#pragma unroll
    for(int i = First + Step; i + Step < First + Size; i += 2 * Step)
      order(a[i], a[i + Step]);
  } else {
    order(a[First], a[First + Step]);
  }
}

// Sorts a[First .. First + Size); Size is a power of two.
template <int First, int Size, int N>
__device__ __forceinline__ void sort_odd_even(std::uint32_t (&a)[N])
{
  if constexpr(Size > 1) {
    sort_odd_even<First, Size / 2>(a);
    sort_odd_even<First + Size / 2, Size / 2>(a);
    merge_odd_even<First, Size, 1>(a);
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_SORTING_NETWORK_CUH
