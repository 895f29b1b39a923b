// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes in double: in the coordinates of the grid and in those of the caller. Decisions on points use the integer
// Plane of types.h; these are what is fitted, compared and exported.

#ifndef CGAL_TANDEM_INTERNAL_BASE_PLANES_H
#define CGAL_TANDEM_INTERNAL_BASE_PLANES_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <limits>

namespace CGAL::Tandem::internal {

// The points g with normal . g = offset, in grid steps. The normal is unit.
struct Regular_plane {
  Vector normal;
  double offset;
};

CGAL_TANDEM_HD inline Regular_plane plane_through(const Vector& normal, const Vector& point)
{
  return {normal, dot(normal, point)};
}

// The integer plane for tests of points: through the foot of the perpendicular from the origin.
CGAL_TANDEM_HD inline Plane rounded(const Regular_plane& p) { return make_plane(p.normal, p.offset * p.normal); }

// Bounds, over all points of a box, the change of the distance when a plane moves from a to b. In steps. The
// difference of both distances is linear, so its extremes are at two opposite corners. Signs of normals are ignored. A
// plane a without a normal has never been set: any other one is infinitely far from it.
CGAL_TANDEM_HD inline double bound_motion(const Box& box, const Regular_plane& a, const Regular_plane& b)
{
  if(dot(a.normal, a.normal) == 0)
    return std::numeric_limits<double>::infinity();
  const double sign = dot(a.normal, b.normal) < 0 ? -1 : 1;
  const Vector v = add_scaled(a.normal, -sign, b.normal);
  const double d = fused(sign, b.offset, -a.offset);
  const double low = fused(v.x, v.x > 0 ? box.low[0] : box.high[0],
                           fused(v.y, v.y > 0 ? box.low[1] : box.high[1], v.z * (v.z > 0 ? box.low[2] : box.high[2])));
  const double high = fused(v.x, v.x > 0 ? box.high[0] : box.low[0],
                            fused(v.y, v.y > 0 ? box.high[1] : box.low[1], v.z * (v.z > 0 ? box.high[2] : box.low[2])));
  return (std::max)(std::fabs(low + d), std::fabs(high + d));
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_PLANES_H
