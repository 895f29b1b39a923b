// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers that steer the method, stage by stage. Each has its unit, where it comes from, and what moving it does.
// "Paper" is Oesau, Lafarge and Alliez 2016. "Measured" means: chosen on scans of buildings, rooms and streets and on
// generated scenes with known faces, by coverage, number of directions and planes, and faces found. Entries that only
// bound the work, such as numbers of passes, were chosen so that more of them change next to nothing. With other values
// the result is another one, on all back ends alike.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_H

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace tuning {

// A share of a number of points, without rounding of floats.
struct Share {
  std::int64_t numerator, denominator;

  constexpr std::int64_t of(std::int64_t n) const { return n * numerator / denominator; }

  // Whether the part is at least this share of the whole.
  constexpr bool is_reached(std::int64_t part, std::int64_t whole) const
  {
    return part * denominator >= whole * numerator;
  }

  constexpr bool is_exceeded(std::int64_t part, std::int64_t whole) const
  {
    return part * denominator > whole * numerator;
  }
};

// How the caller's points are put on the grid.
namespace grid {

// Steps of the grid in epsilon, as a power of two. Finer: smaller rounding, a smaller largest extent.
constexpr int steps_per_distance_bits = 10;
// Fewest steps in epsilon where the extent of the cloud asks for a coarser grid. Fewer: rounding changes results.
constexpr double minimum_steps_per_distance = 16;
// Of planes that were found elsewhere: longer tolerances count as this multiple of the extent of the points. All points
// are within already; a coarser grid would lose their planes.
constexpr double maximum_distance_per_extent = 4;

} // namespace grid

// What is estimated where the caller gives no value. Measured on nine clouds of all kinds of scanners: eight come
// within a factor of 2 of what was chosen by hand.
namespace estimation {

// epsilon, in units of the noise and of the spacing. Larger: fewer and coarser shapes.
constexpr double distance_per_noise = 7. / 3;
constexpr double distance_per_spacing = .74;
// epsilon is at least this power of two of the extent, so that the grid can hold the cloud.
constexpr int minimum_distance_bits = -22;
// Minimum size of a shape: points, and per square root of the points of the cloud. Larger: details are lost.
constexpr std::size_t minimum_region_size = 20;
constexpr double region_size_per_root = .3;
// For planes that were found elsewhere: epsilon in units of the rms distance of their points.
constexpr double distance_per_rms = 2.5;
// Neighbors whose plane gives the noise of a point, and whose distance gives the spacing.
constexpr int noise_neighbors = 20;
constexpr int spacing_neighbors = 6;
// Points that are looked at in a large cloud, and points of a sampled cell. More: slower, hardly more precise.
constexpr std::size_t sampled_points = std::size_t(1) << 17;
constexpr std::size_t sampled_cell_size = 2048;
// Quantiles over the points.
constexpr double spacing_quantile = .5;
constexpr double noise_quantile = .75;
constexpr double thickness_quantile = .25;
// Neighborhoods that are thicker than this share of their half-width are balls: the sample is thinned to every
// fourth point, at most so often, and not below so many points.
constexpr double ball_thickness = .4;
constexpr std::size_t thinning = 4;
constexpr int maximum_thinnings = 3;
constexpr std::size_t minimum_sample = 4000;

} // namespace estimation

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
constexpr Share independent_growth = {6, 5};
// Thinner than this share of epsilon is as good as flat.
constexpr float noiseless_share = 0.02f;
// Neighborhoods that are narrower, in squared grid steps or relative to their width, determine no plane: what they are
// narrower by is rounding.
constexpr float minimum_width2 = 0.25f;
constexpr float minimum_width_ratio2 = 1e-6f;
// The rough normal of clutter is that of half of the neighbors, at least so many.
constexpr int minimum_rough_neighbors = 3;
// The weight of being thick, whatever the number of points, against the error from noise, which their number makes
// small. Smaller: a large neighborhood across an edge counts as precise.
constexpr float thickness_weight = 0.04f;
// Closer to the plane than this share of epsilon is no clutter.
constexpr float clutter_share = 0.5f;
// Passes in which a point near an edge takes over the plane of a neighbor, and the largest share of its own cost that
// the other plane may have.
constexpr int adoption_passes = 4;
constexpr float adoption_cost_share = 0.8f;
// How far the point may be from that plane (2 sigma) and from its center along the plane (4 sigma), squared.
constexpr float adoption_thickness2 = 4;
constexpr float adoption_width2 = 16;
// A point farther than 3.5 sigma from its plane is clutter, squared. Larger: outliers get smooth normals.
constexpr float clutter_thickness2 = 12;

} // namespace normals

