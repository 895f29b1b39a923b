// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cloud with its cells and labels: what passes over the points read and write. Points are numbered by their
// position in the sorted cloud. A cell is a range of these positions.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H
#define CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

#include <algorithm>

namespace CGAL {
namespace Tandem {
namespace internal {

// The shapes that may have points in a cell, in any order, maybe twice. There are too many to be listed if `size`
// exceeds the capacity. A listed shape may have lost its points; a shape with points is never missing.
struct Cell_shapes {
  static constexpr std::uint32_t capacity = 64;
  std::uint32_t size;
  std::uint32_t shape[capacity];

  // By all lanes. Where it is false, a pass over the selected shapes can leave out the cell.
  template <class Block, class Predicate>
  CGAL_TANDEM_HD bool may_have(Block& block, Predicate is_selected) const
  {
    return size > capacity || block.find_first(0, size, [&](std::uint32_t i) { return is_selected(shape[i]); }) < size;
  }
};

// A point that is tested against planes of its shape. A copy, so that repeated tests read consecutive memory.
struct Sample {
  Grid_point point;
  std::uint32_t place; // of its shape among the tested ones
};

// The cells in equal parts, one after the other, with the shapes of their cells. Passes that look at points one by one
// are over parts, so that small clouds occupy a whole device.
struct Cells_view {
  const Range* range;
  const Cell_shapes* shapes;
  std::uint32_t parts = 1; // of each cell

  CGAL_TANDEM_HD Range operator[](std::uint32_t p) const
  {
    const Range cell = range[p / parts];
    const std::uint32_t part = p % parts;
    return {cell.first + cell.size() * part / parts, cell.first + cell.size() * (part + 1) / parts};
  }

  template <class Block, class Predicate>
  CGAL_TANDEM_HD bool may_have(Block& block, std::uint32_t p, Predicate is_selected) const
  {
    return shapes[p / parts].may_have(block, is_selected);
  }
};

// The points with a neighbor in another cell, ascending, so cell by cell. Only they can be reached by shapes of other
// cells. `proposal` is new in each pass of growth; the others never change.
template <class Backend>
struct Border {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Range> range; // by cell: its entries in the next two
  Buffer<std::uint32_t> point;
  Buffer<std::uint32_t> proposal; // the shape that the point joins next, or no_index
};

// Tables of the size of the cloud, or of its cells, in the memory of the back end. Labels and states take 5 bytes a
// point, samples 20 each while they are in use. The passes change lists, proposals, labels, states and samples only.
template <class Backend>
struct Labeled_cloud {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  explicit Labeled_cloud(Backend& backend) : backend(backend), ranks(backend) {}

  // Of all ranks.
  std::size_t total_points() const { return ranks.total(cloud.size()); }
  std::size_t total_cells() const { return ranks.total(cells.size()); }

  std::size_t number_of_cells() const { return cells.size(); }
  Cells_view cells_view() const { return {cells.data(), cell_shapes.data()}; }

  std::size_t number_of_parts() const { return cells.size() * parts_of_cell(); }
  Cells_view parts_view() const { return {cells.data(), cell_shapes.data(), std::uint32_t(parts_of_cell())}; }
  Labels_view labels() { return {label.data(), state.data()}; }

  Backend& backend;
  Ranks<Backend> ranks;
  Sorted_cloud<Backend> cloud;
  Buffer<Range> cells;
  Buffer<Cell_shapes> cell_shapes; // by cell
  Border<Backend> border;
  Buffer<std::uint32_t> label;
  Buffer<std::uint8_t> state;
  Buffer<Sample> sample; // of a Misfit_counter; between two of them its contents are undefined

private:
  std::size_t parts_of_cell() const
  {
    constexpr std::size_t maximum = 8;
    const std::size_t bodies = backend.concurrency(), n = (std::max)(cells.size(), std::size_t(1));
    return (std::min)((bodies + n - 1) / n, maximum);
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H
