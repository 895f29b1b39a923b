// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a result is worth, in points: see score/Score.h and Ratio.h. Labels of rooms and roofs, scenes and layers are
// truest with these and the defaults of simplicity and regularity; the price of a shape may be half or twice as large.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_SCORE_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_SCORE_H

#include <CGAL/Tandem/internal/base/tuning/Ratio.h>

#include <cstdint>

namespace CGAL::Tandem::internal {
namespace tuning {

namespace score {

// A point, in units of the sums.
constexpr std::int64_t unit = 4096;
// What the links of a point to other shapes cost, if all are. Without it noisy faces split into planes that interleave.
constexpr Ratio link = {1, 2};
// What those to free points cost, if all are. Less: planes through clutter stay. More: noisy faces become free.
constexpr Ratio free_link = {3, 2};
// A point far from a plane counts against it as a free one, this factor times d^2 / epsilon^2 if it is at d from its own
// plane: 1 on average for layers of a volume, sqrt(2) epsilon thick. Less: planes through trees support each other.
constexpr std::int64_t own_distance = 6;
// Of a shape, in minimum sizes. From 1 on small faces are missed.
constexpr Ratio price = {3, 10};
// What a degree of freedom is worth grows with the largest shape that has it: for so many of its points, by one of the
// minimum size. Fewer: large faces turn farther, also to directions that are not theirs.
constexpr std::int64_t points_per_freedom = 10;

} // namespace score

// The moves that raise the score.
namespace moves {

// Passes of an assignment; each considers half of the points that have a shape. More: slower, hardly better.
constexpr std::uint32_t assignment_passes = 12;
// Fewest neighbor relations between two shapes that touch. More: thin contacts are missed.
constexpr std::uint32_t minimum_edges = 2;
// Ratio of the points of a shape that may no longer fit if it joins another one, by its sample. Larger: points become
// free that the score of the union outweighs, though they fit their own plane.
constexpr Ratio misfits_of_union = {1, 10};
// A shape that is smaller by this factor may join in the same round as others. Larger: more rounds, the same unions.
constexpr std::int64_t much_larger = 4;
// Points of the sample in which the two planes of a split are sought, and how often they are fitted.
constexpr std::int64_t split_sample = 256;
constexpr int split_steps = 5;

} // namespace moves

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_SCORE_H