// Seeds, and growth inside the octree cells (section 3 of the paper).
namespace growth {

// The tighter bounds by which equally planar seeds are ordered, as shares of epsilon and alpha. Larger: seeds near
// edges and steps, where a plane bridges two surfaces.
constexpr double tight_distance_share = 1. / 4;
constexpr double tight_angle_share = 1. / 2;
// Shapes that may grow in a cell for a new one to begin, in the first rounds and later. The paper has one. More: fewer
// rounds at the same quality; many more in the first rounds: shapes do not meet the faces they belong to.
constexpr int young_seeds_in_flight = 8;
constexpr int maximum_seeds_in_flight = 32;
// Seeds of a cell that may fail in one pass. More: clutter is searched longer.
constexpr int seed_tries = 64;
// The core of a new shape: this share of the neighbors and the seed, but at most a share of a full cell.
constexpr std::size_t neighbors_per_core_point = 2;
constexpr std::size_t cell_points_per_core_point = 8;
// Breadth-first steps of a shape: 1, 2, 4, ... by its age in passes, at most so many. More at first: immature planes
// grow over noise. Regularizing young shapes often is what keeps directions few.
constexpr int maximum_steps = 256;
constexpr int doubling_passes = 9;

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
// Sizes in shares of the minimum region size. Smaller shapes are dissolved when they stop growing, at least this many
// points are kept. Larger: parts of faces are lost before they meet.
constexpr Share fragment_share = {3, 20};
constexpr std::int64_t minimum_fragment_size = 6;
// Smaller shapes get no relations in the loop: while they are young they tilt more than what they would be related to.
constexpr Share related_share = {7, 20};
// Smaller shapes get no relations at the end. Paper's minimum is the region size.
constexpr std::int64_t minimum_regular_size = 10;

} // namespace loop

// Motion of planes, in epsilons over the bounding box of the shape.
namespace motion {

// Planes that move by less need no new check of the points, no new count of misfits, and no new links. Larger: faster,
// points are checked late.
constexpr double negligible = 0.02;
// Planes that move by more let the shape grow again from all of its points. Smaller: more rounds.
constexpr double restart = 0.1;

} // namespace motion

// Which neighboring fragments become one shape by a joint fit. Without it slanted surfaces are cut into terraces.
namespace merging {

// Fewest neighbor relations between two shapes that touch. More: thin contacts are missed.
constexpr std::uint32_t minimum_edges = 2;
// Up to this many points the normal of a shape is too uncertain for alpha to separate it from others. Shapes with
// fewer are not examined for layers either.
constexpr std::int64_t reliable_normal_size = 30;
// How much worse, in epsilons (rms), the joint plane may be than the local one. Larger: bends are bridged.
constexpr double tolerated_rms = 0.5;
// It may also not be worse by more than the shape's own distances and this, in epsilons (rms): a plane that bridges
// two narrow strips is close to both, but not as close as their own planes. Larger: fewer fragments, more bridges.
constexpr double negligible_rms = 0.2;
// Share of the points of a shape that may newly misfit the joint plane, in the loop and at the end.
constexpr double misfit_share = 0.05;
constexpr double final_misfit_share = 0.15;
// A shape that is smaller by this factor may join without a new fit. Larger: more rounds, the same unions.
constexpr std::int64_t much_larger = 4;

} // namespace merging

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

