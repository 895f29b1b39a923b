// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What measure_cloud.h finds.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_CLOUD_MEASURE_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_CLOUD_MEASURE_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The noise about a place of a surface.
struct Patch_noise {
  Vector position;
  double noise;
};

// Noise and spacing of a cloud, in units of the coordinates; zeros where there is no surface.
struct Cloud_measure {
  double extent = 0;        // of the points, without those far from all others
  double spacing = 0;       // median
  double places = 0;        // number of points, without copies
  double noise = 0;         // the quantile that counts
  double largest_noise = 0; // the noise of the noisiest tenth
  double low_noise = 0;     // from there
  double high_noise = 0;    // to there: over neighboring patches with the same residual over several radii
  bool varies = false;      // whether that is much, and neighboring ones have the same
  double exact = 0;         // share of the smallest neighborhoods that lie on a plane, while larger ones do not
  double sheets = 0;        // shares of the patches: with another surface next to them, and
  double bends = 0;         // of surfaces that bend
  std::vector<Patch_noise> patch;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_CLOUD_MEASURE_H
