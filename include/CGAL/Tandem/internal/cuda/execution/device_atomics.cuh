// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CUDA's atomic functions, not cuda::atomic_ref: that one takes generic addresses
// where the memory is shared, and kernels with it spill more registers.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_ATOMICS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_ATOMICS_CUH

namespace CGAL {
namespace Tandem {
namespace internal {

// The address as those functions take it: of 64 bits, they know only one type.
template <class T>
__device__ auto* atomic_address(T& target)
{
  if constexpr(sizeof(T) == sizeof(unsigned long long))
    return reinterpret_cast<unsigned long long*>(&target);
  else
    return &target;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_EXECUTION_DEVICE_ATOMICS_CUH
