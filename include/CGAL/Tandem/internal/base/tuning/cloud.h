// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The grid, and what is estimated where the caller gives no value. See Share.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_CLOUD_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_CLOUD_H

#include <CGAL/Tandem/internal/base/tuning/Share.h>

#include <cstddef>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace tuning {

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

// Points that detection takes together. See make_surfels.h and join_surfels.h.
namespace surfels {

// Surfels join, and neighbors are searched again, where more than this share of them would: in heaps that are smaller
// than a cell .35 to .7 of them do, on scanned surfaces .2 to .24. Smaller: a second search that gains nothing.
constexpr Share joined = {3, 10};

} // namespace surfels

// Whether given normals have a side. See keep_to_sides.h.
namespace orientation {

// They have where this share of close neighbors on one plane agrees. All do where normals are oriented, .82 where a tenth
// of them is wrong, half of them where they are not oriented.
constexpr Share agreement = {3, 4};
// Surfels of which one is looked at. Larger: less time, and chance decides in small clouds.
constexpr std::size_t surfels_per_sampled = 8;

} // namespace orientation

// What is estimated where the caller gives no value. Measured on nine clouds of all kinds of scanners: eight come
// within a factor of 2 of what was chosen by hand.
namespace estimation {

// epsilon, in units of the noise and of the spacing. Larger: fewer and coarser shapes.
constexpr double distance_per_noise = 7. / 3;
constexpr double distance_per_spacing = .74;
// epsilon is at least this power of two of the extent, so that the grid can hold the cloud.
constexpr int minimum_distance_bits = -22;
// epsilon in units of the largest coordinate where all points are equal, and, for planes that were found elsewhere and
// have all of their points on them, in units of the extent. Any small length serves.
constexpr double smallest_distance = 1e-6;
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
// The epsilon of the grid on which they are measured, as a power of two of the extent.
constexpr int measured_distance_bits = -16;
// Quantiles over the points.
constexpr double spacing_quantile = .5;
constexpr double noise_quantile = .75;
constexpr double thickness_quantile = .25;
// Neighborhoods that are thicker than this share of their half-width are balls: the sample is thinned to
// one point of so many, at most so often, and not below so many points.
constexpr double ball_thickness = .4;
constexpr std::size_t thinning = 4;
constexpr int maximum_thinnings = 3;
constexpr std::size_t minimum_sample = 4000;

} // namespace estimation

} // namespace tuning
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_CLOUD_H
