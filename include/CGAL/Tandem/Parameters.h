// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_PARAMETERS_H
#define CGAL_TANDEM_PARAMETERS_H

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

The resolved parameters of a detection. Lengths are in the units of the input,
angles in degrees.
*/
struct Parameters {
  /// largest distance of a point to the plane of its shape (epsilon of the paper)
  double maximum_distance = 0;
  /// largest angle between the normal of a point and that of its shape (alpha), in [0.05, 90)
  double maximum_angle = 25;
  /// angle within which shapes are made parallel or orthogonal where that pays (beta), in [0, 45); none is turned by
  /// more
  double angle_tolerance = 8;
  /// largest offset between parallel planes that are made coplanar where that pays (sigma); none is moved by more
  double maximum_offset = 0;
  /// smallest number of points of a shape
  std::size_t minimum_region_size = 0;
  /// what the size of a shape is worth (mu of the score), in [0, 1]: from every layer and detail to few, large planes
  double simplicity = .04;
  /// what a degree of freedom is worth, in minimum sizes, in [0, 10]: from planes that follow their points to many
  /// relations
  double regularity = .1;
  /// edge of the cells whose points are one surfel while shapes grow, as a share of `maximum_distance`, in [0, 0.55]; 0:
  /// each point is a surfel
  double surfel_size = .55;
  /// number of neighbors of a point (k), in [3, 64]
  std::size_t k_neighbors = 12;
  /// largest number of points of an octree cell, in [64, 65536]
  std::size_t cell_size = 8192;
  /// whether shapes of nearly the same direction are made parallel
  bool regularize_parallelism = true;
  /// whether directions at nearly a right angle are made orthogonal
  bool regularize_orthogonality = true;
  /// whether parallel shapes of nearly the same plane are made coplanar
  bool regularize_coplanarity = true;
  /// directions known beforehand, such as the vertical, of any length: shapes within `angle_tolerance` become exactly
  /// parallel or orthogonal to them where their points allow it, before they are compared with each other. Of
  /// directions that are opposite, or that make an angle of less than 1e-9 radians, only the first counts.
  std::vector<std::array<double, 3>> fixed_directions;
  /// whether shapes that make nearly the same angle with `symmetry_direction` get exactly the same. Then
  /// `symmetry_direction` is also a fixed direction, unless one of `fixed_directions` is the same direction: that one
  /// takes its place.
  bool regularize_axis_symmetry = false;
  /// the axis of symmetry, of any length
  std::array<double, 3> symmetry_direction = {0, 0, 1};

  /// \cond SKIP_IN_MANUAL
  // For experiments on the alternation: rounds of growth from one regularity step to the next. 1 is the method; with
  // more than there are rounds, shapes are detected first and regularized afterwards.
  std::size_t regularity_period = 1;
  /// \endcond
};

/// \ingroup PkgShapeRegularizationTandemRef
/// a function that gets the progress of a detection, in [0, 1], and cancels the detection by returning `false`
using Callback = std::function<bool(double)>;

/*!
\ingroup PkgShapeRegularizationTandemRef

What is to be said of a `maximum_distance` that `estimate_parameters()` estimated: \ref Tandem_parameters_estimated.
*/
struct Distance_estimate {
  /// where one distance for all points is a compromise, a sentence that says why; otherwise nothing
  std::string note;
  /// whether that is because the noise varies for certain. Then `estimate_local_distances()` fits better.
  bool noise_varies = false;
};

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_PARAMETERS_H
