// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Counters of one cell in fast memory, in front of a table of all cells. They change nothing but these counts.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_COUNT_SCRATCH_H
#define CGAL_TANDEM_INTERNAL_SHAPES_COUNT_SCRATCH_H

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Numbers of points of a cell, by key: a shape or a query. The slot of a key is key % slots. The first key that reaches
// a slot owns it; other keys of that slot are counted in the table of all cells. Which key owns a slot
// depends on the order of the lanes. The sums do not, since they are sums of integers.
struct Count_scratch {
  static constexpr std::uint32_t slots = 64;
  std::uint32_t key[slots];
  std::uint32_t count[slots];

  // Empties the slots. Called by all lanes, before the first add() of a cell.
  template <class Block>
  CGAL_TANDEM_HD void clear(Block& block)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      key[i] = no_index;
      count[i] = 0;
    });
  }

  // Counts so many points, by one lane. total: by key, shared by all cells.
  template <class Backend, class Block, class Total>
  CGAL_TANDEM_HD void add(Block& block, std::uint32_t k, std::uint32_t points, Total* total)
  {
    const std::uint32_t slot = k % slots;
    const std::uint32_t owner = block.exchange_if(key[slot], no_index, k);
    if(owner == no_index || owner == k)
      block.add(count[slot], points);
    else
      Backend::atomic_add(total[k], Total(points));
  }

  // Adds the slots to the table of all cells. Called by all lanes, after the last add(): one atomic addition for each
  // key of the cell, not for each point.
  template <class Backend, class Block, class Total>
  CGAL_TANDEM_HD void flush(Block& block, Total* total)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      if(count[i] > 0)
        Backend::atomic_add(total[key[i]], Total(count[i]));
    });
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_COUNT_SCRATCH_H
