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

// The tighter bounds by which equally planar seeds are ordered, as fractions of epsilon and alpha. Larger: seeds near
// edges and steps, where a plane bridges two surfaces.
constexpr double tight_distance_fraction = 1. / 4;
constexpr double tight_angle_fraction = 1. / 2;
// Neighbors that have to fit the plane of a seed.
constexpr Ratio seed_ratio = {1, 2};
// Shapes that may grow in a cell for a new one to begin, in the first rounds and later. The paper has one. More: fewer
// rounds at the same quality; many more in the first rounds: shapes do not meet the faces they belong to.
constexpr int young_seeds_in_flight = 8;
constexpr int maximum_seeds_in_flight = 32;
// Seeds of a cell that may fail in one pass. More: clutter is searched longer.
constexpr int seed_tries = 64;
// The core of a new shape: one point of so many of the neighbors and the seed, but at most one of so many of a full
// cell.
constexpr std::size_t neighbors_per_core_point = 2;
constexpr std::size_t cell_points_per_core_point = 8;
// Breadth-first steps of a shape: 1, 2, 4, ... in its first passes, so many, then as many as in the last of them. More
// at first: immature planes grow over noise. Regularizing young shapes often is what keeps directions few.
constexpr int doubling_passes = 9;
constexpr int maximum_steps = 1 << (doubling_passes - 1);

} // namespace growth

// The loop of rounds, and when it ends.
namespace loop {

// A bound on the rounds, which scans do not reach: they take 6 to 8.
constexpr int maximum_rounds = 300;
// In the first rounds all shapes are small: one pass each, and the loop does not end by slow growth.
constexpr int young_rounds = 4;
// A round is slow when large shapes have grown by at most one point of so many of the cloud. A slow
// round in which no cell is untried ends the loop. Larger: the loop goes on for little; smaller: faces behind patches
// are missed.
constexpr std::size_t points_per_slow_point = 32;
// Passes of growth in a round, at most. There is a next one while more than one cell of so many is untried.
constexpr int maximum_passes = 9;
constexpr std::size_t cells_per_untried_cell = 64;
// A cell is untried with as many candidates as the smallest shape has points, or with more than one in so many of its
// points.
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

// Planes that move by less need no new check of the points and no new links. Larger: faster,
// points are checked late.
constexpr double negligible = 0.02;
// Planes that move by more let the shape grow again from all of its points. Smaller: more rounds.
constexpr double restart = 0.1;

} // namespace motion

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_GROWTH_H
