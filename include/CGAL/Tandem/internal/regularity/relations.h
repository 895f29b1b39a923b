// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input and result of the regularity step, as plain data. All lengths are grid steps. Shapes are numbered by their
// position in the input throughout this folder.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/planes.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/base/tuning/regularity.h>
#include <CGAL/Tandem/internal/score/Score.h>

#include <vector>

namespace CGAL::Tandem::internal {

// --- Directions are unit normals without orientation: their signs, distances and rounding.

// The one of n and -n whose last nonzero coordinate is positive. Adding 0 removes negative zeros, so that equal
// directions have equal bits.
inline Vector canonical(const Vector& n)
{
  const bool is_opposite = n.z < 0 || (n.z == 0 && (n.y < 0 || (n.y == 0 && n.x < 0)));
  const Vector m = is_opposite ? -n : n;
  return {m.x + 0.0, m.y + 0.0, m.z + 0.0};
}

// The squared sine of the angle of two unit vectors.
inline double squared_sine(const Vector& a, const Vector& b)
{
  const Vector c = cross(a, b);
  return dot(c, c);
}

// --- The relations.

struct Regularity_parameters {
  double angle_tolerance_deg = 0;    // beta, in [0, 45)
  double maximum_offset_steps = 0;   // sigma, the largest offset of planes that become one
  double maximum_distance_steps = 0; // epsilon
  bool parallelism = true, orthogonality = true, coplanarity = true;
  Freedom_worth freedom = {};                // if two become one, the lower price is saved
  Freedom_worth given_freedom = {};          // the same, if a fixed direction takes it: at least as much
  std::vector<Vector> fixed_directions = {}; // given beforehand: unit, canonical in sign, all different
  std::vector<Vector> symmetry_axis = {};    // at most one, which is a fixed direction, too

  // What a degree of freedom is worth, by the points of the largest shape that has it: a sum of squared distances
  // (steps^2) that it may cost. An fma, so that no compiler contracts the product with a sum that it enters.
  double price(double points, bool is_given = false) const
  {
    const Freedom_worth& worth = is_given ? given_freedom : freedom;
    return fused(maximum_distance_steps * maximum_distance_steps, worth.of(points), 0.);
  }

  // That of the two degrees of freedom of a direction.
  double direction_price(double points, bool is_given = false) const { return 2 * price(points, is_given); }
};

using Regular_planes = std::vector<Regular_plane>;

// direction_of and plane_of index the tables of directions and planes.
struct Relations {
  std::vector<int> direction_of;     // of each shape; shapes that are alone have their own
  std::vector<int> plane_of;         // of each shape; coplanar shapes share one
  std::vector<Vector> directions;    // unit, canonical in sign
  std::vector<Regular_plane> planes; // their normals are the same bits as the directions
  std::vector<char> is_rolled_back;  // by shape: a direction is near, but costs its points too much
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H