// Shapes that turn out to be two layers.
namespace layers {

// Bins of the histogram of distances, and how many an epsilon has.
constexpr int bins = 64;
constexpr int bins_per_distance = 16;
// A Gaussian of sigma = epsilon / 6, at the distance of 0, 1, 2 ... bins, in thousandths. Wider: it hides the gap
// between layers of noise that are 1.1 epsilon apart.
struct Kernel {
  static constexpr int size = 8;
  std::int64_t weight[size];
};
constexpr Kernel kernel = {{1000, 932, 755, 531, 325, 172, 80, 32}};
// A peak counts when it is so much higher than the middle.
constexpr Share peak_height = {3, 2};
// A shape is suspicious when its points' normals lean to one side of its plane by more than about 4 degrees (sine), or
// their distances are spread (rms, in epsilons).
constexpr double suspicious_lean = 0.07;
constexpr double suspicious_rms = 0.45;
// It bridges layers for certain when they lean by more than about 6 degrees. The normals of fewer points than this, at
// edges, may lean by themselves.
constexpr double certain_lean = 0.1;
constexpr std::int64_t minimum_size = 100;
// A shape is examined again when it has grown by a tenth.
constexpr Share examined_growth = {11, 10};

} // namespace layers

// After the loop: consolidation of fragments, label propagation, reassignment.
namespace end_game {

// Rounds of consolidation. It ends when at most one shape of 50 has gone and fewer than one point of 1000 has come.
constexpr int consolidation_rounds = 2;
constexpr Share kept_shapes = {49, 50};
constexpr Share grown_points = {1001, 1000};
// Share of the minimum size that a shape needs to last until the reassignment: it may still get points. Larger: faces
// near the minimum size are lost under noise. Smaller: strips beside faces that a relation has turned last, too.
constexpr Share lasting_size = {2, 3};
// Rounds of label propagation; it ends when at most one point of so many has got a label in a round.
constexpr std::size_t propagation_rounds = 16;
constexpr std::size_t points_per_late_point = 100000;
// Rounds of reassignment to the largest neighbor that fits. Shapes below this share of the minimum size lose no points.
constexpr int reassignment_rounds = 4;
constexpr Share safe_size = {3, 2};
// A point may go to a plane that is farther than the nearest one by one in so many epsilons, or is at most this far
// from that plane at the point, in epsilons. Otherwise both are layers there. Larger distances: layers are swallowed.
// Smaller: parts of a surface that bends keep points that its largest plane explains.
constexpr std::int64_t distance_per_farther_plane = 4;
constexpr Share layer_distance = {9, 10};

} // namespace end_game

// Points near edges, where normals are estimated.
namespace sides {

// A shape is on one side of a plane if the distances of its points, with their signs, sum to more than this share of
// their absolute values. A shape that ends at the plane comes near all of it, less what noise takes; one that goes on
// beyond it is near none. Larger: fewer points change sides under noise.
constexpr Share clear_share = {1, 2};
// Fewest visits to points of a shape to which a normal is fitted again: about eight points.
constexpr int minimum_visits = 24;
// Visits to the points around per point: 2.5 to 3.2 (measured), since some are visited several times.
constexpr double visits_per_point = 3;
// Squared alpha, in expected squared errors, that such a normal needs: three standard deviations. Smaller: noise alone
// takes points near edges from dense clouds.
constexpr double squared_alpha_per_error = 9;

} // namespace sides

