// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is known of a shape when a plane is tested that may replace its local one. Lengths are grid steps.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_TESTED_SHAPE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_TESTED_SHAPE_H

#include <CGAL/Tandem/internal/base/tuning/growth.h>
#include <CGAL/Tandem/internal/base/tuning/regularity.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// Which points of a shape are counted: those whose position has no bit of this mask, so all, every second one, every
// fourth one ... Positions follow the curve, so a sample is spread over the shape. The largest mask that still selects
// about sample_size points; 0, which selects all, below twice as many.
CGAL_TANDEM_HD inline std::uint32_t sample_mask(std::int64_t points)
{
  std::uint32_t mask = 0;
  while(points / (2 * (std::int64_t(mask) + 1)) >= tuning::verification::sample_size)
    mask = 2 * mask + 1;
  return mask;
}

// What a test of a plane needs to know of a shape beside its sample.
struct Tested_shape {
  Box box;
  Regular_plane local;
  std::int64_t points;
  Misfit_record last;

  // Whether the share of misfits is known without a count: planes that hardly move have none, and the last count of
  // nearly the same points and planes is used again.
  CGAL_TANDEM_HD bool knows_share(const Regular_plane& candidate, double maximum_distance, double& share) const
  {
    share = 0;
    if(is_still(local, candidate, maximum_distance))
      return true;
    const std::int64_t change = points - last.points;
    if((change < 0 ? -change : change) * tuning::verification::points_per_change > last.points ||
       !is_still(candidate, last.candidate, maximum_distance) || !is_still(local, last.local, maximum_distance))
      return false;
    share = last.misfit_share;
    return true;
  }

  // The share from a count of the sample, which is recorded.
  CGAL_TANDEM_HD double take_count(const Regular_plane& candidate, std::uint32_t misfits)
  {
    const double share = double(misfits) * (double(sample_mask(points)) + 1) / double(points);
    last = {local, candidate, points, share};
    return share;
  }

private:
  // Whether the distances of all points to both planes are the same, up to a negligible part of epsilon.
  CGAL_TANDEM_HD bool is_still(const Regular_plane& a, const Regular_plane& b, double maximum_distance) const
  {
    const bool is_same = a.normal == b.normal && a.offset == b.offset;
    return is_same || bound_motion(box, a, b) <= tuning::motion::negligible * maximum_distance;
  }
};

CGAL_TANDEM_HD inline Tested_shape tested(const Shape& s)
{
  return {s.box, s.local, s.moments.count, s.history.last_misfits};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_TESTED_SHAPE_H
