// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes are slabs of clutter: few neighbors of their points belong to them. The price of links cannot remove
// them, since slabs hold each other. Counts and decides only; extract_shapes.h frees the points. See the manual, "Slabs
// of Clutter".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_OWN_NEIGHBORS_H
#define CGAL_TANDEM_INTERNAL_FINISH_OWN_NEIGHBORS_H

#include <CGAL/Tandem/internal/base/tuning/score.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Links of the points of one shape: those of its points to each other, and all of them. Each point has up to 64, so the
// sums need 64 bits.
namespace neighbor_counts {
enum Count { own, all, size };
} // namespace neighbor_counts

// The counts of one cell, by id of the shape modulo `slots`. The first shape that claims a slot keeps it for this cell.
// 32 bits suffice, since a cell has at most 2^16 points of 64 neighbors.
struct Neighbor_scratch {
  static constexpr std::uint32_t slots = 64;
  std::uint32_t shape[slots];
  std::uint32_t own[slots], all[slots];
};

// For each cell, counts the neighbors of its labeled points by the shape of the point. Reads labels, and
// writes only `counts`. These are integer sums, so the order of cells and points does not matter.
template <class Backend>
struct Count_neighbors {
  Cloud_view cloud;
  const Range* cells;
  const std::uint32_t* label;
  std::uint64_t* counts; // by shape, neighbor_counts::size each

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Neighbor_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    block.for_each(Neighbor_scratch::slots, [&](std::uint32_t i) {
      scratch.shape[i] = no_index;
      scratch.own[i] = scratch.all[i] = 0;
    });
    block.for_each(cell.size(), [&](std::uint32_t at) { visit(block, scratch, cell.first + at); });
    block.for_each(Neighbor_scratch::slots, [&](std::uint32_t i) {
      if(scratch.shape[i] != no_index)
        add(scratch.shape[i], scratch.own[i], scratch.all[i]);
    });
  }

private:
  // Directly to the sums of all cells: at the end of a cell, and for a shape whose slot another shape has.
  CGAL_TANDEM_HD void add(std::uint32_t s, std::uint32_t own, std::uint32_t all) const
  {
    std::uint64_t* const c = counts + std::size_t(s) * neighbor_counts::size;
    Backend::atomic_add(c[neighbor_counts::own], std::uint64_t(own));
    Backend::atomic_add(c[neighbor_counts::all], std::uint64_t(all));
  }

  template <class Block>
  CGAL_TANDEM_HD void visit(Block& block, Neighbor_scratch& scratch, std::uint32_t i) const
  {
    const std::uint32_t s = label[i];
    if(s >= first_mark)
      return;
    const std::uint32_t* row = cloud.row(i);
    std::uint32_t own = 0, all = 0;
    for(; int(all) < cloud.k && row[all] != no_index; ++all)
      own += label[row[all]] == s;
    const std::uint32_t slot = s % Neighbor_scratch::slots;
    const std::uint32_t owner = block.exchange_if(scratch.shape[slot], no_index, s);
    if(owner != no_index && owner != s)
      return add(s, own, all);
    block.add(scratch.own[slot], own);
    block.add(scratch.all[slot], all);
  }
};

// Of a shape with these counts.
inline bool has_few_own_neighbors(const std::uint64_t* counts)
{
  constexpr tuning::Share least = tuning::moves::own_neighbors;
  return !least.is_reached(std::int64_t(counts[neighbor_counts::own]), std::int64_t(counts[neighbor_counts::all]));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_OWN_NEIGHBORS_H
