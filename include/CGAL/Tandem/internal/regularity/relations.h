// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the regularity step takes and gives. All lengths are grid steps.

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

// A shape: its moments and its local least-squares plane, which passes through
// the centroid and has a unit normal.
struct Shape_fit {
  Scatter scatter;
  Fit fit;
};

using Shape_fits = Unset_vector<Shape_fit>;

inline Regular_plane through_centroid(const Shape_fit& s, const Vector& n) { return {n, dot(n, s.scatter.centroid)}; }

struct Regularity_options {
  double angle_tolerance_deg; // beta, in [0, 45)
  double maximum_offset;      // sigma of the coplanarity
  double maximum_distance;    // epsilon
  bool parallelism, orthogonality, coplanarity;
  bool is_last; // nothing grows any more: leftovers join settled directions

  // Whether `pending` of n shapes that were refused `tries` times are tried again. That costs as much as for all shapes:
  // in the loop few of them keep their local planes, and those that their points refused wait as after a rollback.
  bool try_again(std::size_t pending, std::size_t n, int tries) const
  {
    return pending > (is_last || tries == 0 ? 0 : n / tuning::relations::shapes_per_retry);
  }
};

using Regular_planes = Unset_vector<Regular_plane>;

struct Relations {
  std::vector<int> direction_of;     // of each shape; shapes that are alone have their own
  std::vector<int> plane_of;         // of each shape; coplanar shapes share one
  std::vector<Vector> directions;    // unit, canonical in sign
  std::vector<Regular_plane> planes; // their normals are the same bits as the directions
  std::vector<char> is_rolled_back;  // the points refused every tie: the shape keeps its local fit
};

// All pairs (i, j), i < j, of exactly orthogonal directions.
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
