// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_CUDA_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_CUDA_H

#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>

#include <string>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

returns whether the CUDA back end is linked and there is a device for it. Does not throw.
*/
inline bool cuda_available()
{
#ifdef CGAL_TANDEM_USE_CUDA
  return internal::is_cuda_available();
#else
  return false;
#endif
}

/*!
\ingroup PkgShapeRegularizationTandemRef

returns a text with the name, memory and compute capability of the device that a call with `Cuda_tag` would use, or with
the reason why there is none
*/
inline std::string cuda_device_report()
{
#ifdef CGAL_TANDEM_USE_CUDA
  return internal::cuda_device_report();
#else
  return "built without CUDA: link Tandem::tandem_cuda";
#endif
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_CUDA_H
