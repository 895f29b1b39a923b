// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cloud with its cells and labels: what passes over the points read and write.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H
#define CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H

#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

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

// The points with a neighbor in another cell, cell by cell.
template <class Backend>
struct Border {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Range> range; // by cell, in these two
  Buffer<std::uint32_t> point;
  Buffer<std::uint32_t> proposal; // the shape that the point joins next, or no_index
};

// Tables of the size of the cloud, or of its cells. They belong to the back end.
template <class Backend>
struct Labeled_cloud {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  explicit Labeled_cloud(Backend& backend) : backend(backend) {}

  std::size_t number_of_cells() const { return cells.size(); }
  Cells_view cells_view() const { return {cells.data(), cell_shapes.data()}; }
  Labels_view labels() { return {label.data(), state.data()}; }

  Backend& backend;
  Sorted_cloud<Backend> cloud;
  Buffer<Range> cells;
  Buffer<Cell_shapes> cell_shapes; // by cell
  Border<Backend> border;
  Buffer<std::uint32_t> label;
  Buffer<std::uint8_t> state;
  Buffer<Sample> sample; // of a Misfit_counter; what it holds between two of them is of no use
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H
