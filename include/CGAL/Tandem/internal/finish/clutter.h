// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes through clutter: their points have many neighbors off the plane.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_CLUTTER_H
#define CGAL_TANDEM_INTERNAL_FINISH_CLUTTER_H

#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Neighbor_counts {
  std::uint64_t all = 0;  // neighbors of the points of a shape, but those of other crisp shapes
  std::uint64_t near = 0; // ... within epsilon of its plane, whatever their shape
  std::uint64_t own = 0;  // ... that belong to it
};

struct Neighbor_scratch {
  static constexpr std::uint32_t slots = 64;
  std::uint32_t shape[slots];
  std::uint32_t all[slots], near[slots], own[slots]; // of a cell: at most 2^16 points of 64 neighbors
};

template <class Backend>
struct Count_neighbors {
  Cloud_view cloud;
  const Range* cells;
  const std::uint32_t* label;
  const Plane* plane;           // by shape, as are these
  const std::uint8_t* is_crisp; // its points are close to its plane, unlike those of planes through clutter
  Neighbor_counts* counts;
  std::int64_t distance;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Neighbor_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    block.for_each(Neighbor_scratch::slots, [&](std::uint32_t i) {
      scratch.shape[i] = no_index;
      scratch.all[i] = scratch.near[i] = scratch.own[i] = 0;
    });
    block.for_each(cell.size(), [&](std::uint32_t at) { visit(block, scratch, cell.first + at); });
    block.for_each(Neighbor_scratch::slots, [&](std::uint32_t i) {
      if(scratch.shape[i] != no_index)
        add(scratch.shape[i], scratch.all[i], scratch.near[i], scratch.own[i]);
    });
  }

private:
  CGAL_TANDEM_HD void add(std::uint32_t s, std::uint32_t all, std::uint32_t near, std::uint32_t own) const
  {
    Backend::atomic_add(counts[s].all, std::uint64_t(all));
    Backend::atomic_add(counts[s].near, std::uint64_t(near));
    Backend::atomic_add(counts[s].own, std::uint64_t(own));
  }

  template <class Block>
  CGAL_TANDEM_HD void visit(Block& block, Neighbor_scratch& scratch, std::uint32_t i) const
  {
    const std::uint32_t s = label[i];
    if(s >= first_mark)
      return;
    const std::uint32_t* row = cloud.row(i);
    std::uint32_t all = 0, near = 0, own = 0;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t other = label[row[j]];
      const bool is_own = other == s;
      const bool is_neutral = !is_own && other < first_mark && is_crisp[other]; // the other side of a thin plate, say
      all += !is_neutral;
      own += is_own;
      near += is_own || (!is_neutral && is_near(plane[s], cloud.point[row[j]], distance));
    }
    const std::uint32_t slot = s % Neighbor_scratch::slots;
    const std::uint32_t owner = block.exchange_if(scratch.shape[slot], no_index, s);
    if(owner != no_index && owner != s)
      return add(s, all, near, own);
    block.add(scratch.all[slot], all);
    block.add(scratch.near[slot], near);
    block.add(scratch.own[slot], own);
  }
};

// rms: of the distances to the plane, in epsilons.
inline bool is_clutter(const Neighbor_counts& c, double rms)
{
  using namespace tuning::clutter;
  const double all = c.all > 0 ? double(c.all) : 1;
  const double near = double(c.near) / all, own = double(c.own) / all;
  return near < near_share || (own < own_share && near < near_share_if_few_own) ||
         (rms > large_rms && near < near_share_if_large_rms);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_CLUTTER_H
