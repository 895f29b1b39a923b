// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a pass over the points adds to shapes, or takes from them: sums by shape, zero between two passes.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H

#include <CGAL/Tandem/internal/shapes/Shape_table.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Where anything was added the box is not empty, also where as many points came as went.
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

struct Count_deltas {
  const Shared_moments* delta;

  CGAL_TANDEM_HD void operator()(std::size_t id, std::int64_t* sum) const { sum[0] += is_any(delta[id]); }
};

// How many shapes a pass has changed.
template <class Backend>
std::size_t count_deltas(Backend& backend, const Shape_table<Backend>& shapes)
{
  return std::size_t(backend.template sum<1>(shapes.size, Count_deltas{shapes.delta.data()})[0]);
}

// Adds the sums to moments and boxes, and makes them zero again. A lost point does not shrink a box.
struct Add_deltas {
  Shape* shape;
  Shared_moments* delta;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(!is_any(delta[id]))
      return;
    shape[id].moments += delta[id].moments();
    shape[id].box.add(delta[id].box);
    shape[id].history.set_fitted(false);
    delta[id] = Shared_moments();
  }
};

template <class Backend>
void add_deltas(Backend& backend, Shape_table<Backend>& shapes)
{
  for_each_shape(backend, shapes, Add_deltas{shapes.change_moments(), shapes.delta.data()});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H
