// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a pass over the points adds to shapes, or takes from them. The sums are in the memory of the back end and zero
// between two passes. The host gets those that are not, so a pass over few shapes copies little.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H

#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/memory/Host_buffer.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The change of one shape: counts and sums may be negative, the box is around all points that came or went.
struct Shape_delta {
  std::uint32_t id;
  std::uint32_t gap = 0; // fills the padding, so that all bytes are defined where deltas are copied
  Shared_moments sums;
};

// Only for new memory: Extract_sums restores the zeros.
struct Clear_sums {
  Shared_moments* sums;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { sums[i] = Shared_moments(); }
};

// Takes the sums of the shapes that a pass has changed, and makes them zero again.
struct Extract_sums {
  Shared_moments* sums; // by id

  // The box is not empty, also where as many points came as went.
  CGAL_TANDEM_HD bool has(std::uint32_t id) const { return sums[id].box.low[0] <= sums[id].box.high[0]; }

  CGAL_TANDEM_HD Shape_delta take(std::uint32_t id) const
  {
    const Shape_delta delta = {id, 0, sums[id]};
    sums[id] = Shared_moments();
    return delta;
  }
};

// The sums of all shapes, zero, for the functors of a pass. `ids` exceeds the number of shapes in a pass of growth,
// which has ids for shapes that may start. Room for half as many more avoids new memory in each pass.
template <class Backend>
Shared_moments* start_deltas(Backend& backend, Shape_table<Backend>& shapes, std::size_t ids)
{
  if(shapes.delta.size() < ids) {
    shapes.delta.reset(ids + ids / 2);
    backend.for_each(shapes.delta.size(), Clear_sums{shapes.delta.data()});
  }
  return shapes.delta.data();
}

// After the pass: the sums of the shapes that it has changed, by rising id, whatever the order in which they came.
template <class Backend>
Host_buffer<Shape_delta> take_deltas(Backend& backend, Shape_table<Backend>& shapes, std::size_t ids)
{
  return backend.template collect<Shape_delta>(ids, Extract_sums{shapes.delta.data()});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H
