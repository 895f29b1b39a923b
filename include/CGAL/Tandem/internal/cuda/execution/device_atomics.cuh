// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CUDA's atomics for the integer types of the engine.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_ATOMICS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_ATOMICS_CUH

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class T>
__device__ T device_add(T& target, T value)
{
  if constexpr(sizeof(T) == 8)
    return T(atomicAdd(reinterpret_cast<unsigned long long*>(&target), static_cast<unsigned long long>(value)));
  else
    return T(atomicAdd(reinterpret_cast<unsigned*>(&target), unsigned(value)));
}

__device__ inline std::uint64_t device_exchange_if(std::uint64_t& target, std::uint64_t expected, std::uint64_t value)
{
  return atomicCAS(reinterpret_cast<unsigned long long*>(&target), static_cast<unsigned long long>(expected),
                   static_cast<unsigned long long>(value));
}

__device__ inline std::uint32_t device_exchange_if(std::uint32_t& target, std::uint32_t expected, std::uint32_t value)
{
  return atomicCAS(&target, expected, value);
}

__device__ inline std::uint64_t device_min(std::uint64_t& target, std::uint64_t value)
{
  return atomicMin(reinterpret_cast<unsigned long long*>(&target), static_cast<unsigned long long>(value));
}

__device__ inline std::uint32_t device_min(std::uint32_t& target, std::uint32_t value)
{
  return atomicMin(&target, value);
}

__device__ inline std::int32_t device_min(std::int32_t& target, std::int32_t value)
{
  return atomicMin(&target, value);
}

__device__ inline void device_max(std::int32_t& target, std::int32_t value) { atomicMax(&target, value); }

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_ATOMICS_CUH
