// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Large planes take the points that they explain. A surface that bends by more than epsilon is shared among fragments,
// each fitted to its own part; here the largest plane takes what is within its tolerances, if that is a considerable
// share of a smaller shape. Changes labels and states of points, and moments, boxes and planes of shapes. See the
// manual, "Transfer to Larger Planes".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_POINTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_POINTS_H

#include <CGAL/Tandem/internal/base/tuning/finish.h>
#include <CGAL/Tandem/internal/finish/Transfer_plan.h>
#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/finish/reassign.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

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

struct Take_changed_plane {
  Shape* shape;
  Plane* plane;
  const std::uint8_t* is_changed;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    Shape& s = shape[id];
    if(!is_changed[id])
      return;
    s.plane = s.local;
    s.history.set_checked(s.plane);
    s.history.set_related(0);
    plane[id] = rounded(s.plane);
  }
};

// The shapes take their local planes, and the points follow; moments do not. Shapes with a new plane have no relations
// any more.
template <class Backend>
void carry_out(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Transfer_plan<Backend>& plan,
               const Tolerance& tolerance)
{
  for_each_shape(points.backend, shapes,
                 Take_changed_plane{shapes.fitted(), shapes.plane.data(), plan.is_changed.data()});
  const Labels_view labels = points.change_labels(false);
  shapes.lose_moments();
  points.backend.for_each(points.cloud.size(), Transfer_point{points.cloud.view(), labels, plan.target.data(),
                                                              plan.is_changed.data(), shapes.plane.data(), tolerance});
  points.refresh_labels();
}

struct Mark_changed {
  Shape* shape;
  const std::int64_t* before;
  const std::uint8_t* is_changed;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(is_changed[id] || shape[id].moments.count != before[id])
      shape[id].history.set_linked(false);
  }
};

// Twice the number of points that have come or gone.
struct Sum_moved {
  const Shape* shape;
  const std::int64_t* before;

  CGAL_TANDEM_HD void operator()(std::size_t id, std::int64_t* sum) const
  {
    const std::int64_t change = shape[id].moments.count - before[id];
    sum[0] += change < 0 ? -change : change;
  }
};

// How points are transferred: whether planes are fitted anew or stay as they are, how often, and in which phase. Shapes
// that are smaller afterwards are dissolved; in the loop, that is left to the next round, since they may still grow.
struct Transfer {
  Planes planes;
  int maximum_rounds;
  std::int64_t minimum_size;
  Phase phase;
};

// Rounds of transfers, until hardly any point moves. All points have to fit the planes of their shapes, which are
// rounded in the table; afterwards they still do. Shapes of one plane of the relations exchange no points.
template <class Backend>
void transfer_points(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                     const Transfer& transfer)
{
  Backend& backend = points.backend;
  const Tolerance& tolerance = options.growth.tolerance;
  for(int round = 0; round < transfer.maximum_rounds; ++round) {
    require(points, shapes, tables::fits);
    const auto links = collect_links(points, shapes, Links::all, transfer.phase);
    const auto plan = Transfer_planner<Backend>(points, shapes, options, transfer.planes).plan(links);
    if(!plan.is_any)
      return;
    const auto before = sizes_of(backend, shapes);
    carry_out(points, shapes, plan, tolerance);
    propagate_labels(points, shapes, tolerance, transfer.phase);
    require(points, shapes, tables::moments);
    for_each_shape(backend, shapes, Mark_changed{shapes.counted(), before.data(), plan.is_changed.data()});
    const std::int64_t moved = backend.template sum<1>(shapes.size, Sum_moved{shapes.counted(), before.data()})[0] / 2;
    drop_small(points, shapes, transfer.minimum_size);
    if(moved < std::int64_t(points.total_points() / tuning::transfer::points_per_moved_point))
      return;
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_POINTS_H
