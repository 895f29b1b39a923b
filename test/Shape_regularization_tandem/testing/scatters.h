// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scatter matrices that are sums of squares of vectors.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCATTERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCATTERS_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// s v v^T
inline Symmetric_matrix square(double s, const Vector& v)
{
  return {s * v.x * v.x, s * v.x * v.y, s * v.x * v.z, s * v.y * v.y, s * v.y * v.z, s * v.z * v.z};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCATTERS_H