// Large planes take what they explain of smaller shapes, in the loop and after it. Measured on aerial, indoor, street
// and image-matched scans and on scenes with known faces.
namespace transfer {

// A plane takes points of a smaller shape if it explains at least this share of it. Smaller: planes cut through noise,
// and faces are lost to it.
constexpr Share explained_share = {1, 5};
// A shape is fitted anew if its new plane explains more than this share of what the former one does. Without a margin,
// planes move for a few points.
constexpr Share better_plane = {501, 500};
// A shape whose centroid is farther from the plane, in epsilons, and whose variance across it is at most this multiple
// of that across its local plane, is a layer of its own, unless at least this share of it fits. A noisy layer at a
// distance of epsilon fits with half of its points. Larger distance, smaller share: layers are swallowed.
constexpr double layer_distance = 0.8;
constexpr double layer_variance = 2.25;
constexpr Share layer_share = {3, 5};
// Rounds, at most: one in each round of the loop after the first ones, more after the loop. A round that moves less
// than one point of so many of the cloud is the last one.
constexpr int maximum_rounds_in_loop = 1;
constexpr int maximum_rounds = 2;
constexpr std::size_t points_per_moved_point = 2000;

} // namespace transfer

// Planes through clutter. Measured: planes through outliers have .40 to .75 of the neighbors near them, faces .89 and
// more. Larger shares: true but noisy faces are dropped.
namespace clutter {

// Largest rms of a crisp shape, in epsilons: its points are no clutter to others.
constexpr double crisp_rms = 0.4;
// A shape is dropped with a smaller share of neighbors near its plane; or with fewer of its own and fewer near; or
// with a larger rms (in epsilons) and fewer near.
constexpr double near_share = .55;
constexpr double own_share = .4;
constexpr double near_share_if_few_own = .75;
constexpr double large_rms = .5;
constexpr double near_share_if_large_rms = .77;

} // namespace clutter

// What a result is worth (score/Score.h), in points. Measured: labels of rooms and roofs, scenes and layers are truest
// with these; price and size bonus may be half or twice as large.
namespace score {

// A point, in units of the sums.
constexpr std::int64_t unit = 4096;
// What the links of a point to other shapes cost, if all are. Without it noisy faces split into planes that interleave.
constexpr Share link = {1, 2};
// A link to a free point counts so often. Fewer: planes through clutter stay.
constexpr std::int64_t free_link = 3;
// Of a point, by the logarithm of the size of its shape in minimum sizes. Larger: few, large shapes; from .1 on layers
// 1.1 epsilon apart are lost. Smaller: surfaces that bend are cut.
constexpr Share size_bonus = {7, 100};
// Of a shape, in minimum sizes. From 1 on small faces are lost.
constexpr Share price = {3, 10};
// Of a degree of freedom, in minimum sizes, and one more point for so many of the shape. Larger: fewer directions; from
// half a minimum size on, parallels that are none.
constexpr Share freedom = {1, 10};
constexpr std::int64_t points_per_freedom = 100;

} // namespace score

// Margins of the exact check, and of searches. They follow from the formats. Smaller ones would break the guarantee;
// larger ones only let more points be evaluated in double, or more directions be visited.
namespace exactness {

// Degrees: packed normals are within .004.
constexpr double packing_margin_deg = 0.006;
// Grid steps: rounding a point costs up to .87, rounding a plane's normal up to 1.3; and the relative rounding of the
// offset in the caller's coordinates.
constexpr double distance_margin = 4;
constexpr double relative_margin = 1e-14;
// Of a cosine: what a normal may lose when it is rounded to float.
constexpr double rounded_normal_margin = 2e-7;
// Relative to the sum of the terms: the rounding of a distance in double.
constexpr double evaluation_margin = 1e-15;
// Of a dot product of unit vectors: its rounding, and what the normals on the grid of the Gauss map have lost more.
constexpr double dot_margin = 1e-14;
constexpr double rounded_dot_margin = 4e-7;
// By what share queries reach farther than the distance that is compared, and coordinates farther than they. Rounding
// is below 1e-15 of the coordinates.
constexpr double reach_margin = 1e-6;
// Relative to the largest eigenvalue of a scatter: the rounding of a sum of squared distances.
constexpr double squared_distance_margin = 1e-13;

} // namespace exactness

} // namespace tuning
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_H
