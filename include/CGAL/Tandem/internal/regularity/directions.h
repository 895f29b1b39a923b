// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directions are unit normals without orientation: their signs, distances and rounding.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTIONS_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The one of n and -n whose last nonzero coordinate is positive. Adding 0 removes negative zeros, so that equal
// directions have equal bits.
inline Vector canonical(const Vector& n)
{
  const bool is_opposite = n.z < 0 || (n.z == 0 && (n.y < 0 || (n.y == 0 && n.x < 0)));
  const Vector m = is_opposite ? -n : n;
  return {m.x + 0.0, m.y + 0.0, m.z + 0.0};
}

// A normal on a grid of 2^-24, which is less than 4e-6 degrees. Products of coordinates and of their differences are
// exact then. So contraction cannot change a sum, and no std::fma is needed: a call on plain x86-64.
inline Vector rounded_normal(const Vector& n)
{
  const double scale = double(1 << 24);
  return {double(llrint(n.x * scale)) / scale, double(llrint(n.y * scale)) / scale,
          double(llrint(n.z * scale)) / scale};
}

inline double rounded_dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// The squared sine of the angle of two unit vectors.
inline double squared_sine(const Vector& a, const Vector& b)
{
  const Vector c = cross(a, b);
  return dot(c, c);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_DIRECTIONS_H
