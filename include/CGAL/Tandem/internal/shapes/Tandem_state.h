// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the steps of the loop work on: the cloud, its cells, the labels, and the
// table of shapes. Tables of the size of the cloud belong to the back end. Those of
// the size of the shapes belong to the host, which lends them to the functors.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_TANDEM_STATE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_TANDEM_STATE_H

#include <CGAL/Tandem/internal/backend/host_loops.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/memory/Growing_table.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>
#include <CGAL/Tandem/internal/shapes/Shapes.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The shapes that may have points in a cell, in any order; too many to be listed if `size`
// exceeds the capacity.
struct Cell_shapes {
  static constexpr std::uint32_t capacity = 64;
  std::uint32_t size;
  std::uint32_t shape[capacity];

  template <class Block, class Predicate>
  CGAL_TANDEM_HD bool may_have(Block& block, Predicate is_selected) const
  {
    return size > capacity || block.find_first(0, size, [&](std::uint32_t i) { return is_selected(shape[i]); }) < size;
  }
};

// A point that is asked whether it fits a plane.
struct Sample {
  Grid_point point;
  std::uint32_t shape;
};

// The cells, as the bodies see them.
struct Cells_view {
  const Range* range;
  const Cell_shapes* shapes;

  CGAL_TANDEM_HD const Range& operator[](std::uint32_t c) const { return range[c]; }
};

template <class Backend>
struct Tandem_state {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  explicit Tandem_state(Backend& backend) : backend(backend) {}

  Cells_view cells_view() const { return {cells.data(), cell_shapes.data()}; }

  Labels_view labels() { return {label.data(), state.data()}; }

  Backend& backend;
  Options options;

  Cloud_view cloud;
  std::size_t number_of_cells = 0;
  Buffer<Range> cells;
  Buffer<Cell_shapes> cell_shapes; // per cell
  Buffer<Range> cell_border;       // per cell, its range of `border`
  Buffer<std::uint32_t> border;    // points with a neighbor in another cell
  Buffer<std::uint32_t> proposal;  // parallel to border
  Seeds<Backend> seeds;
  std::vector<std::uint32_t> seed_cursor; // per cell

  Buffer<std::uint32_t> label;
  Buffer<std::uint8_t> state;

  Growing_table<Shape> shapes; // by id, which changes in grow_shapes() only; those not in `live` hold nothing
  Ids live;                    // ascending
  std::vector<Plane> plane;    // these three: the points' view of the shapes; the next two are made in each pass
  std::vector<std::uint16_t> rounds;
  std::vector<std::uint8_t> is_restarted;
  Buffer<Shared_moments> delta; // of each shape, zero between passes
  Buffer<Sample> sample;        // of a Misfit_counter; what it holds between is of no use

  int round = 0;
  std::size_t assigned = 0;   // points that have a shape
  std::size_t peak_bytes = 0; // of the tables of the size of the cloud
};

// Of a shape that has lost its points. What else it holds is of no use.
template <class State>
void clear_shape(State& t, std::uint32_t id)
{
  t.shapes[id].moments = Moments();
  t.is_restarted[id] = 0;
}

// The live shapes with is_chosen(shape, id), which is asked once of each, of many at a time.
template <class Backend, class Predicate>
Ids chosen_shapes(const Tandem_state<Backend>& t, Predicate is_chosen)
{
  return part_on_host(
           t.backend, t.live.size(), [&](std::size_t l) { return t.live[l]; },
           [&](std::uint32_t id) { return is_chosen(t.shapes[id], id); })
    .chosen;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_TANDEM_STATE_H
