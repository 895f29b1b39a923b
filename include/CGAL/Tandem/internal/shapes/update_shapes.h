// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from changed planes and merges: local fits, new labels, detached points, shapes that are put on the
// frontier again. Changes the table of shapes, labels, states and lists of the cells. Which shapes merge, and which
// planes they have, is decided elsewhere.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H

#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/cell_shapes.h>
#include <CGAL/Tandem/internal/shapes/shape_deltas.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Afterwards no live shape is dirty.
template <class Backend>
void refit_shapes(Backend& backend, Shape_table<Backend>& shapes)
{
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) { refit_if_dirty(shapes[shapes.live[l]]); });
}

// Adds the shape of the id to another one. The union is fitted, linked and examined for layers anew.
template <class Backend>
void join_shape(Shape_table<Backend>& shapes, Shape& root, std::uint32_t id)
{
  const Shape& shape = shapes[id];
  root.moments += shape.moments;
  root.box.add(shape.box);
  root.age = (std::max)(root.age, shape.age);
  root.is_dirty = root.is_changed = true;
  root.layered_count = 0;
  shapes.clear(id);
}

// Adds the shapes to their targets, which are targets of themselves, and clears those without one. Labels are out of
// date until update_points(). Joins are sorted by target, so that one thread adds all shapes of a union.
template <class Backend>
void merge_shapes(Backend& backend, Shape_table<Backend>& shapes, const Targets& target)
{
  Parted_ids parted = part_on_host(
    backend, shapes.live.size(), [&](std::size_t l) { return shapes.live[l]; },
    [&](std::uint32_t id) { return target[id] == id; });
  shapes.live = std::move(parted.chosen);
  std::vector<std::uint64_t> joins; // target << 32 | shape
  std::vector<std::uint32_t> dropped;
  for(std::uint32_t id : parted.others)
    if(target[id] < first_mark)
      joins.push_back(std::uint64_t(target[id]) << 32 | id);
    else
      dropped.push_back(id);
  shapes.assigned -= std::size_t(sum_on_host(backend, dropped.size(), [&](std::size_t i) {
    const std::int64_t lost = shapes[dropped[i]].moments.count;
    shapes.clear(dropped[i]);
    return lost;
  }));
  backend.sort_on_host(joins.begin(), joins.end(), std::less<std::uint64_t>());
  backend.for_each_on_host(joins.size(), [&](std::size_t first) {
    const std::uint64_t root = joins[first] >> 32;
    if(first > 0 && joins[first - 1] >> 32 == root)
      return;
    for(std::size_t i = first; i < joins.size() && joins[i] >> 32 == root; ++i)
      join_shape(shapes, shapes[root], std::uint32_t(joins[i]));
  });
}

// Losses of the shapes of a cell, and the labels of its list.
struct Update_scratch {
  Moment_table table;
  std::uint32_t labels[Cell_shapes::capacity];
};

// Gives each point the label `target` of its shape. Where that is a mark the shape is dissolved, and its points are no
// seeds any more. Where the shape is checked, points that do not fit are detached; those for the second time are
// locked. A lane reads and writes label and state of its own point only. So points may come in any order.
template <class Backend>
struct Update_points {
  Cloud_view cloud;
  const Range* cells;
  Cell_shapes* lists;
  Labels_view labels;
  const std::uint32_t* target; // these two by old label
  const std::uint8_t* is_checked;
  const Plane* plane;   // these two by new label
  Shared_moments* loss; // by new label: minus the detached points
  Tolerance tolerance;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Update_scratch& scratch, std::uint32_t c) const
  {
    if(!lists[c].may_have(block, [&](std::uint32_t s) { return target[s] != s || is_checked[s] != 0; }))
      return;
    relabel_list(block, lists[c], target, scratch.labels);
    const Range cell = cells[c];
    const Cell_sums losses = {cloud.point[cell.first], loss};
    Moment_table& table = scratch.table;
    table.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t old = labels.label[i];
      if(old >= first_mark)
        return;
      const std::uint32_t s = target[old];
      if(s >= first_mark) {
        labels.label[i] = s;
        labels.state[i] = std::uint8_t((labels.state[i] | tried_seed_bit) & ~(frontier_bit | interior_bit));
      } else if(is_checked[old] && !fits(plane[s], cloud.point[i], tolerance)) {
        labels.label[i] = labels.state[i] & detached_bit ? locked_label : free_label;
        labels.state[i] = std::uint8_t((labels.state[i] | detached_bit) & ~(frontier_bit | interior_bit));
        table.template add<Backend>(block, s, cloud.point[i], -1, losses);
      } else if(s != old) {
        labels.label[i] = s;
      }
    });
    table.template flush<Backend>(block, losses);
  }
};

