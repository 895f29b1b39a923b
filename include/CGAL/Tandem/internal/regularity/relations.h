// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input and result of the regularity step, as plain data. All lengths are grid steps. Shapes are numbered by their
// position in the input throughout this folder.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/base/tuning/regularity.h>
#include <CGAL/Tandem/internal/base/planes.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// For a given normal, the plane with the least sum of squared distances.
inline Regular_plane through_centroid(const Shape_fit& s, const Vector& n) { return {n, dot(n, s.scatter.centroid)}; }

struct Regularity_options {
  double angle_tolerance_deg = 0; // beta, in [0, 45)
  double maximum_offset = 0;      // sigma, the radius of coplanar classes
  double maximum_distance = 0;    // epsilon
  bool parallelism = true, orthogonality = true, coplanarity = true;
  bool is_last = false; // growth has ended: everything that is rejected is tried again, and leftovers join directions
  // The most misfits by which a shape accepts a relation, whatever their share: in the loop they would grow again as
  // strips beside it. But never less than strip_share of its points.
  double points_of_strips = std::numeric_limits<double>::infinity();
  double strip_share = 0;
  double minimum_size = 0;                   // misfits may not leave less of a shape that has as many points
  std::vector<Vector> fixed_directions = {}; // given beforehand: unit, canonical in sign, all different
  std::vector<Vector> symmetry_axis = {};    // at most one, which is a fixed direction, too

  // Whether `pending` of n shapes, rejected `tries` times, are tried again. That costs as much as for all shapes. So in
  // the loop few of them keep their local planes. Those rejected by points wait as after a rollback.
  bool try_again(std::size_t pending, std::size_t n, int tries) const
  {
    return pending > (is_last || tries == 0 ? 0 : n / tuning::relations::shapes_per_retry);
  }
};

using Regular_planes = std::vector<Regular_plane>;

// direction_of and plane_of index the tables of directions and planes.
struct Relations {
  std::vector<int> direction_of;     // of each shape; shapes that are alone have their own
  std::vector<int> plane_of;         // of each shape; coplanar shapes share one
  std::vector<Vector> directions;    // unit, canonical in sign
  std::vector<Regular_plane> planes; // their normals are the same bits as the directions
  std::vector<char> is_rolled_back;  // by shape: its points rejected a plane, and it keeps its local fit
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H
