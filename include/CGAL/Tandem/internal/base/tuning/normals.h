// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals where the caller gives none, and edge sides. See Ratio.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_NORMALS_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_NORMALS_H

#include <CGAL/Tandem/internal/base/tuning/Ratio.h>

namespace CGAL::Tandem::internal {
namespace tuning {

// Normals where the caller gives none. Squared angles are in radians^2, lengths in epsilons or standard deviations.
namespace normals {

// Neighbors that a neighborhood begins with. More: smoother, edges are rounded.
constexpr int maximum_neighbors = 12;
// Scales of a neighborhood: it grows one time less. More: better under strong noise, slower.
constexpr int last_scale = 8;
// Expected error, squared, at which a neighborhood need not grow: (3 degrees)^2. Larger: faces break up under noise.
constexpr float good_error2 = 0.00274f;
// ... and at which no other plane is looked for: (1 degree)^2. Larger: blended normals stay at edges.
constexpr float excellent_error2 = 0.000305f;
// Independent points that a neighborhood is worth more each time it has grown, in units of its first ones (measured).
constexpr Ratio independent_growth = {6, 5};
// Thinner than this fraction of epsilon is as good as flat.
constexpr float noiseless_fraction = 0.02f;
// Squared grid steps: no less than the variance of rounding to the grid, which is added to that of what is flat.
constexpr float rounding_variance = 0.25f;
// Neighborhoods that are narrower, in squared grid steps or relative to their width, determine no plane: what they are
// narrower by is rounding.
constexpr float minimum_width2 = 0.25f;
constexpr float minimum_width_ratio2 = 1e-6f;
// The rough normal of clutter is that of half of the neighbors, at least so many.
constexpr int minimum_rough_neighbors = 3;
// The weight of being thick, whatever the number of points, against the error from noise, which their number makes
// small. Smaller: a large neighborhood across an edge counts as precise.
constexpr float thickness_weight = 0.04f;
// Closer to the plane than this fraction of epsilon is no clutter.
constexpr float clutter_fraction = 0.5f;
// Passes in which planes propagate: a surfel near an edge takes the plane of a neighbor whose cost is at most this
// fraction of its own.
constexpr int propagation_passes = 4;
constexpr float propagation_cost_fraction = 0.8f;
// How far the point may be from that plane (2 sigma) and from its center along the plane (4 sigma), squared.
constexpr float propagation_thickness2 = 4;
constexpr float propagation_width2 = 16;
// A point farther than 3.5 sigma from its plane is clutter, squared. Larger: outliers get smooth normals.
constexpr float clutter_thickness2 = 12;
// Newton's steps to the smallest variance of a neighborhood, at most, and the last step: its product with the trace,
// relative to the slope. The rest is then below 1e-5 of the distance to the next variance. More: slower.
constexpr int variance_steps = 8;
constexpr double last_variance_step = 2e-3;

} // namespace normals

// Edge sides of surfels, where normals are estimated. See choose_edge_sides.h.
namespace edge_sides {

// A shape is on one side of a plane if the distances of its points, with their signs, sum to more than this ratio of
// their absolute values. A shape that ends at the plane comes near all of it, less what noise takes; one that goes on
// beyond it is near none. Larger: fewer surfels change their edge side under noise.
constexpr Ratio clear_ratio = {1, 2};

} // namespace edge_sides

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_NORMALS_H
