// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the growth inside one octree cell reads and writes: shapes, seeds, and its scratch memory.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_CELL_JOB_H
#define CGAL_TANDEM_INTERNAL_GROWTH_CELL_JOB_H

#include <CGAL/Tandem/internal/base/tuning/growth.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Growth_options.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What growth uses of the shapes during one pass: plain arrays, by shape. A cell writes the entries of its new shapes
// only; to the sums of the others all cells add atomically.
struct Shapes_view {
  Plane* plane;
  std::uint16_t* steps;             // breadth-first steps of this pass
  const std::uint8_t* is_restarted; // all of its points are on the frontier
  Shared_moments* delta;            // what the pass adds
};

// The part of one cell in a pass. Points are positions in the sorted cloud.
struct Cell_job {
  Range cell;
  const std::uint32_t* border;   // its points with a neighbor in another cell ...
  const std::uint32_t* proposal; // ... and the shapes that they join first, or no_index
  std::uint32_t border_size;
  const std::uint32_t* seed; // candidates
  std::uint32_t seed_count;
  std::uint32_t* seed_cursor; // candidates before it are used up
  std::uint32_t new_shape;    // the ids from here on are those of new shapes
  bool has_restarted = true;  // maybe: some shape grows again from all of its points
};

// A candidate that is tried, as in the manual, "Growth". A plane is fitted to the seed and those of its free neighbors
// that fit its own plane. Those that fit the new plane are the core of a new shape, unless they are too few.
struct Trial {
  std::uint32_t at, seed; // the seed among the candidates, and the point
  bool is_candidate;      // still: no shape that has begun meanwhile may reach it
  Plane plane;            // of the seed, then of the core
  Cell_moments sums;      // of the points of what fits the first ...
  std::uint32_t count;    // ... and the surfels that fit the second, ...
  std::uint32_t points;   // ... and their points
  std::uint32_t lost;     // points, of the seed and its neighbors, that shapes have taken since
};
// Of the blocks of all back ends: what the scratch memory has room for.
constexpr std::uint32_t maximum_lookahead = 32;

// Shared by the lanes of a block. Places in the queue are given in any order, so nothing may depend on them.
template <std::uint32_t CellSize>
struct Growth_scratch {
  std::uint16_t queue[CellSize]; // cell-relative points; each is queued at most once
  std::uint32_t tail;            // of the queue: its size
  Moment_table table;
  std::uint32_t active[tuning::growth::maximum_seeds_in_flight]; // shapes on the frontier of this cell, ascending
  std::uint32_t active_count;
  Trial trial[maximum_lookahead];
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_CELL_JOB_H
