// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Large planes take the points that they explain. A surface that bends by more than epsilon is shared among fragments,
// each fitted to its own part; here the largest plane takes what is within its tolerances, if that is a considerable
// share of a smaller shape. Changes labels and states of points, and moments, boxes and planes of shapes. See the
// manual, "Transfer to Larger Planes".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_POINTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_POINTS_H

#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/finish/Transfer_plan.h>
#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/finish/reassign.h>
#include <CGAL/Tandem/internal/rounds/Shape_relations.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <cstdlib>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Points that fit the plane of the target of their shape go there. The others of a shape whose plane has changed stay
// only if they fit it. Each item changes its own point, so the order does not matter.
struct Transfer_point {
  Cloud_view cloud;
  Labels_view labels;
  const std::uint32_t* target; // these three by shape
  const std::uint8_t* is_changed;
  const Plane* plane;
  Tolerance tolerance;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = labels.label[i];
    labels.state[i] &= std::uint8_t(~interior_bit);
    if(s >= first_mark)
      return;
    const std::uint32_t t = target[s];
    if(t != s && fits(plane[t], cloud.point[i], tolerance))
      labels.label[i] = t;
    else if(is_changed[s] && !fits(plane[s], cloud.point[i], tolerance))
      labels.label[i] = free_label;
  }
};

// By id: the number of the plane in the relations, -1 for shapes without one.
inline std::vector<int> planes_of(std::size_t shapes, const Shape_relations& r)
{
  std::vector<int> plane_of(shapes, -1);
  for(std::size_t i = 0; i < r.id.size(); ++i)
    plane_of[r.id[i]] = r.relations.plane_of[i];
  return plane_of;
}

// The shapes take their local planes, and the points follow. Shapes with a new plane have no relations any more.
template <class Backend>
void carry_out(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Transfer_plan& plan,
               const Tolerance& tolerance)
{
  Backend& backend = points.backend;
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    const std::uint32_t id = shapes.live[l];
    Shape& shape = shapes[id];
    if(!plan.is_changed[id])
      return;
    shape.plane = shape.checked = shape.local;
    shape.regular_count = 0;
    shapes.plane[id] = rounded(shape.plane);
  });
  const auto target = backend.read_access(plan.target);
  const auto changed = backend.read_access(plan.is_changed);
  const auto plane = backend.read_access(shapes.plane);
  backend.for_each(points.cloud.size(), Transfer_point{points.cloud.view(), points.labels(), target.data(),
                                                       changed.data(), plane.data(), tolerance});
}

// How points are transferred: whether planes are fitted anew or stay as they are, and how often. Shapes that are
// smaller afterwards are dissolved; in the loop, that is left to the next round, since they may still grow.
struct Transfer {
  Planes planes;
  int maximum_rounds;
  std::int64_t minimum_size;
};

// Rounds of transfers, until hardly any point moves. All points have to fit the planes of their shapes, which are
// rounded in the table; afterwards they still do. Shapes of one plane of the relations exchange no points.
template <class Backend>
void transfer_points(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                     const Shape_relations& relations, const Transfer& transfer)
{
  Backend& backend = points.backend;
  const Tolerance& tolerance = options.growth.tolerance;
  const std::vector<int> plane_of = planes_of(shapes.size(), relations);
  for(int round = 0; round < transfer.maximum_rounds; ++round) {
    const Link_list links = collect_links(points, shapes, Links::all, [&] { refit_shapes(backend, shapes); });
    const Transfer_plan plan =
      Transfer_planner<Backend>(points, shapes, options, {links, plane_of, transfer.planes}).plan();
    if(!plan.is_any)
      return;
    std::vector<std::int64_t> before(shapes.size(), 0);
    for(std::uint32_t id : shapes.live)
      before[id] = shapes[id].moments.count;
    carry_out(points, shapes, plan, tolerance);
    propagate_labels(points, shapes.plane, tolerance);
    recount(points, shapes);
    const std::int64_t moved = sum_on_host(backend, before.size(), [&](std::size_t id) {
      const std::int64_t change = std::abs(shapes[id].moments.count - before[id]);
      shapes[id].is_changed = shapes[id].is_changed || change > 0 || plan.is_changed[id];
      return change;
    });
    drop_small(points, shapes, transfer.minimum_size);
    if(moved / 2 < std::int64_t(points.cloud.size() / tuning::transfer::points_per_moved_point))
      return;
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_POINTS_H
