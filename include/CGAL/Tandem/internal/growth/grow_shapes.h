// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pass of growth, and what it changes in the table of shapes: ids, moments, boxes, ages. No plane is fitted here, but
// those of take_local_planes(). This is the only place where ids change.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H

#include <CGAL/Tandem/internal/growth/grow_cells.h>
#include <CGAL/Tandem/internal/shapes/cell_shapes.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Replaces old ids by new ones in the labels. No label has an id that is out of use.
struct Replace_ids {
  const std::uint32_t* new_id; // by old id
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(label[i] < first_mark)
      label[i] = new_id[label[i]];
  }
};

// The shapes of a table with few live ones get new ids, in the same order; new_id is filled by old id. As ties are
// broken by id, keeping the order keeps all results.
template <class Backend>
void renumber_live_shapes(Backend& backend, Shape_table<Backend>& shapes, std::vector<std::uint32_t>& new_id)
{
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) { new_id[shapes.live[l]] = std::uint32_t(l); });
  shapes.shape.keep(backend, shapes.live);
  for(std::size_t l = 0; l < shapes.live.size(); ++l)
    shapes.plane[l] = shapes.plane[shapes.live[l]]; // l <= live[l]
  std::iota(shapes.live.begin(), shapes.live.end(), 0u);
}

// New shapes, which are those of the deltas from the old ids on, get consecutive ids behind the others. Labels, deltas
// and tables follow. Where most ids are out of use, all shapes get new ones, in the same order. So the tables stay
// proportional to the live shapes. Labels are rewritten only if some id is new.
template <class Backend>
void number_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, std::size_t ids,
                   Host_buffer<Shape_delta>& deltas)
{
  Backend& backend = points.backend;
  const std::size_t old_ids = shapes.size();
  const bool is_sparse = 2 * shapes.live.size() < old_ids;
  std::vector<std::uint32_t> new_id(ids, free_label);
  if(is_sparse)
    renumber_live_shapes(backend, shapes, new_id);
  else
    backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) { new_id[shapes.live[l]] = shapes.live[l]; });
  const std::size_t kept = shapes.size();
  // Each shape that started has a delta: its core. Deltas ascend, so those of new shapes are the last ones.
  const Shape_delta* const started =
    std::partition_point(deltas.begin(), deltas.end(), [&](const Shape_delta& delta) { return delta.id < old_ids; });
  const std::size_t first_started = std::size_t(started - deltas.begin()), next = kept + deltas.size() - first_started;
  backend.for_each_on_host(deltas.size(), [&](std::size_t d) {
    std::uint32_t& id = new_id[deltas[d].id];
    if(d >= first_started)
      id = std::uint32_t(kept + (d - first_started));
    deltas[d].id = id;
  });
  if(is_sparse || next > kept) {
    const auto numbers = backend.read_access(new_id);
    backend.for_each(points.cloud.size(), Replace_ids{numbers.data(), points.label.data()});
  }
  shapes.live.reserve(shapes.live.size() + (next - kept));
  for(std::size_t id = kept; id < next; ++id)
    shapes.live.push_back(std::uint32_t(id));
  shapes.shape.resize(backend, next);
  shapes.plane.resize(next);
  shapes.steps.resize(next);
  shapes.is_restarted.assign(next, 0);
}

// The breadth-first steps of a shape in its next pass, from its age in passes. Doubling lets planes mature before they
// spread over noise. The age of a live shape is at least 1.
inline std::uint16_t next_steps(int age)
{
  return std::uint16_t(age < tuning::growth::doubling_passes ? 1 << age : tuning::growth::maximum_steps);
}

// Adds the points of the pass to moments and boxes, and prepares all live shapes for the next pass. A delta belongs to
// one shape, so threads write different ones.
template <class Backend>
void apply_deltas(Backend& backend, Shape_table<Backend>& shapes, const Host_buffer<Shape_delta>& deltas)
{
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    const std::uint32_t id = shapes.live[l];
    Shape& shape = shapes[id];
    shape.is_active = false;
    ++shape.age;
    shapes.steps[id] = next_steps(shape.age);
  });
  shapes.assigned += std::size_t(sum_on_host(backend, deltas.size(), [&](std::size_t d) {
    Shape& shape = shapes[deltas[d].id];
    shape.moments += deltas[d].sums.moments();
    shape.box.add(deltas[d].sums.box);
    shape.is_active = shape.is_dirty = shape.is_changed = true;
    return deltas[d].sums.count;
  }));
}

// One pass, from proposals to lists of the cells. Returns the number of points that were free before.
template <class Backend>
std::size_t grow_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Seeds<Backend>& seeds,
                        const Growth_options& options)
{
  const std::size_t before = shapes.assigned;
  const std::vector<std::uint32_t> first_id = new_ids(seeds, shapes.size(), options.seeds_in_flight);
  grow_cells(points, shapes, seeds, options, first_id);
  Host_buffer<Shape_delta> deltas = take_deltas(points.backend, shapes, first_id.back());
  number_shapes(points, shapes, first_id.back(), deltas);
  apply_deltas(points.backend, shapes, deltas);
  list_shapes(points);
  return shapes.assigned - before;
}

// Between two passes of a round: shapes that started in the last one take their local planes. So they can go on before
// they have relations. They are on the frontier as a whole, so they need no restart.
template <class Backend>
void take_local_planes(Backend& backend, Shape_table<Backend>& shapes)
{
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    Shape& shape = shapes[shapes.live[l]];
    if(shape.age != 1)
      return;
    refit_if_dirty(shape);
    shapes.plane[shapes.live[l]] = rounded(shape.local);
    shape.restarted = shape.local;
  });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
