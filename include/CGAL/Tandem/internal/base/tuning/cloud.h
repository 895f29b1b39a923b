// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The grid, and what is estimated where the caller gives no value. See Ratio.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_CLOUD_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_CLOUD_H

#include <CGAL/Tandem/internal/base/tuning/Ratio.h>

#include <cstddef>
#include <cstdint>

namespace CGAL::Tandem::internal {
namespace tuning {

// How the caller's points are put on the grid.
namespace grid {

// Steps of the grid in epsilon, as a power of two. Finer: smaller rounding, a smaller largest extent.
constexpr int steps_per_distance_bits = 10;
// Fewest steps in epsilon where the extent of the cloud asks for a coarser grid. Fewer: rounding changes results.
constexpr double minimum_steps_per_distance = 16;
// Extents of the cloud in epsilons, as powers of two: up to the first, the grid is as fine as it should be; beyond the
// second, there may be none.
constexpr int fine_extent_bits = 18;
constexpr int largest_extent_bits = 24;
// Where the extent is beyond that, points far from the others are left out if they are at most this ratio, about what
// does not count in the estimate of epsilon either. Larger: a part of a cloud that is in two places may be left out.
constexpr Ratio far_ratio = {5, 100};
// Octaves below epsilon in which tolerances of points have a finer grid and smaller surfels. More: a coarser grid of
// clouds of large extent; sums of distances need more bits.
constexpr int maximum_octaves = 6;
// Where points have tolerances and epsilon is not given, so many of them do not exceed it. Larger: few values that stand for
// none decide on the grid. Smaller: points with the largest tolerances get smaller ones.
constexpr Ratio tolerances_within = {95, 100};
// Of planes that were found elsewhere: longer tolerances count as this multiple of the extent of the points. All points
// are within already; a coarser grid would miss their planes.
constexpr double maximum_distance_per_extent = 4;

} // namespace grid

// Points that detection takes together. See make_surfels.h and join_surfels.h.
namespace surfels {

// Surfels join, and neighbors are searched again, where more than this ratio of them would: in clusters that are
// smaller than a cell .35 to .7 of them do, on scanned surfaces .2 to .24. Smaller: a second search that gains nothing.
constexpr Ratio joined = {3, 10};

} // namespace surfels

// Neighbors across scan lines. See cross_scan_lines.h.
namespace scan_lines {

// A neighborhood is a line if its squared width over its squared length is less. Smaller: noise gives lines a width
// (scan lines: F .70 with 1/32, .75 with 1/8). Larger: so have evenly spaced points by chance.
constexpr double width2_of_length2 = 1. / 8;
// Corners of lines have at least one neighbor of so many whose row is a line.
constexpr int neighbors_per_line = 3;
// There are scan lines where more than this ratio of the neighborhoods are lines: 0 to .02 on clouds with evenly spaced
// points, .05 if they are few, .12 to .99 where points are on lines.
constexpr Ratio of_cloud = {1, 12};
// Nor are they looked for with fewer neighbors: more than that ratio are lines by chance.
constexpr int minimum_neighbors = 8;
// Surfels of which one is looked at.
constexpr std::uint32_t surfels_per_sampled = 8;
// A cloud is not thinned again if more than this ratio of its points would stay.
constexpr Ratio thinned = {3, 4};

} // namespace scan_lines

// Whether given normals are oriented. See cut_wall_sides.h.
namespace orientation {

// They are where this ratio of close neighbors on one plane agrees. All do where normals are oriented, .82 where a
// tenth of them is wrong, half of them where they are not oriented.
constexpr Ratio agreement = {3, 4};
// Neighbors with opposite normals are of one surface if they are this close to the plane of a surfel, as a fraction of
// epsilon. Larger: the sides of thin walls are connected.
constexpr double same_side_fraction = 1. / 4;
// Surfels of which one is looked at. Larger: less time, and chance decides in small clouds.
constexpr std::size_t surfels_per_sampled = 8;

} // namespace orientation

// What is estimated where the caller gives no value. How the noise is measured was chosen on generated clouds of known
// noise, from a tenth of the spacing to ten times the spacing; how epsilon follows from spacing and noise, on nine clouds
// of all kinds of scanners, for which it comes within a factor of 1.5 of what was chosen by hand. See measure_cloud.h.
namespace estimation {

// epsilon in units of the noise: at least. Larger: fewer and coarser shapes.
constexpr double distance_per_noise = 2.5;
// Above that, epsilon is this multiple of the spacing times the number of points to the power of 5/16: .25 of the spacing
// for 4000 points, 1.4 for a million. Larger: detail of scans is ignored, and faces at small angles in small clouds become
// one. Chosen by the nine clouds.
constexpr double distance_per_spacing = .019;
// But at most these multiples of the noise of the noisiest tenth, and of its root mean square. Larger: layers of precise
// scans become one, and the tolerance of a roof grows with the size of its tile.
constexpr double distance_per_largest_noise = 3.8;
constexpr double distance_per_rms_noise = 3;
// Less noise than this fraction of the spacing is that of rounding, which says nothing of epsilon.
constexpr double least_noise_per_spacing = .01;
// Nor does that of clouds of which this ratio of the surfaces bends.
constexpr double bent_ratio = .5;
// epsilon is at least this power of two of the extent, so that the grid can hold the cloud.
constexpr int minimum_distance_bits = -22;
// epsilon in units of the largest coordinate where all points are equal, and, for planes that were found elsewhere and
// have all of their points on them, in units of the extent. Any small length serves.
constexpr double smallest_distance = 1e-6;
// Minimum size of a shape: points, and per square root of the points of the cloud. Larger: details are missed.
constexpr std::size_t minimum_region_size = 20;
constexpr double region_size_per_root = .3;
// But at most the first, or, if that is more, the second times epsilon in units of the spacing. Larger: roofs of large
// tiles get no shape.
constexpr double largest_region_size = 100;
constexpr double region_size_per_distance = 400;
// For planes that were found elsewhere: epsilon in units of the rms distance of their points.
constexpr double distance_per_rms = 2.5;

// Nearest neighbors whose plane is looked at first, and then at each thinning. Fewer: planes are those of chance. More: of
// two surfaces close to each other, the second one is taken for noise of the first.
constexpr int few_neighbors = 8;
constexpr int noise_neighbors = 20;
// Neighbors closer to each other than this fraction of the farthest one's distance are copies of one point. Smaller:
// copies that were rounded are taken for a surface. Larger: points of a surface do not count.
constexpr double copy_distance = .1;
// Places that are enough for the noise about a plane.
constexpr int minimum_places = 7;
// Points of the sample, along the curve, of which the median counts. More: noise that varies is mixed; fewer: chance.
constexpr std::size_t patch_size = 64;
// Neighborhoods that are thicker than this fraction of their half-width show no surface. Larger: noise that exceeds the
// spacing is underestimated, and edges count as noise.
constexpr double surface_thickness = .3;
// Thicker ones do if their residual is at most this multiple of that over the radius before, up to such a thickness: it
// is the noise, which exceeds the spacing.
constexpr double flat_step = 1.35;
constexpr double flat_thickness = .6;
// Patches that show a surface more than so many levels after the median one are clutter. Each level has twice the radius.
constexpr std::size_t late_levels = 3;
// Up to this multiple of the first residual, one of a larger radius is noise, too.
constexpr double flat_growth = 1.5;
// Steps of depth: surfaces with less than this fraction of the residual of a plane across, which is farther away along
// the radius than so many residuals, and so many thinnings away at most.
constexpr double step_flatness = .001;
constexpr double step_tilt = 2;
constexpr int step_thinnings = 3;
// Where so many of the smallest neighborhoods have none of that residual, it counts this many times: epsilon is .9 of a
// step then. Smaller: the levels become planes. Larger: so do two steps.
constexpr Ratio step_neighborhoods = {1, 4};
constexpr double step_margin = 1.25;
// Quantile over the patches: the noise that counts.
constexpr double noise_quantile = .75;
// Of tolerances by point: the nearest patches whose median is the noise of a patch, and those that a point mixes. More:
// smoother, and wrong where the noise changes fast.
constexpr int smoothed_patches = 7;
constexpr int mixed_patches = 4;
// Where the noise varies, tolerances of points are longer by this factor, since noise that exceeds the spacing is measured
// by up to a fifth too small. Smaller: what is beyond makes planes next to a noisy wall (corridors before a depth camera
// were right 16 times of 27 with 1, 25 times with 1.2).
constexpr double local_margin = 1.2;
// But for that, no tolerance of a point is larger or smaller than that of the cloud by more than this factor.
constexpr double largest_local_factor = 8;

// The noise varies where, of patches with the same residual over several radii, the high quantile of the smoothed noise
// is more than this multiple of the low one: 6.5 to 21 times before depth cameras where one tolerance fails, 4.8 at most
// in rooms where it does not. Noise grows with the square of the range, and spacing with the range: so does the squared
// spacing vary, 11 to 54 times before depth cameras, 1 where trees stand beside roofs.
constexpr double varied_noise = 5.4;
// The low quantile; the high one is as far from the end. Larger: a small noisy face does not count.
constexpr double low_noise_quantile = .02;
// And where of those that differ from the median by more than this factor at most this ratio as many differ from their
// neighbors, too: .03 to .19 before depth cameras, .26 to .6 where vegetation and clutter differ.
constexpr double same_noise = 1.2;
constexpr Ratio differ_in_place = {22, 100};
// Ratios of patches, or of points, above which the estimate is said to be a compromise.
constexpr double compromise_ratio = .25;

// Points that are looked at in a large cloud, and points of a sampled cell. More: slower, hardly more precise.
constexpr std::size_t sampled_points = std::size_t(1) << 17;
constexpr std::size_t sampled_cell_size = 2048;
// The epsilon of the grid on which they are measured, as a power of two of the extent.
constexpr int measured_distance_bits = -16;
// Points at each end of an axis that do not count if the box of the others, with a margin of its width, is smaller than
// this fraction of that of all. Then it is tried again.
constexpr Ratio far_points = {1, 100};
constexpr double far_extent = .25;

} // namespace estimation

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_CLOUD_H
