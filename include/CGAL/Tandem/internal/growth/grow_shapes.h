// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pass of growth, and what it changes in the table of shapes: ids, moments, boxes, ages. No plane is fitted here, but
// those of take_local_planes(). This is the only place where ids change.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H

#include <CGAL/Tandem/internal/growth/grow_cells.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <utility>

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

// Shapes that started in the pass have a delta: their core.
struct Has_started {
  const Shared_moments* delta; // from the first new id on

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return is_any(delta[i]); }
};

// The breadth-first steps of a shape in its next pass, from its age in passes. Doubling lets planes mature before they
// spread over noise. The age of a live shape is at least 1.
CGAL_TANDEM_HD inline std::uint16_t next_steps(int age)
{
  return std::uint16_t(age < tuning::growth::doubling_passes ? 1 << age : tuning::growth::maximum_steps);
}

// Makes the entries of the new table, those of new shapes last, adds the points of the pass to them, and prepares them
// for the next pass.
struct Take_growth {
  const Shape* old_shape; // may be the new table: then ids stay
  const Plane* old_plane;
  Shape* shape;
  Plane* plane;
  std::uint16_t* steps;
  std::uint8_t* is_restarted;
  Shared_moments* delta;        // by old id
  const std::uint32_t* kept;    // old ids; null if all are kept
  const std::uint32_t* started; // after the first new id
  std::uint32_t number_kept, first_new;
  std::uint32_t* new_id; // by old id

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const bool is_new = i >= number_kept;
    const std::uint32_t old = is_new            ? first_new + started[i - number_kept]
                              : kept != nullptr ? kept[i]
                                                : std::uint32_t(i);
    Shape& s = shape[i];
    if(is_new) {
      s = Shape();
      plane[i] = Plane();
    } else if(old_shape != shape) {
      s = old_shape[old];
      plane[i] = old_plane[old];
    }
    new_id[old] = std::uint32_t(i);
    is_restarted[i] = 0;
    steps[i] = 0;
    if(!is_new && !s.is_live())
      return;
    s.is_active = is_any(delta[old]);
    ++s.age;
    steps[i] = next_steps(s.age);
    if(!s.is_active)
      return;
    s.moments += delta[old].moments();
    s.box.add(delta[old].box);
    s.history.set_fitted(false);
    s.history.set_linked(false);
    delta[old] = Shared_moments();
  }
};

struct Count_grown {
  const Shape* shape;
  const Shared_moments* delta;
  std::size_t shapes;

  CGAL_TANDEM_HD void operator()(std::size_t id, std::int64_t* sum) const
  {
    sum[0] += delta[id].count;
    sum[1] += id < shapes && shape[id].is_live();
  }
};

// The sums of shapes that have started.
struct Get_started {
  const std::uint32_t* started;
  const Shared_moments* delta; // from the first new id on
  Shared_moments* sum;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { sum[i] = delta[started[i]]; }
};

// Makes the list of the shapes that have started on this rank that of all ranks. The others get ids from `ids` on, with
// their sums. Returns the end of the ids.
template <class Backend>
std::size_t join_started(Backend& backend, const Ranks<Backend>& ranks, Shape_table<Backend>& shapes, std::size_t ids,
                         typename Backend::template Buffer<std::uint32_t>& started)
{
  const std::vector<std::uint32_t> own = to_vector(backend, started);
  typename Backend::template Buffer<Shared_moments> sums(own.size());
  backend.for_each(own.size(), Get_started{started.data(), shapes.delta.data() + shapes.size, sums.data()});
  std::vector<std::size_t> first;
  const std::vector<Shared_moments> all = ranks.gather(to_vector(backend, sums), &first);
  const std::size_t end = ids + all.size() - own.size(), own_first = first[ranks.share().rank];
  if(end >= first_mark)
    throw std::length_error("there are more than 2^31 shapes while they grow: minimum_region_size is too small");
  std::vector<Shared_moments> others;
  std::vector<std::uint32_t> joined;
  for(std::size_t i = 0; i < all.size(); ++i)
    if(i >= own_first && i < own_first + own.size())
      joined.push_back(own[i - own_first]);
    else {
      joined.push_back(std::uint32_t(ids - shapes.size + others.size()));
      others.push_back(all[i]);
    }
  started = to_buffer(backend, joined);
  const std::size_t old = shapes.delta.size();
  if(old < end) {
    shapes.delta = extended<Shared_moments>(backend, shapes.delta, end + end / 2);
    backend.for_each(shapes.delta.size() - old, Fill<Shared_moments>{shapes.delta.data() + old, Shared_moments()});
  }
  write_to(backend, others, shapes.delta.data() + ids);
  return end;
}

