// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What measure_cloud.h finds.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_CLOUD_MEASURE_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_CLOUD_MEASURE_H

namespace CGAL {
namespace Tandem {
namespace internal {

// Noise and spacing: of a cloud as quantiles over its points, in units of the coordinates; of a point as its own
// values.
struct Cloud_measure {
  double spacing = 0;   // median, over the points, of the mean distance to the 6 nearest neighbors
  double noise = 0;     // upper quartile of the rms distance of 20 neighbors to their plane
  double thickness = 0; // lower quartile of the ratio of that distance to the half-width of the neighborhood
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_CLOUD_MEASURE_H
