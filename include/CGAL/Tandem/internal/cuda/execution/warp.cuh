// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the lanes of a warp do together. All 32 take part in every call.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_WARP_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_WARP_CUH

#include <cooperative_groups.h>
#include <cooperative_groups/reduce.h>

namespace CGAL::Tandem::internal {

constexpr unsigned warp_size = 32;
constexpr unsigned all_lanes = 0xffffffffu;

template <class T, class Operation>
__device__ inline T warp_reduce(T v, Operation operation)
{
  namespace cg = cooperative_groups;
  return cg::reduce(cg::tiled_partition<warp_size>(cg::this_thread_block()), v, operation);
}

template <class T>
__device__ inline T warp_min(T v)
{
  return warp_reduce(v, cooperative_groups::less<T>());
}

template <class T>
__device__ inline T warp_max(T v)
{
  return warp_reduce(v, cooperative_groups::greater<T>());
}

__device__ inline unsigned warp_sum(unsigned v) { return warp_reduce(v, cooperative_groups::plus<unsigned>()); }

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_WARP_CUH