// The shapes whose points are tested against the planes of their targets, by old id.
struct Point_check {
  std::vector<std::uint8_t> is_checked;
  Tolerance tolerance;

  bool is_any() const { return std::find(is_checked.begin(), is_checked.end(), 1) != is_checked.end(); }
};

// Relabels the points, and detaches those that do not fit the plane of a shape that is checked. Moments follow, boxes
// do not shrink, and shapes without points leave the table.
template <class Backend>
void update_points(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Targets& target,
                   const Point_check& check)
{
  Backend& backend = points.backend;
  const bool is_any_checked = check.is_any();
  const std::vector<Plane> none;
  const auto new_label = backend.read_access(target);
  const auto checked = backend.read_access(check.is_checked);
  const auto plane = backend.read_access(is_any_checked ? shapes.plane : none);
  backend.template for_each_cell<Update_scratch>(
    points.number_of_cells(),
    Update_points<Backend>{points.cloud.view(), points.cells.data(), points.cell_shapes.data(), points.labels(),
                           new_label.data(), checked.data(), plane.data(), start_deltas(backend, shapes, shapes.size()),
                           check.tolerance});
  if(!is_any_checked)
    return;
  const Host_buffer<Shape_delta> losses = take_deltas(backend, shapes, shapes.size());
  shapes.assigned -= std::size_t(sum_on_host(backend, losses.size(), [&](std::size_t l) {
    Shape& shape = shapes[losses[l].id];
    shape.moments += losses[l].sums.moments();
    shape.is_dirty = true;
    return -losses[l].sums.count;
  }));
  drop_empty_shapes(backend, shapes);
}

// Merges the shapes and their points. No point is checked.
template <class Backend>
void merge_points(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Targets& target)
{
  merge_shapes(points.backend, shapes, target);
  update_points(points, shapes, target, {std::vector<std::uint8_t>(shapes.size(), 0), Tolerance()});
}

// The points of the shapes with is_dropped(shape, id) are free again.
template <class Backend, class Predicate>
void drop_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Predicate is_dropped)
{
  const Ids ids = chosen_shapes(points.backend, shapes, is_dropped);
  if(ids.empty())
    return;
  Targets target = identity_targets(shapes.size());
  for(std::uint32_t id : ids)
    target[id] = free_label;
  merge_points(points, shapes, target);
}

// Dissolves the shapes of less than `minimum_size` points; their points are free again.
template <class Backend>
void drop_small(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, std::int64_t minimum_size)
{
  drop_shapes(points, shapes, [&](const Shape& shape, std::uint32_t) { return shape.moments.count < minimum_size; });
}

// Rounds the planes for the tests of points. Detaches the misfits of shapes that have moved or are new unions. Shapes
// that have moved far grow again from all of their points, since other points may fit now. Motion is bounded over the
// box of a shape. It is measured since the last check or restart, so small motions add up.
template <class Backend>
void apply_planes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                  const Targets& target)
{
  const double epsilon = options.maximum_distance;
  std::vector<std::uint8_t> is_moved(shapes.size(), 0);
  points.backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    const std::uint32_t id = shapes.live[l];
    Shape& shape = shapes[id];
    shapes.plane[id] = rounded(shape.plane);
    is_moved[id] = bound_motion(shape.box, shape.checked, shape.plane) > tuning::motion::negligible * epsilon;
    if(bound_motion(shape.box, shape.restarted, shape.plane) > tuning::motion::restart * epsilon) {
      shapes.is_restarted[id] = shape.age > 1; // a new shape is on the frontier as a whole
      shape.restarted = shape.plane;
    }
    if(is_moved[id]) {
      shape.checked = shape.plane;
      shape.is_changed = true;
    }
  });
  Point_check check = {std::vector<std::uint8_t>(shapes.size(), 0), options.growth.tolerance};
  const std::int64_t changes = sum_on_host(points.backend, target.size(), [&](std::size_t id) {
    check.is_checked[id] = target[id] < first_mark && (target[id] != id || is_moved[target[id]]);
    return std::int64_t(check.is_checked[id] || target[id] != id);
  });
  if(changes > 0)
    update_points(points, shapes, target, check);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H
