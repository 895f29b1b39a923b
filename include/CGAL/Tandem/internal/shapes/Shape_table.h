// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of shapes. Tables of the size of the shapes belong to the host, which gives functors access to them.

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

template <class Backend>
struct Shape_table {
  std::size_t size() const { return shape.size(); }
  Shape& operator[](std::size_t id) { return shape[id]; }
  const Shape& operator[](std::size_t id) const { return shape[id]; }

  // The shape has lost its points. What else it holds is of no use.
  void clear(std::uint32_t id)
  {
    shape[id].moments = Moments();
    is_restarted[id] = 0;
  }

  Growing_table<Shape> shape; // by id, which changes in grow_shapes() only; those not in `live` hold nothing
  Ids live;                   // ascending
  std::vector<Plane> plane;   // these three: the points' view of the shapes; the next two are made in each pass
  std::vector<std::uint16_t> rounds;
  std::vector<std::uint8_t> is_restarted;
  typename Backend::template Buffer<Shared_moments> delta; // of each shape, zero between passes
  std::size_t assigned = 0;                                // points that have a shape
};

// Which shape each shape becomes: itself, another one, or free_label.
using Targets = std::vector<std::uint32_t>;

inline Targets identity_targets(std::size_t shapes)
{
  Targets target(shapes);
  std::iota(target.begin(), target.end(), 0u);
  return target;
}

// The live shapes with is_chosen(shape, id), which is evaluated once for each, for many at a time.
template <class Backend, class Predicate>
Ids chosen_shapes(Backend& backend, const Shape_table<Backend>& shapes, Predicate is_chosen)
{
  return part_on_host(
           backend, shapes.live.size(), [&](std::size_t l) { return shapes.live[l]; },
           [&](std::uint32_t id) { return is_chosen(shapes[id], id); })
    .chosen;
}

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
