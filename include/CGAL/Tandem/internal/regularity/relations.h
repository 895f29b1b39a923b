// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input and result of the regularity step, as plain data. All lengths are grid steps. Shapes are numbered by their
// position in the input throughout this folder.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/base/planes.h>
#include <CGAL/Tandem/internal/memory/Unset_vector.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A shape: its moments and its local least-squares plane, which passes through the centroid and has a unit normal.
struct Shape_fit {
  Scatter scatter;
  Fit fit;
};

using Shape_fits = Unset_vector<Shape_fit>;

// For a given normal, the plane with the least sum of squared distances.
inline Regular_plane through_centroid(const Shape_fit& s, const Vector& n) { return {n, dot(n, s.scatter.centroid)}; }

struct Regularity_options {
  double angle_tolerance_deg; // beta, in [0, 45)
  double maximum_offset;      // sigma, the radius of coplanar classes
  double maximum_distance;    // epsilon
  bool parallelism, orthogonality, coplanarity;
  bool is_last; // growth has ended: everything that is rejected is tried again, and leftovers join directions

  // Whether `pending` of n shapes, rejected `tries` times, are tried again. That costs as much as for all shapes. So in
  // the loop few of them keep their local planes. Those rejected by points wait as after a rollback.
  bool try_again(std::size_t pending, std::size_t n, int tries) const
  {
    return pending > (is_last || tries == 0 ? 0 : n / tuning::relations::shapes_per_retry);
  }
};

using Regular_planes = Unset_vector<Regular_plane>;

// direction_of and plane_of index the tables of directions and planes.
struct Relations {
  std::vector<int> direction_of;     // of each shape; shapes that are alone have their own
  std::vector<int> plane_of;         // of each shape; coplanar shapes share one
  std::vector<Vector> directions;    // unit, canonical in sign
  std::vector<Regular_plane> planes; // their normals are the same bits as the directions
  std::vector<char> is_rolled_back;  // by shape: its points rejected a plane, and it keeps its local fit
};

// All pairs (i, j), i < j, of exactly orthogonal directions; quadratic in their number.
inline std::vector<std::pair<int, int>> orthogonal_pairs(const std::vector<Vector>& directions)
{
  std::vector<std::pair<int, int>> pairs;
  for(std::size_t i = 0; i < directions.size(); ++i)
    for(std::size_t j = i + 1; j < directions.size(); ++j)
      if(are_orthogonal(directions[i], directions[j]))
        pairs.push_back({int(i), int(j)});
  return pairs;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_RELATIONS_H
