// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sums of the points that join or leave shapes in a pass, and numbers of points. They are gathered for each cell in a
// small table, and added to the shapes at its end. All sums are of integers, so neither order nor number of threads
// matters.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_MOMENT_TABLE_H
#define CGAL_TANDEM_INTERNAL_SHAPES_MOMENT_TABLE_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL::Tandem::internal {

// --- Counters of one cell in fast memory, in front of a table of all cells. They change nothing but these counts.

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

// --- The moments of shapes.

// A shape's moments and bounds while many threads add to them, in grid steps. There is no atomic addition of 128 bits,
// so the words of a product are added one by one. An overflow of the low word is seen by exactly one thread, which adds
// the carry. So the words are right when all threads are done, but not before.
struct Shared_moments {
  std::int64_t count = 0;
  std::int64_t squared_tolerances = 0;
  std::int64_t sum[3] = {0, 0, 0};
  std::uint64_t low[6] = {0, 0, 0, 0, 0, 0};
  std::uint64_t high[6] = {0, 0, 0, 0, 0, 0};
  Box box;

  CGAL_TANDEM_HD Moments moments() const
  {
    Moments m;
    m.count = count;
    m.squared_tolerances = squared_tolerances;
    for(int i = 0; i < 3; ++i)
      m.sum[i] = sum[i];
    for(int i = 0; i < 6; ++i)
      m.product[i] = Int128(static_cast<unsigned __int128>(high[i]) << 64 | low[i]);
    return m;
  }
};

template <class Backend>
CGAL_TANDEM_HD void atomic_add(Shared_moments& target, const Moments& m, const Box& box)
{
  Backend::atomic_add(target.count, m.count);
  Backend::atomic_add(target.squared_tolerances, std::int64_t(m.squared_tolerances));
  for(int i = 0; i < 3; ++i) {
    Backend::atomic_add(target.sum[i], m.sum[i]);
    Backend::atomic_min(target.box.low[i], box.low[i]);
    Backend::atomic_max(target.box.high[i], box.high[i]);
  }
  for(int i = 0; i < 6; ++i) {
    const std::uint64_t low = std::uint64_t(m.product[i]);
    const std::uint64_t before = Backend::atomic_add(target.low[i], low);
    const std::uint64_t carry = before + low < before;
    Backend::atomic_add(target.high[i], std::uint64_t(m.product[i] >> 64) + carry);
  }
}

// The sum of consecutive points of one shape. Neighbors on the curve mostly share their shape, so a lane adds to the
// table once for many points.
struct Shape_run {
  std::uint32_t shape = no_index;
  Cell_moments moments;
  Box box;

  // One point, by its place among those of all surfels. base: any point of the cell, the same for all runs. sign: 1 for
  // points that come, -1 for points that go. The box grows with both: it bounds what has changed.
  CGAL_TANDEM_HD void add_point(const Surfels_view& surfels, std::uint32_t at, const Grid_point& base, int sign)
  {
    const Grid_point& p = surfels.point[at];
    moments.add(std::int64_t(p.x) - base.x, std::int64_t(p.y) - base.y, std::int64_t(p.z) - base.z, sign,
                surfels.level_of_point(at));
    box.add(p);
  }

  // The points of surfel i.
  CGAL_TANDEM_HD void add(const Surfels_view& surfels, std::uint32_t i, const Grid_point& base, int sign)
  {
    const Range points = surfels.points(i);
    for(std::uint32_t at = points.first; at < points.last; ++at)
      add_point(surfels, at, base, sign);
  }
};

// The sums of all shapes, as a cell adds to them. Its moments are relative to one of its points: there the products fit
// 64 bits (see cell_extent_bits). They are shifted to the origin of the grid once for each shape and cell.
struct Cell_sums {
  const Surfels_view& surfels;
  const Grid_point& base;
  Shared_moments* sum; // by shape

  template <class Backend>
  CGAL_TANDEM_HD void add(std::uint32_t s, const Cell_moments& m, const Box& box) const
  {
    atomic_add<Backend>(sum[s], shifted(m, base.x, base.y, base.z), box);
  }
};

// The sums of a cell by shape, with open addressing and at most eight probes. What finds no slot goes to the shape at
// once. Which shapes have slots depends on the lanes; the sums do not.
struct Moment_table {
  static constexpr std::uint32_t slots = 64;

  std::uint32_t shape[slots];
  Cell_moments moments[slots];
  Box box[slots];

  template <class Block>
  CGAL_TANDEM_HD void clear(Block& block)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      shape[i] = no_index;
      moments[i] = Cell_moments();
      box[i] = Box();
    });
  }

  // The slot of shape s, or `slots` if eight others are taken. A slot never changes its owner, so all lanes find the
  // same slot for a shape.
  template <class Block>
  CGAL_TANDEM_HD std::uint32_t claim(Block& block, std::uint32_t s)
  {
    for(std::uint32_t probe = 0; probe < 8; ++probe) {
      const std::uint32_t slot = (s + probe) % slots;
      const std::uint32_t old = block.exchange_if(shape[slot], no_index, s);
      if(old == no_index || old == s)
        return slot;
    }
    return slots;
  }

  // Adds a run of points of one shape, by one lane.
  template <class Backend, class Block>
  CGAL_TANDEM_HD void add(Block& block, const Shape_run& run, const Cell_sums& target)
  {
    if(run.shape == no_index)
      return;
    const std::uint32_t slot = claim(block, run.shape);
    if(slot == slots)
      return target.template add<Backend>(run.shape, run.moments, run.box);
    block.add_moments(moments[slot], run.moments);
    block.add_box(box[slot], run.box);
  }

  // Adds the points of surfel i to shape s, by one lane.
  template <class Backend, class Block>
  CGAL_TANDEM_HD void add(Block& block, std::uint32_t s, std::uint32_t i, int sign, const Cell_sums& target)
  {
    Shape_run run;
    run.shape = s;
    run.add(target.surfels, i, target.base, sign);
    add<Backend>(block, run, target);
  }

  // Adds the sums of the cell to those of the shapes. Called by all lanes, after the last add(). Only here do cells
  // share memory, with atomic additions.
  template <class Backend, class Block>
  CGAL_TANDEM_HD void flush(Block& block, const Cell_sums& target)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      if(shape[i] != no_index)
        target.template add<Backend>(shape[i], moments[i], box[i]);
    });
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_MOMENT_TABLE_H
