// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_UPWARD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_UPWARD_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace CGAL {
namespace Tandem {
namespace internal {

// The direction upward, of length 1.
template <class Vector_3>
Vector upward(const Vector_3& v)
{
  const double c[3] = {CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z())};
  const double largest = (std::max)({std::fabs(c[0]), std::fabs(c[1]), std::fabs(c[2])});
  if(!(largest > 0) || !std::all_of(c, c + 3, [](double x) { return std::isfinite(x); }))
    throw std::invalid_argument("symmetry_direction must be a vector of positive, finite length.");
  const double x = c[0] / largest, y = c[1] / largest, z = c[2] / largest;
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_UPWARD_H
