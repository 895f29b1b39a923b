// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_CUDA_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_CUDA_H

#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>

#include <string>

namespace CGAL {
namespace Tandem {

namespace internal {

// Whether the library of cuda_api.h is linked.
#ifdef CGAL_TANDEM_USE_CUDA
constexpr bool has_cuda = true;
#else
constexpr bool has_cuda = false;
#endif

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

whether the CUDA back end is linked and there is a device for it. Does not throw.
*/
inline bool cuda_available()
{
  if constexpr(internal::has_cuda)
    return internal::is_cuda_available();
  else
    return false;
}

/*!
\ingroup PkgShapeRegularizationTandemRef

name, memory and compute capability of the device that a call with `Cuda_tag` would use, or why there is none
*/
inline std::string cuda_device_report()
{
  if constexpr(internal::has_cuda)
    return internal::cuda_device_report();
  else
    return "built without CUDA: link Tandem::tandem_cuda";
}

} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_CUDA_H
