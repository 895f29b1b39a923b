// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relations: how they are found, and verified by the points. See Share.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_REGULARITY_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_REGULARITY_H

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace tuning {

// The verification of planes by the points (the paper has the share of misfits only).
namespace verification {

// A relation is rolled back when so many points of a shape newly misfit. Smaller: more directions (.1: half as many
// again); larger: coverage falls.
constexpr double misfit_share = 0.2;
// ... or when more points misfit than so many of the smallest shapes have: a plane that turns loses a strip at either
// end. More: strips beside large faces, and free points; fewer: more directions.
constexpr std::int64_t strips_of_turned_shape = 2;
// A strip has at least this share of the shape: in the loop, since a sample tells no less; at the end, where nothing
// grows beside the shape any more, since a relation is worth some points.
constexpr double strip_share = 0.005;
constexpr double strip_share_at_end = 0.05;
// ... or when it adds more than this to the distance of the points, in epsilons (rms, in quadrature). Larger: false
// parallels of faces turned by 4 to 7 degrees.
constexpr double rms_share = 0.6;
// A plane that moved less, in epsilons within two standard deviations of the shape, needs no verification.
constexpr double still_share = 0.02;
constexpr double extent_deviations = 2;
// Of a shape with twice as many points or more only a sample is counted, of this to twice as many. More: slower.
constexpr std::int64_t sample_size = 512;
// A count is used again until one point of so many has changed.
constexpr std::int64_t points_per_change = 32;
// A shape that was rolled back tries again after 2, 4, 8, ... rounds (at most 2 to this power), or when it has grown by
// this share.
constexpr int maximum_rollbacks = 5;
constexpr std::int64_t retry_growth_divisor = 4;

} // namespace verification

// When relations are found anew, and which shapes keep theirs.
namespace relations {

// Share of the assigned points that have changed their shape since, in the loop and at the end. Smaller: slower.
constexpr double changed_share = 0.05;
constexpr double changed_share_at_end = 0.03;
// In the loop a shape keeps its relations while it has changed by at most one point of so many.
constexpr std::int64_t points_per_held_change = 4;
// Shapes that were rejected are tried again in the loop if there are more than one of so many.
constexpr std::size_t shapes_per_retry = 64;
// Two unit normals are orthogonal if their dot product is at most this. Half of the 1e-15 that results promise, so
// that every order of evaluation keeps the promise.
constexpr double orthogonal_dot = 5e-16;
// The same of the cosines of their angles to an axis, whose rounding is larger.
constexpr double same_cosine = 6e-16;
// Directions closer than this (sine) are one up to rounding.
constexpr double same_direction = 1e-9;

} // namespace relations

// Clusters on the Gauss map (section 4.1 of the paper) and of offsets: mean shift with a Gaussian kernel.
namespace clustering {

// Standard deviation in radii. The paper has 1, which merges directions up to 2 beta apart.
constexpr double sigma = 0.5;
// Standard deviations at which the kernel ends. More: slower.
constexpr double kernel_deviations = 3;
// The kernel is the power 2^n of a linear function, which is 1 at 0: exp() differs between machines. Eight: it differs
// by at most .002 from exp().
constexpr int kernel_power_bits = 8;
// Steps of an ascent, and the squared motion at which it ends, in squared radii.
constexpr int maximum_steps = 16;
constexpr double squared_rest = 1e-4;
// Width of the bins in which normals and offsets are gathered first, in radii. Larger: faster, coarser modes.
constexpr double direction_bins_per_radius = 8;
constexpr double offset_bins_per_radius = 16;
// Passes over what no mode has reached.
constexpr int maximum_passes = 8;

} // namespace clustering

// Groups of parallel shapes, and their right angles (sections 4.1 and 4.2 of the paper).
namespace directions {

// What is rejected is clustered again within a smaller angle: shares of beta for parallels and for right angles. A
// shape large enough to be rejected has a precise normal: only true right angles are left to it, and at last none.
// Clustered again within the same angle, rejected shapes would form a second direction beside the first.
constexpr int levels = 5;
constexpr double parallel_share[levels] = {1, 0.5, 0.25, 0.125, 0.125};
constexpr double right_share[levels] = {1, 0.25, 0.0625, 0.0625, 0};
// A smaller sine of the tolerance means that nothing is parallel.
constexpr double minimum_sine = 1e-9;
// Fits of the groups without the members that their moments reject.
constexpr int fits = 3;
// A rejected shape joins a group again that costs it at most this share of what it was rejected for.
constexpr double rejoin_cost_share = 0.25;
// Chaining a star spends this share of the allowed squared rms, since the star has been fitted already.
constexpr double chain_share = 0.25;
// Two placed directions whose squared sine is smaller determine no third one.
constexpr double minimum_squared_sine = 0.04;

} // namespace directions

// The last step over directions: small groups join larger ones. Not in the paper: clusters are
// found by density, so small groups remain beside large ones.
namespace leftovers {

// A group whose first choice has gone has another one.
constexpr int steps = 3;
// What the points may lose, in epsilons (rms) and as a share of new misfits: more than where groups are found, since a
// shape that joins changes no direction and moves no other shape.
constexpr double rms_share = 1;
constexpr double misfit_share = 0.4;
// To save a direction may cost at most this share of the points of a mean shape.
constexpr double price_of_direction = 0.25;
// A group with more members is no leftover.
constexpr std::size_t maximum_members = 8;

} // namespace leftovers

// Coplanar classes (section 4.3 of the paper).
namespace coplanarity {

// What is rejected is clustered again with this share of the radius, so often.
constexpr int rounds = 4;
constexpr double radius_share = 0.5;
// Then neighbors are joined, a class with at most one other in a step; in the loop and at the end.
constexpr int joining_steps = 2;
constexpr int final_joining_steps = 4;

} // namespace coplanarity

} // namespace tuning
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_REGULARITY_H