// Makes the table of shapes after a pass, of which `ids` is the end of the ids. New shapes get consecutive ids behind
// the others. Where most ids are out of use, all shapes get new ones, in the same order: ties are broken by id, so that
// keeps all results. So the tables stay proportional to the live shapes. Labels are rewritten only if some id is new.
// Returns the number of points that got a shape.
template <class Backend>
std::size_t take_growth(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, std::size_t ids)
{
  using Ids = typename Backend::template Buffer<std::uint32_t>;
  Backend& backend = points.backend;
  const std::size_t first_new = shapes.size;
  sum_deltas(backend, points.ranks, shapes);
  Ids started = backend.compact(ids - first_new, Has_started{shapes.delta.data() + first_new});
  if constexpr(Ranks<Backend>::are_many)
    ids = join_started(backend, points.ranks, shapes, ids, started);
  Shared_moments* const delta = shapes.delta.data();
  const auto sums = backend.template sum<2>(ids, Count_grown{shapes.counted(), delta, first_new});
  const std::size_t live = std::size_t(sums[1]);
  const bool is_sparse = 2 * live < first_new;
  const Ids kept = is_sparse ? backend.compact(first_new, Has_points{shapes.counted(), 1}) : Ids();
  const std::size_t number_kept = is_sparse ? live : first_new, size = number_kept + started.size();
  typename Backend::template Buffer<Shape> shape;
  typename Backend::template Buffer<Plane> plane;
  const bool moves = is_sparse || size > shapes.table().size();
  if(moves) {
    shape.reset(size + size / 2);
    plane.reset(size + size / 2);
    shapes.steps.reset(size + size / 2);
    shapes.is_restarted.reset(size + size / 2);
  }
  Shape* const table = shapes.change_moments(); // also where they move
  Ids new_id(ids);
  Take_growth take = {};
  take.old_shape = shapes.table().data();
  take.old_plane = shapes.plane.data();
  take.shape = moves ? shape.data() : table;
  take.plane = moves ? plane.data() : shapes.plane.data();
  take.steps = shapes.steps.data();
  take.is_restarted = shapes.is_restarted.data();
  take.delta = delta;
  take.kept = is_sparse ? kept.data() : nullptr;
  take.started = started.data();
  take.number_kept = std::uint32_t(number_kept);
  take.first_new = std::uint32_t(first_new);
  take.new_id = new_id.data();
  backend.for_each(size, take, shapes_per_thread);
  if(moves) {
    shapes.table() = std::move(shape);
    shapes.plane = std::move(plane);
  }
  shapes.size = size;
  const Labels_view labels = points.change_labels(false);
  if(is_sparse || started.size() > 0)
    backend.for_each(points.cloud.size(), Replace_ids{new_id.data(), labels.label});
  points.refresh_labels();
  return std::size_t(sums[0]);
}

// Runs one pass of growth, from proposals to the table of shapes. Returns the number of points that were free before.
template <class Backend>
std::size_t grow_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Seeds<Backend>& seeds,
                        const Growth_options& options)
{
  return take_growth(points, shapes, grow_cells(points, shapes, seeds, options));
}

// The fits of shapes that started in the last pass, as their planes.
struct Started_shapes : Changed_shapes {
  Plane* plane;

  CGAL_TANDEM_HD bool has(std::size_t id) const { return shape[id].age == 1 && Changed_shapes::has(id); }
  CGAL_TANDEM_HD void set_made(std::size_t id) const
  {
    Changed_shapes::set_made(id);
    plane[id] = rounded(shape[id].local);
    shape[id].history.set_restarted(shape[id].local);
  }
};

// Gives shapes that started in the last pass their local planes, between two passes of a round. So they can go on
// before they have relations. They are on the frontier as a whole, so they need no restart.
template <class Backend>
void take_local_planes(const Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes)
{
  make_fits(points.backend, points.ranks, shapes.size, Started_shapes{{shapes.counted()}, shapes.plane.data()});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
