// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last step that decides on single points: each one is checked against the
// final plane of its shape, in double and in the caller's coordinates. It is
// filtered: the integer test decides all but the points close to a bound.

#ifndef CGAL_TANDEM_INTERNAL_EXACT_CHECK_H
#define CGAL_TANDEM_INTERNAL_EXACT_CHECK_H

#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/Shapes.h>

#include <array>

namespace CGAL {
namespace Tandem {
namespace internal {

using Coefficients = std::array<double, 4>; // a x + b y + c z + d = 0, of unit normal

// The caller's points and, if there are any, unit normals: 3 doubles each.
struct Caller_view {
  const double* coordinates;
  const double* normals;
};

inline Coefficients to_caller(const Regular_plane& p, const Grid& grid)
{
  return {p.normal.x, p.normal.y, p.normal.z, -std::fma(grid.step, p.offset, dot(p.normal, grid.origin))};
}

// The vector that a packed normal stands for: of unit length, rounded to float,
// so that it can be written to a file as it was used. Null if there is none.
inline std::array<double, 3> unpacked_normal(std::uint32_t code)
{
  const Int_vector m = decode_normal(code);
  const Vector n = unit({double(m.x), double(m.y), double(m.z)});
  return {double(float(n.x)), double(float(n.y)), double(float(n.z))};
}

struct Exact_bounds {
  double maximum_distance;
  double cosine; // of maximum_angle, raised by what a normal may lose when it is rounded to float

  // True only if every order of evaluation in double finds the point within epsilon.
  bool is_near(const Coefficients& c, const double* p) const
  {
    const double x = c[0] * p[0], y = c[1] * p[1], z = c[2] * p[2];
    const double size = std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(c[3]);
    const double e = std::fma(c[0], p[0], std::fma(c[1], p[1], std::fma(c[2], p[2], c[3])));
    return std::fma(size, 1e-15, std::fabs(e)) <= maximum_distance;
  }

  bool is_aligned(const Coefficients& c, const double* n) const
  {
    return std::fabs(std::fma(c[0], n[0], std::fma(c[1], n[1], c[2] * n[2]))) >= cosine;
  }
};

constexpr double rounded_normal_margin = 2e-7;

// Frees the points that are not within the bounds of their shape.
struct Check_exactly {
  const Grid_point* point;
  const std::uint32_t* origin; // imported point of each sorted one
  Caller_view caller;
  std::uint32_t* label;
  const Plane* plane; // by shape, as are these
  const Coefficients* coefficients;
  Tolerance certain; // the bounds of the engine, less all rounding
  Exact_bounds bounds;

  void operator()(std::size_t i) const
  {
    const std::uint32_t s = label[i];
    if(s >= first_mark || fits(plane[s], point[i], certain))
      return;
    const std::size_t at = 3 * std::size_t(origin[i]);
    const std::array<double, 3> packed = unpacked_normal(point[i].normal);
    const double* normal = caller.normals != nullptr ? caller.normals + at : packed.data();
    if(!bounds.is_near(coefficients[s], caller.coordinates + at) || !bounds.is_aligned(coefficients[s], normal))
      label[i] = is_locked;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_EXACT_CHECK_H
