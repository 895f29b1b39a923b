// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the growth inside one octree leaf works on: shapes, seeds, and its scratch memory.

#ifndef CGAL_TANDEM_INTERNAL_CELL_JOB_H
#define CGAL_TANDEM_INTERNAL_CELL_JOB_H

#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/Moment_table.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What the shapes look like to the points during one pass: plain arrays, by shape.
struct Shapes_view {
  Plane* plane;
  std::uint16_t* rounds;            // breadth-first rounds of this pass
  const std::uint8_t* is_restarted; // all of its points are on the frontier
  Shared_moments* gain;             // what the pass adds
};

struct Growth_options {
  Tolerance tolerance;
  int seeds_in_flight;     // most shapes that may be growing in a leaf for a new one to begin
  int seed_tries;          // candidates that may fail in one pass
  std::uint32_t core_size; // fewest points that a shape begins with
};

// The part of one leaf in a pass.
struct Cell_job {
  Range cell;
  const std::uint32_t* border;   // its points with a neighbor in another leaf ...
  const std::uint32_t* proposal; // ... and the shapes that they join first, or no_index
  std::uint32_t border_size;
  const std::uint32_t* seed; // candidates
  std::uint32_t seed_count;
  std::uint32_t* seed_cursor; // candidates before it are used up
  std::uint32_t new_shape;    // the ids from here on are those of new shapes
  bool has_restarted = true;  // maybe: some shape grows again from all of its points
};

constexpr int young_seeds_in_flight = 8; // in the first rounds
constexpr int most_seeds_in_flight = 32;

// Points of a leaf, at most: the queue of a small one fits into fast memory.
constexpr std::uint32_t small_cell = 8192;
constexpr std::uint32_t largest_cell = 65536;

// A candidate that is tried: the seed and its free neighbors that fit its plane, then those that fit the plane
// through them, are the core of a new shape, unless they are too few.
struct Trial {
  std::uint32_t at, seed; // the seed among the candidates, and the point
  bool is_candidate;      // still: no shape that has begun meanwhile may reach it
  Plane plane;            // of the seed, then of the core
  Cell_moments sums;      // of what fits the first ...
  std::uint32_t count;    // ... and the second
  std::uint32_t lost;     // points, of the seed and its neighbors, that shapes have taken since
};
constexpr std::uint32_t most_lookahead = 32;

template <std::uint32_t CellSize>
struct Growth_scratch {
  std::uint16_t queue[CellSize]; // cell-relative points; each is queued at most once
  std::uint32_t tail;
  Moment_table table;
  std::uint32_t active[most_seeds_in_flight]; // shapes on the frontier of this leaf, ascending
  std::uint32_t active_count;
  Trial trial[most_lookahead];
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CELL_JOB_H
