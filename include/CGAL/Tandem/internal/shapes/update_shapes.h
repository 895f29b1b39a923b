// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from changed planes and merges: local fits, new labels, detached surfels, shapes that grow again from all
// of their surfels. Changes the table of shapes, labels, states and lists of the cells. Which shapes merge, and which
// planes they have, is decided elsewhere.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H

#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/update_tables.h>

namespace CGAL::Tandem::internal {

// Adds each shape with a target to its sums, and clears it. Targets are targets of themselves.
template <class Backend>
struct Join_shape {
  Shape* shape;
  const std::uint32_t* target;
  Shared_moments* joined; // by target

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    const std::uint32_t t = target[id];
    if(t == id || !shape[id].is_live())
      return;
    if(t < first_mark) {
      atomic_add<Backend>(joined[t], shape[id].moments, shape[id].box);
      Backend::atomic_max(shape[t].age, shape[id].age);
    }
    shape[id].moments = Moments();
  }
};

// The unions are fitted and linked anew.
struct Take_joined {
  Shape* shape;
  Shared_moments* joined;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(!is_any(joined[id]))
      return;
    Add_deltas{shape, joined}(id);
    shape[id].history.is_linked = false;
  }
};

// Adds the shapes to their targets, and clears those without one. Labels have to follow at once.
template <class Backend>
void merge_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Targets<Backend>& target)
{
  Backend& backend = points.backend;
  Shared_moments* const joined = start_deltas(backend, shapes, shapes.size);
  for_each_shape(backend, shapes, Join_shape<Backend>{shapes.counted(), target.data(), joined});
  for_each_shape(backend, shapes, Take_joined{shapes.change_moments(), joined});
}

// Losses of the shapes of a cell, and the labels of its list.
struct Update_scratch {
  Moment_table table;
  std::uint32_t labels[Cell_shapes::capacity];
};

// What becomes of the surfels of a shape
struct Relabeling {
  const std::uint32_t* target;    // these two by old label
  const std::uint8_t* is_checked; // null: none is
  const Plane* plane;             // by new label
  Tolerance tolerance;

  CGAL_TANDEM_HD bool checks(std::uint32_t old) const { return is_checked != nullptr && is_checked[old] != 0; }
};

// Gives each surfel the label `target` of its shape. Where that is a mark the shape is dissolved, and its surfels are
// no seeds any more. Where the shape is checked, surfels that do not fit are detached; those for the second time are
// locked. A lane reads and writes label and state of its own surfel only. So surfels may come in any order.
template <class Backend>
struct Update_surfels {
  Cloud_view cloud;
  const Range* cells;
  Cell_shapes* lists;
  Labels_view labels;
  Relabeling change;
  Shared_moments* loss; // by new label: minus the points of detached surfels

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Update_scratch& scratch, std::uint32_t c) const
  {
    if(!lists[c].may_have(block, [&](std::uint32_t s) { return change.target[s] != s || change.checks(s); }))
      return;
    relabel_list(block, lists[c], change.target, scratch.labels);
    const Range cell = cells[c];
    const Cell_sums losses = {cloud.surfels, cloud.point[cell.first], loss};
    Moment_table& table = scratch.table;
    table.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t old = labels.label[i];
      if(old >= first_mark)
        return;
      const std::uint32_t s = change.target[old];
      if(s >= first_mark) {
        labels.label[i] = s;
        labels.state[i] = std::uint8_t((labels.state[i] | tried_seed_bit) & ~interior_bit);
      } else if(change.checks(old) && !cloud.fits(change.plane[s], i, change.tolerance)) {
        labels.label[i] = labels.state[i] & detached_bit ? locked_label : free_label;
        labels.state[i] = std::uint8_t((labels.state[i] | detached_bit) & ~interior_bit);
        table.template add<Backend>(block, s, i, -1, losses);
      } else if(s != old) {
        labels.label[i] = s;
      }
    });
    table.template flush<Backend>(block, losses);
  }
};

// Relabels the surfels, and detaches those that do not fit the plane of a shape that is checked. Lists follow, and
// moments; boxes do not shrink. is_checked: by old id; null if no surfel is tested.
template <class Backend>
void update_surfels(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Targets<Backend>& target,
                    const std::uint8_t* is_checked, const Tolerance& tolerance)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::lists);
  Shared_moments* const losses = start_deltas(backend, shapes, shapes.size);
  const Labels_view labels = points.change_labels(true);
  backend.template for_each_cell<Update_scratch>(
    points.number_of_cells(), Update_surfels<Backend>{points.cloud.view(),
                                                      points.cells.data(),
                                                      points.lists(),
                                                      labels,
                                                      {target.data(), is_checked, shapes.plane.data(), tolerance},
                                                      losses});
  points.refresh_labels();
  if(is_checked != nullptr) {
    sum_deltas(backend, points.ranks, shapes);
    add_deltas(backend, shapes);
  }
}

// Merges the shapes and their surfels. No surfel is checked.
template <class Backend>
void merge_surfels(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Targets<Backend>& target)
{
  merge_shapes(points, shapes, target);
  update_surfels(points, shapes, target, nullptr, Tolerance());
}

template <class Predicate>
struct Drop_shape {
  const Shape* shape;
  Predicate is_dropped;
  std::uint32_t* target;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    target[id] = shape[id].is_live() && is_dropped(shape[id], id) ? free_label : std::uint32_t(id);
  }
};

// The surfels of the shapes with is_dropped(shape, id) are free again.
template <class Backend, class Predicate>
void drop_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Predicate is_dropped)
{
  Targets<Backend> target(shapes.size);
  for_each_shape(points.backend, shapes, Drop_shape<Predicate>{shapes.counted(), is_dropped, target.data()});
  merge_surfels(points, shapes, target);
}

// Rounds the plane of a shape, and restarts the shape if the plane has moved far.
struct Apply_plane {
  Shape* shape;
  Plane* plane;
  std::uint8_t* is_restarted;
  std::uint8_t* is_moved;
  double maximum_distance_steps;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    Shape& s = shape[id];
    is_moved[id] = 0;
    if(!s.is_live())
      return;
    plane[id] = rounded(s.plane);
    const double distance = s.mean_distance_steps(maximum_distance_steps);
    if(s.history.restart_again(s.box, s.plane, distance))
      is_restarted[id] = 1;
    is_moved[id] = s.history.check_again(s.box, s.plane, distance);
  }
};

struct Check_moved {
  const std::uint32_t* target;
  const std::uint8_t* is_moved;
  std::uint8_t* is_checked;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    is_checked[id] = target[id] < first_mark && (target[id] != id || is_moved[target[id]]);
  }
};

// Merges the shapes, and rounds the planes for the tests of surfels. Detaches the misfits of shapes that have moved or
// are new unions. Shapes that have moved far grow again from all of their surfels, since other surfels may fit now.
// Motion is bounded over the box of a shape. It is measured since the last check or restart, so small motions add up.
template <class Backend>
void apply_planes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                  const Targets<Backend>& target)
{
  Buffer_of<Backend, std::uint8_t> is_moved(shapes.size), is_checked(shapes.size);
  merge_shapes(points, shapes, target);
  for_each_shape(points.backend, shapes,
                 Apply_plane{shapes.table().data(), shapes.plane.data(), shapes.is_restarted.data(), is_moved.data(),
                             options.maximum_distance_steps});
  for_each_shape(points.backend, shapes, Check_moved{target.data(), is_moved.data(), is_checked.data()});
  update_surfels(points, shapes, target, is_checked.data(), options.growth.tolerance);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H
