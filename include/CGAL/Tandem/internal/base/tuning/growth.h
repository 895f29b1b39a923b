// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Growth, and the loop of rounds. See Ratio.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_GROWTH_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_GROWTH_H

#include <CGAL/Tandem/internal/base/tuning/Ratio.h>

#include <cstddef>
#include <cstdint>

namespace CGAL::Tandem::internal {
namespace tuning {

// Seeds, and growth inside the octree cells (section 3 of the paper).
namespace growth {

// Neighbors that have to fit the plane of a seed.
constexpr Ratio seed_ratio = {1, 2};
// Shapes that may start in a cell in one pass. The paper has one. More: fewer rounds at the same quality.
constexpr std::uint32_t seeds_per_cell = 32;
// Seeds of a cell that may fail in one pass. More: clutter is searched longer.
constexpr int seed_tries = 64;
// The core of a new shape: one point of so many of the neighbors and the seed, but at most one of so many of a full
// cell.
constexpr std::size_t neighbors_per_core_point = 2;
constexpr std::size_t cell_points_per_core_point = 8;

} // namespace growth

// The loop of rounds, and when it ends.
namespace loop {

// A bound on the rounds, which scans do not reach: they take 2 to 4.
constexpr int maximum_rounds = 300;
// The loop ends after the growth of a round in which at most one point of so many of the cloud got a shape. Larger: the
// loop goes on for little, since surfels find their shapes in the end game, too.
constexpr std::size_t points_per_new_point = 32;
// Passes of growth in a round, at most. There is a next one while a cell is untried: it has as many candidates as the
// smallest shape has points, or more than one in so many of its points.
constexpr int maximum_passes = 9;
constexpr std::uint32_t points_per_untried_point = 4;
// Sizes as ratios of the minimum region size. Shapes below the ratio, or below the number of points, are
// dissolved when they stop growing, unless the minimum size is less. Larger: parts of faces become free before they
// meet.
constexpr Ratio fragment_ratio = {3, 20};
constexpr std::int64_t minimum_fragment_size = 6;
// Smaller shapes get no relations in the loop: while they are young they tilt more than what they would be related to.
constexpr Ratio related_ratio = {7, 20};

} // namespace loop

// Motion of planes, in epsilons over the bounding box of the shape.
namespace motion {

// Planes that move by less need no new check of the points and no new links, and stay in the end game. Larger: faster,
// points are checked late.
constexpr double negligible = 0.02;
// Planes that move by more let the shape grow again from all of its points. Smaller: more rounds.
constexpr double restart = 0.1;

} // namespace motion

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_GROWTH_H
