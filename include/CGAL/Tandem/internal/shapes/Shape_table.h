// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of shapes. Tables of the size of the shapes belong to the host; functors have access to them during a pass.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_TABLE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_TABLE_H

#include <CGAL/Tandem/internal/backend/host_loops.h>
#include <CGAL/Tandem/internal/memory/Growing_table.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

#include <numeric>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// An id is a place in these tables, and the label of the points of that shape. Ids out of use keep their places until
// grow_shapes() renumbers all shapes.
template <class Backend>
struct Shape_table {
  // Ids, in use or not.
  std::size_t size() const { return shape.size(); }
  Shape& operator[](std::size_t id) { return shape[id]; }
  const Shape& operator[](std::size_t id) const { return shape[id]; }

  // The shape has lost its points. Its other values are undefined from now on; the caller removes it from `live`.
  void clear(std::uint32_t id)
  {
    shape[id].moments = Moments();
    is_restarted[id] = 0;
  }

  Growing_table<Shape> shape; // by id, which changes in grow_shapes() only; those not in `live` are empty
  Ids live;                   // ascending
  // The next three are by id, and are what growth reads of a shape.
  std::vector<Plane> plane;                                // rounded, for the tests of points
  std::vector<std::uint16_t> steps;                        // breadth-first steps of the next pass
  std::vector<std::uint8_t> is_restarted;                  // grows again from all of its points in the next pass
  typename Backend::template Buffer<Shared_moments> delta; // of each shape, zero between passes
  std::size_t assigned = 0;                                // points that have a shape
};

// By id: which shape each shape becomes. This is itself, another one, or free_label for a shape that is dissolved.
using Targets = std::vector<std::uint32_t>;

inline Targets identity_targets(std::size_t shapes)
{
  Targets target(shapes);
  std::iota(target.begin(), target.end(), 0u);
  return target;
}

// The live shapes with is_chosen(shape, id), ascending. It is evaluated once for each, by several threads, so it may
// change that shape.
template <class Backend, class Predicate>
Ids chosen_shapes(Backend& backend, const Shape_table<Backend>& shapes, Predicate is_chosen)
{
  return part_on_host(
           backend, shapes.live.size(), [&](std::size_t l) { return shapes.live[l]; },
           [&](std::uint32_t id) { return is_chosen(shapes[id], id); })
    .chosen;
}

// Afterwards `live` lists the shapes with points only. No label changes.
template <class Backend>
void drop_empty_shapes(Backend& backend, Shape_table<Backend>& shapes)
{
  shapes.live = chosen_shapes(backend, shapes, [&](const Shape& shape, std::uint32_t id) {
    const bool is_empty = shape.moments.count == 0;
    if(is_empty)
      shapes.clear(id);
    return !is_empty;
  });
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_TABLE_H
