// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes have points in which cell. Most passes between two passes of growth are about few shapes. They
// leave out the cells without points of those. Changes the lists of the cells, nothing else.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_CELL_SHAPES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_CELL_SHAPES_H

#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// A hash set of shapes with linear probing; twice the capacity of a list keeps probes short.
struct List_scratch {
  static constexpr std::uint32_t slots = 2 * Cell_shapes::capacity;
  std::uint32_t shape[slots];
};

// The shape that a lane has met last. Neighbors on the curve mostly share their shape, which is then looked up once.
struct Last_shape {
  std::uint32_t shape = no_index;
};

// Makes the list of a cell from the labels of its points. Lanes append in any order: only membership is read.
struct List_shapes {
  const Range* cells;
  const std::uint32_t* label; // by position
  Cell_shapes* list;          // by cell

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, List_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    Cell_shapes& shapes = list[c];
    block.single([&] { shapes.size = 0; });
    block.for_each(List_scratch::slots, [&](std::uint32_t i) { scratch.shape[i] = no_index; });
    block.template accumulate<Last_shape>(
      cell.size(),
      [&](std::uint32_t at, Last_shape& last) {
        const std::uint32_t s = label[cell.first + at];
        if(s >= first_mark || s == last.shape)
          return;
        last.shape = s;
        if(!is_new(block, scratch, s))
          return;
        const std::uint32_t place = block.append(shapes.size);
        if(place < Cell_shapes::capacity)
          shapes.shape[place] = s;
      },
      [](const Last_shape&) {});
  }

private:
  // True for exactly one lane of each shape: the exchange succeeds once. Where the set is full, every shape counts as
  // new, as the list has overflown by then.
  template <class Block>
  CGAL_TANDEM_HD static bool is_new(Block& block, List_scratch& scratch, std::uint32_t s)
  {
    for(std::uint32_t probe = 0; probe < List_scratch::slots; ++probe) {
      const std::uint32_t old = block.exchange_if(scratch.shape[(s + probe) % List_scratch::slots], no_index, s);
      if(old == no_index || old == s)
        return old == no_index;
    }
    return true;
  }
};

template <class Backend>
void list_shapes(Labeled_cloud<Backend>& points)
{
  points.backend.template for_each_cell<List_scratch>(
    points.number_of_cells(), List_shapes{points.cells.data(), points.label(), points.make_lists()});
}

// Replaces the shapes of a list by their targets; those with a mark leave it. Merged shapes may be listed twice. A list
// that has overflown stays so: it stands for all shapes. `labels`, shared by the lanes, has room for a list.
template <class Block>
CGAL_TANDEM_HD void relabel_list(Block& block, Cell_shapes& list, const std::uint32_t* target, std::uint32_t* labels)
{
  const std::uint32_t size = list.size;
  if(size > Cell_shapes::capacity)
    return;
  block.for_each(size, [&](std::uint32_t i) { labels[i] = target[list.shape[i]]; });
  block.single([&] { list.size = 0; });
  block.for_each(size, [&](std::uint32_t i) {
    if(labels[i] < first_mark)
      list.shape[block.append(list.size)] = labels[i];
  });
}

// For cells without labeled points.
struct Clear_lists {
  Cell_shapes* lists;

  CGAL_TANDEM_HD void operator()(std::size_t c) const { lists[c].size = 0; }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_CELL_SHAPES_H
