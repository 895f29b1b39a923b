// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What follows from changed planes and merges: local fits, new labels, detached
// points, shapes that are put on the frontier again.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H

#include <CGAL/Tandem/internal/shapes/shape_deltas.h>
#include <CGAL/Tandem/internal/shapes/point_passes.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

// Planes that move by less, in epsilons, need no new check of the points ...
constexpr double negligible_motion = 0.02;
// ... and those that move by more let the shape grow again from all of its points.
constexpr double restart_motion = 0.1;

// The best plane of the points.
inline void refit(Fitted_moments& m)
{
  m.scatter = make_scatter(m.moments);
  m.fit = fit_plane(m.scatter);
  m.local = plane_through(m.fit.normal, m.scatter.centroid);
}

inline void refit_if_dirty(Shape& shape)
{
  if(shape.is_dirty)
    refit(shape);
  shape.is_dirty = false;
}

template <class Backend>
void refit_shapes(Tandem_state<Backend>& t)
{
  t.backend.for_each_on_host(t.live.size(), [&](std::size_t l) { refit_if_dirty(t.shapes[t.live[l]]); });
}

// Which shape each shape becomes: itself, another one, or is_free.
template <class Backend>
std::vector<std::uint32_t> identity_targets(const Tandem_state<Backend>& t)
{
  std::vector<std::uint32_t> target(t.shapes.size());
  for(std::size_t id = 0; id < target.size(); ++id)
    target[id] = std::uint32_t(id);
  return target;
}

// Adds the shape of the id to another one.
template <class Backend>
void join_shape(Tandem_state<Backend>& t, Shape& root, std::uint32_t id)
{
  const Shape& shape = t.shapes[id];
  root.moments += shape.moments;
  root.box.add(shape.box);
  root.age = (std::max)(root.age, shape.age);
  root.is_dirty = root.is_changed = true;
  root.layered_count = 0;
  clear_shape(t, id);
}

// Adds the shapes to their targets, which are targets of themselves, and gives up those
// without one. The points follow in update_points().
template <class Backend>
void merge_shapes(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& target)
{
  Parted_ids parted = part_on_host(
    t.backend, t.live.size(), [&](std::size_t l) { return t.live[l]; },
    [&](std::uint32_t id) { return target[id] == id; });
  t.live = std::move(parted.chosen);
  std::vector<std::uint64_t> joins; // target << 32 | shape
  std::vector<std::uint32_t> dropped;
  for(std::uint32_t id : parted.others)
    if(target[id] < first_mark)
      joins.push_back(std::uint64_t(target[id]) << 32 | id);
    else
      dropped.push_back(id);
  t.assigned -= std::size_t(sum_on_host(t.backend, dropped.size(), [&](std::size_t i) {
    const std::int64_t lost = t.shapes[dropped[i]].moments.count;
    clear_shape(t, dropped[i]);
    return lost;
  }));
  t.backend.sort_on_host(joins.begin(), joins.end(), std::less<std::uint64_t>());
  t.backend.for_each_on_host(joins.size(), [&](std::size_t first) {
    const std::uint64_t root = joins[first] >> 32;
    if(first > 0 && joins[first - 1] >> 32 == root)
      return;
    for(std::size_t i = first; i < joins.size() && joins[i] >> 32 == root; ++i)
      join_shape(t, t.shapes[root], std::uint32_t(joins[i]));
  });
}

template <class Backend>
void drop_empty_shapes(Tandem_state<Backend>& t)
{
  t.live = chosen_shapes(t, [&](const Shape& shape, std::uint32_t id) {
    const bool is_empty = shape.moments.count == 0;
    if(is_empty)
      clear_shape(t, id);
    return !is_empty;
  });
}

// Relabels the points and takes out those that do not fit the plane of a shape that
// is checked (by old id).
template <class Backend>
void update_points(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& target,
                   const std::vector<std::uint8_t>& is_checked)
{
  const bool is_any_checked = std::find(is_checked.begin(), is_checked.end(), 1) != is_checked.end();
  const std::vector<Plane> none;
  const auto new_label = t.backend.read_access(target);
  const auto checked = t.backend.read_access(is_checked);
  const auto plane = t.backend.read_access(is_any_checked ? t.plane : none);
  t.backend.template for_each_cell<Update_scratch>(
    t.number_of_cells,
    Update_points<Backend>{t.cloud, t.cells.data(), t.cell_shapes.data(), t.labels(), new_label.data(), checked.data(),
                           plane.data(), start_deltas(t, t.shapes.size()), t.options.growth.tolerance});
  if(!is_any_checked)
    return;
  const Host_buffer<Shape_delta> losses = take_deltas(t, t.shapes.size());
  t.assigned -= std::size_t(sum_on_host(t.backend, losses.size(), [&](std::size_t l) {
    Shape& shape = t.shapes[losses[l].id];
    shape.moments += losses[l].sums.moments();
    shape.is_dirty = true;
    return -losses[l].sums.count;
  }));
  drop_empty_shapes(t);
}

// Merges the shapes and their points. No point is checked.
template <class Backend>
void merge_points(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& target)
{
  merge_shapes(t, target);
  update_points(t, target, std::vector<std::uint8_t>(t.shapes.size(), 0));
}

// The points of the shapes with is_dropped(shape, id) are free again.
template <class Backend, class Predicate>
void drop_shapes(Tandem_state<Backend>& t, Predicate is_dropped)
{
  const Ids ids = chosen_shapes(t, is_dropped);
  if(ids.empty())
    return;
  std::vector<std::uint32_t> target = identity_targets(t);
  for(std::uint32_t id : ids)
    target[id] = free_label;
  merge_points(t, target);
}

// Hands the planes over to the points, checks the points of the shapes whose plane
// has moved or which are new unions, and restarts shapes that have moved far.
template <class Backend>
void apply_planes(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& target)
{
  const double epsilon = t.options.maximum_distance;
  std::vector<std::uint8_t> is_moved(t.shapes.size(), 0), is_checked(t.shapes.size(), 0);
  t.backend.for_each_on_host(t.live.size(), [&](std::size_t l) {
    const std::uint32_t id = t.live[l];
    Shape& shape = t.shapes[id];
    t.plane[id] = rounded(shape.plane);
    is_moved[id] = bound_motion(shape.box, shape.checked, shape.plane) > negligible_motion * epsilon;
    if(bound_motion(shape.box, shape.restarted, shape.plane) > restart_motion * epsilon) {
      t.is_restarted[id] = shape.age > 1; // a new shape is on the frontier as a whole
      shape.restarted = shape.plane;
    }
    if(is_moved[id]) {
      shape.checked = shape.plane;
      shape.is_changed = true;
    }
  });
  const std::int64_t changes = sum_on_host(t.backend, target.size(), [&](std::size_t id) {
    is_checked[id] = target[id] < first_mark && (target[id] != id || is_moved[target[id]]);
    return std::int64_t(is_checked[id] || target[id] != id);
  });
  if(changes > 0)
    update_points(t, target, is_checked);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_UPDATE_SHAPES_H
