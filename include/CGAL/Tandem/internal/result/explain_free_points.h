// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why points have no shape. It is read off the result: neighbor graph, shapes and planes, not the way that led there.
// So the check of a result counts the same. Sums of integers over the points, in any order. See the manual, "Free
// Points".

#ifndef CGAL_TANDEM_INTERNAL_RESULT_EXPLAIN_FREE_POINTS_H
#define CGAL_TANDEM_INTERNAL_RESULT_EXPLAIN_FREE_POINTS_H

#include <CGAL/Tandem/Statistics.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/result/Engine_result.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>

#include <vector>

namespace CGAL::Tandem::internal {

// In the order in which they are tried, and that of Free_points: each point has the first one that holds.
namespace free_reason {
enum Reason : std::size_t { without_normal, misaligned, misfit, without_neighbors, in_small_regions, clutter, size };
} // namespace free_reason

// Both bounds twice as large; an angle of 45 degrees or more becomes a right one.
CGAL_TANDEM_HD inline Tolerance doubled(const Tolerance& t)
{
  const std::int64_t half = t.squared_cosine - (std::int64_t(1) << 31); // 2^31 cos(2 alpha): cos(2 a) = 2 cos^2(a) - 1
  return {2 * t.distance, half > 0 ? half * half >> 30 : 0};
}

// Counts the reason of each point without a shape.
struct Explain_free_points {
  Cloud_view cloud;
  Final_shapes shapes;
  const Plane* plane; // by shape
  Tolerance tolerance;
  bool has_given_normals;

  CGAL_TANDEM_HD void operator()(std::size_t at, std::int64_t* sum) const
  {
    const std::uint32_t p = std::uint32_t(at), i = cloud.surfels.of_point(p);
    if(shapes.shape[i] == no_index || !shapes.labels.has(i, p))
      ++sum[reason_of(i, cloud.surfels.point[p], cloud.surfels.tolerance_of_point(p, tolerance))];
  }

private:
  // Of point p, of surfel i, by its tolerance.
  CGAL_TANDEM_HD free_reason::Reason reason_of(std::uint32_t i, const Grid_point& p,
                                               const Tolerance& own_tolerance) const
  {
    if(p.normal == no_normal)
      return free_reason::without_normal;
    const auto is_off = [&](const Plane& s) {
      return is_near(s, p, own_tolerance.distance) && !is_aligned(s, p, own_tolerance.squared_cosine);
    };
    if(has_given_normals && is_next_to(i, is_off))
      return free_reason::misaligned;
    const Tolerance wide = doubled(own_tolerance);
    if(is_next_to(i, [&](const Plane& s) { return fits(s, p, wide); }))
      return free_reason::misfit;
    const Plane own = own_plane(p);
    const std::uint32_t* row = cloud.row(i);
    int all = 0, fitting = 0;
    for(; all < cloud.k && row[all] != no_index; ++all)
      fitting += fits(own, cloud.point[row[all]], own_tolerance);
    return fitting == 0        ? free_reason::without_neighbors
           : 2 * fitting > all ? free_reason::in_small_regions
                               : free_reason::clutter;
  }

  // Whether surfel i or one of its neighbors is in a shape whose plane is accepted.
  template <class Accept>
  CGAL_TANDEM_HD bool is_next_to(std::uint32_t i, const Accept& is_accepted) const
  {
    std::uint32_t last = shapes.shape[i]; // neighbors of one shape often follow each other
    bool is_found = last != no_index && is_accepted(plane[last]);
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index && !is_found; ++j) {
      const std::uint32_t s = shapes.shape[row[j]];
      if(s == no_index || s == last)
        continue;
      last = s;
      is_found = is_accepted(plane[s]);
    }
    return is_found;
  }
};

// The reasons of the points of all ranks; result: the shapes.
template <class Backend>
Free_points explain_free_points(Labeled_cloud<Backend>& points, const Final_shapes& shapes,
                                const std::vector<Engine_shape>& result, const Import& in, const Tolerance& tolerance)
{
  const auto plane = points.backend.template make_buffer<Plane>(
    result.size(), [&](std::size_t s) { return rounded(to_grid(result[s].plane, in.grid)); });
  const auto own = points.backend.template sum<free_reason::size>(
    points.cloud.number_of_points(),
    Explain_free_points{points.cloud.view(), shapes, plane.data(), tolerance, in.has_normals});
  const auto total = [&](free_reason::Reason r) { return points.ranks.total(std::size_t(own[r])); };
  return {total(free_reason::without_normal),    total(free_reason::misaligned),       total(free_reason::misfit),
          total(free_reason::without_neighbors), total(free_reason::in_small_regions), total(free_reason::clutter)};
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_EXPLAIN_FREE_POINTS_H
