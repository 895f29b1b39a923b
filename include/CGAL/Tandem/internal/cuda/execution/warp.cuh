// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the lanes of a warp do together. All 32 take part in every call.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_WARP_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_WARP_CUH

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr unsigned warp_size = 32;
constexpr unsigned all_lanes = 0xffffffffu;

// One instruction from compute capability 8.0 on.
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800

__device__ inline int warp_min(int v) { return __reduce_min_sync(all_lanes, v); }
__device__ inline int warp_max(int v) { return __reduce_max_sync(all_lanes, v); }
__device__ inline unsigned warp_min(unsigned v) { return __reduce_min_sync(all_lanes, v); }
__device__ inline unsigned warp_max(unsigned v) { return __reduce_max_sync(all_lanes, v); }
__device__ inline unsigned warp_sum(unsigned v) { return __reduce_add_sync(all_lanes, v); }

#else

template <class T>
__device__ inline T warp_min(T v)
{
  for(int o = 16; o > 0; o /= 2) {
    const T other = __shfl_xor_sync(all_lanes, v, o);
    v = other < v ? other : v;
  }
  return v;
}

template <class T>
__device__ inline T warp_max(T v)
{
  for(int o = 16; o > 0; o /= 2) {
    const T other = __shfl_xor_sync(all_lanes, v, o);
    v = v < other ? other : v;
  }
  return v;
}

__device__ inline unsigned warp_sum(unsigned v)
{
  for(int o = 16; o > 0; o /= 2)
    v += __shfl_xor_sync(all_lanes, v, o);
  return v;
}

#endif

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_WARP_CUH
