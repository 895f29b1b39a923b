// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cloud with its cells and labels: what passes over the surfels read and write. Surfels are numbered by their
// position in the sorted cloud. A cell is a range of these positions.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H
#define CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace CGAL::Tandem::internal {

// The shapes that may have surfels in a cell, in any order, maybe twice. There are too many to be listed if `size`
// exceeds the capacity. A listed shape may have no surfel there any more; a shape with surfels is never missing.
struct Cell_shapes {
  static constexpr std::uint32_t capacity = 64;
  std::uint32_t size;
  std::uint32_t shape[capacity];

  // Whether the cell may have a surfel of a selected shape; if not, a pass over these shapes can leave it out. Called
  // by all lanes.
  template <class Block, class Predicate>
  CGAL_TANDEM_HD bool may_have(Block& block, Predicate is_selected) const
  {
    return size > capacity || block.find_first(0, size, [&](std::uint32_t i) { return is_selected(shape[i]); }) < size;
  }
};

// The cells in equal parts, one after the other, with the shapes of their cells. Passes that look at surfels one by one
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

struct Border_view {
  const Range* range;
  const std::uint32_t* surfel;
  const std::uint32_t* proposal;
};

// The surfels with a neighbor in another cell, ascending, so cell by cell. Only they can be reached by shapes of other
// cells. `proposal` is new in each pass of growth; the others never change.
template <class Backend>
struct Border {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Range> range; // by cell: its entries in the next two
  Buffer<std::uint32_t> surfel;
  Buffer<std::uint32_t> proposal; // the shape that the surfel joins next, or no_index

  Border_view view() const { return {range.data(), surfel.data(), proposal.data()}; }
};

// When the bits of interior surfels were made. Surfels may have become free since, and shapes may have united,
// but within one phase only.
enum class Phase { none, loop, end };

// Tables of the size of the cloud, or of its cells, in the memory of the back end. Labels and states take 5 bytes a
// surfel. The passes change lists, proposals, labels and states only.
//
// Lists and interior bits follow from the labels. They are out of date when a pass has changed labels, unless it keeps
// them right itself. update_tables() makes them again.
template <class Backend>
struct Labeled_cloud {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  explicit Labeled_cloud(Backend& backend) : backend(backend), ranks(backend) {}

  // The number of points of all ranks.
  std::size_t total_points() const { return ranks.total(cloud.number_of_points()); }
  std::size_t total_cells() const { return ranks.total(cells.size()); }

  std::size_t number_of_cells() const { return cells.size(); }
  std::size_t number_of_parts() const { return cells.size() * parts_of_cell(); }

  // The cells in parts: parts() without lists, which may be out of date, listed_parts() with them.
  Cells_view parts() const { return {cells.data(), nullptr, std::uint32_t(parts_of_cell())}; }
  Cells_view listed_parts() const { return {cells.data(), lists(), std::uint32_t(parts_of_cell())}; }
  Cells_view listed_cells() const { return {cells.data(), lists()}; }

  Cell_shapes* lists() const
  {
    assert(has_lists_);
    return const_cast<Cell_shapes*>(cell_shapes_.data());
  }

  // The lists of all cells, for the pass that makes them.
  Cell_shapes* make_lists()
  {
    if(cell_shapes_.size() != cells.size())
      cell_shapes_.reset(cells.size());
    has_lists_ = true;
    return cell_shapes_.data();
  }
  bool has_lists() const { return has_lists_; }

  const std::uint32_t* label() const { return label_.data(); }
  std::uint8_t* state() { return state_.data(); }

  // Labels and states for a pass that changes them. keeps_lists: whether the pass keeps lists right that are so before
  // it.
  Labels_view change_labels(bool keeps_lists)
  {
    has_lists_ = has_lists_ && keeps_lists;
    return {label_.data(), state_.data()};
  }

  // Makes the tables of labels and states. Afterwards no surfel has a shape.
  void start_labels()
  {
    label_.reset(cloud.size_with_ghosts());
    sent_label_.release();
    state_.reset(cloud.size_with_ghosts());
    has_lists_ = false;
  }

  // Gives ghosts the labels of their surfels, after a pass.
  void refresh_labels(Rings rings = Rings::inner)
  {
    ranks.refresh(label_.data(), sent_label_);
    if(rings == Rings::all)
      ranks.refresh(label_.data(), rings);
  }

  // Begins a phase of the interior bits. Returns whether it is another one than before, so that the bits are to be
  // cleared.
  bool begin_phase(Phase phase) { return std::exchange(phase_, phase) != phase; }

  // For a pass after which the interior bits are no longer right.
  void invalidate_interior() { phase_ = Phase::none; }

  Backend& backend;
  Ranks<Backend> ranks;
  Sorted_cloud<Backend> cloud;
  Buffer<Range> cells;
  Border<Backend> border;

private:
  std::size_t parts_of_cell() const
  {
    constexpr std::size_t maximum = 8, rounds = 4; // of bodies, so that no thread has much more than another one
    const std::size_t bodies = rounds * backend.concurrency(), n = (std::max)(cells.size(), std::size_t(1));
    return (std::min)((bodies + n - 1) / n, maximum);
  }

  Buffer<Cell_shapes> cell_shapes_; // by cell
  Buffer<std::uint32_t> label_;
  Buffer<std::uint32_t> sent_label_; // see Ranks
  Buffer<std::uint8_t> state_;
  bool has_lists_ = false;
  Phase phase_ = Phase::loop;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_LABELED_CLOUD_H
