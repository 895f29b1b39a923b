// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of shapes, in the memory of the back end, where the points are. An id is a place in these tables, and the
// label of the surfels of that shape. Ids out of use keep their places until grow_shapes() renumbers all shapes.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_TABLE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_TABLE_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

#include <cassert>

namespace CGAL::Tandem::internal {

// Loops are over all ids; functors skip those out of use.
//
// Moments follow from the labels: a pass that changes labels adds what joins shapes, and subtracts what leaves them.
// Boxes do not shrink. Fits follow from the moments, and are out of date where these have changed; update_tables()
// makes them again.
template <class Backend>
struct Shape_table {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  // By id, which changes in grow_shapes() only. As it is: for planes and numbers, which follow from nothing, and for
  // fits of the points that a shape had when it was last fitted.
  Buffer<Shape>& table() { return shape_; }
  const Buffer<Shape>& table() const { return shape_; }

  // The shapes: counted() with the moments of the labels, fitted() with fits of these moments as well.
  Shape* counted() { return shape_.data(); }
  const Shape* counted() const { return shape_.data(); }
  Shape* fitted()
  {
    assert(has_fits_);
    return shape_.data();
  }
  const Shape* fitted() const
  {
    assert(has_fits_);
    return shape_.data();
  }

  // The shapes, for a pass that changes moments as it changes labels.
  Shape* change_moments()
  {
    has_fits_ = false;
    return shape_.data();
  }

  // Says that fits are of the moments, for the pass that makes them.
  void set_fitted() { has_fits_ = true; }
  bool has_fits() const { return has_fits_; }

  std::size_t size = 0;              // ids, in use or not; the buffers may have room for more
  Buffer<Plane> plane;               // rounded, for the tests of surfels
  Buffer<std::uint8_t> is_restarted; // grows from all of its surfels in the next pass
  Buffer<Shared_moments> delta;      // what a pass over the surfels adds to each shape; zero between passes

private:
  Buffer<Shape> shape_;
  bool has_fits_ = false;
};

template <class Backend, class F>
void for_each_shape(Backend& backend, const Shape_table<Backend>& shapes, F f)
{
  backend.for_each(shapes.size, f, shapes_per_thread);
}

// By id: which shape each shape becomes. This is itself, another one, or free_label for a shape that is dissolved.
template <class Backend>
using Targets = Buffer_of<Backend, std::uint32_t>;

template <class Backend>
Targets<Backend> identity_targets(Backend& backend, std::size_t n)
{
  Targets<Backend> target(n);
  backend.for_each(n, Fill_ascending{target.data()});
  return target;
}

struct Has_points {
  const Shape* shape;
  std::int64_t minimum_size; // at least 1, which selects the live shapes

  CGAL_TANDEM_HD bool operator()(std::uint32_t id) const { return shape[id].moments.count >= minimum_size; }
};

// --- What a pass over the surfels adds to shapes, or takes from them: sums by shape, zero between two passes.

// Whether anything was added: then the box is not empty, also where as many points came as went.
CGAL_TANDEM_HD inline bool is_any(const Shared_moments& delta) { return delta.box.low[0] <= delta.box.high[0]; }

// The sums of all shapes, zero, for the functors of a pass. `ids` exceeds the number of shapes in a pass of growth,
// which has ids for shapes that may start. Room for half as many more avoids new memory in each pass.
template <class Backend>
Shared_moments* start_deltas(Backend& backend, Shape_table<Backend>& shapes, std::size_t ids)
{
  if(shapes.delta.size() < ids)
    shapes.delta = filled_buffer(backend, ids + ids / 2, Shared_moments());
  return shapes.delta.data();
}

// What a rank has added to a shape.
struct Shape_delta {
  std::uint64_t id; // wide, so that all bytes are defined
  Shared_moments moments;
};

// The sums that are not zero; they are zero afterwards.
struct Take_deltas {
  Shared_moments* delta;

  CGAL_TANDEM_HD bool has(std::uint32_t id) const { return is_any(delta[id]); }

  CGAL_TANDEM_HD Shape_delta take(std::uint32_t id) const
  {
    const Shape_delta taken = {id, delta[id]};
    delta[id] = Shared_moments();
    return taken;
  }
};

template <class Backend>
struct Put_deltas {
  const Shape_delta* added;
  Shared_moments* delta;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Shared_moments& m = added[i].moments;
    atomic_add<Backend>(delta[added[i].id], m.moments(), m.box);
  }
};

// After a pass over the surfels of this rank: the sums of n shapes become those of all ranks. Each has changed few
// shapes.
template <class Backend>
void sum_moments(Backend& backend, const Ranks<Backend>& ranks, std::size_t n, Shared_moments* delta)
{
  if constexpr(Ranks<Backend>::are_many) {
    const auto all = collect_of_all<Shape_delta>(backend, ranks, n, Take_deltas{delta});
    backend.for_each(all.size(), Put_deltas<Backend>{all.data(), delta});
  }
}

template <class Backend>
void sum_deltas(Backend& backend, const Ranks<Backend>& ranks, Shape_table<Backend>& shapes)
{
  sum_moments(backend, ranks, shapes.size, shapes.delta.data());
}

// Adds the sums to moments and boxes, and makes them zero again. A box does not shrink when points leave.
struct Add_deltas {
  Shape* shape;
  Shared_moments* delta;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(!is_any(delta[id]))
      return;
    shape[id].moments += delta[id].moments();
    shape[id].box.add(delta[id].box);
    shape[id].history.is_fitted = false;
    delta[id] = Shared_moments();
  }
};

template <class Backend>
void add_deltas(Backend& backend, Shape_table<Backend>& shapes)
{
  for_each_shape(backend, shapes, Add_deltas{shapes.change_moments(), shapes.delta.data()});
}

struct Start_shape {
  Shape* shape;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { shape[i] = Shape(); }
};

// So many shapes without points more, where tables are read after the loop. Returns the first of their ids, which
// follow each other.
template <class Backend>
std::size_t add_shapes(Backend& backend, Shape_table<Backend>& shapes, std::size_t number)
{
  const std::size_t first = shapes.size, size = first + number;
  if(size > shapes.table().size()) {
    shapes.table() = extended<Shape>(backend, shapes.table(), size + size / 2);
    shapes.plane = extended<Plane>(backend, shapes.plane, size + size / 2);
  }
  shapes.size = size;
  backend.for_each(number, Start_shape{shapes.change_moments() + first});
  return first;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_TABLE_H
