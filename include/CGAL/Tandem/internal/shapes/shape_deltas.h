// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What shapes gain or lose in a pass over the points. The sums belong to the back
// end and are zero between two passes; the host gets those that are not.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H

#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/memory/Host_buffer.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Shape_delta {
  std::uint32_t id;
  std::uint32_t gap = 0; // without it there were bytes that nobody writes
  Shared_moments sums;
};

struct Clear_sums {
  Shared_moments* sums;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { sums[i] = Shared_moments(); }
};

// Takes the sums of the shapes that a pass has met.
struct Take_sums {
  Shared_moments* sums;

  CGAL_TANDEM_HD bool has(std::uint32_t id) const { return sums[id].box.low[0] <= sums[id].box.high[0]; }

  CGAL_TANDEM_HD Shape_delta take(std::uint32_t id) const
  {
    const Shape_delta delta = {id, 0, sums[id]};
    sums[id] = Shared_moments();
    return delta;
  }
};

// The sums of all shapes, zero, to be handed to the functors of a pass. A growth pass has more
// ids than shapes.
template <class Backend>
Shared_moments* start_deltas(Backend& backend, Shape_table<Backend>& shapes, std::size_t ids)
{
  if(shapes.delta.size() < ids) {
    shapes.delta.reset(ids + ids / 2);
    backend.for_each(shapes.delta.size(), Clear_sums{shapes.delta.data()});
  }
  return shapes.delta.data();
}

// After the pass: the sums of the shapes that it has met, by id.
template <class Backend>
Host_buffer<Shape_delta> take_deltas(Backend& backend, Shape_table<Backend>& shapes, std::size_t ids)
{
  return backend.template collect<Shape_delta>(ids, Take_sums{shapes.delta.data()});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_DELTAS_H
