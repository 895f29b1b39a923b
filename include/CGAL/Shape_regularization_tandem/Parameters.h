// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_PARAMETERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_PARAMETERS_H

#include <cstddef>
#include <functional>

namespace CGAL {
namespace Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

The resolved parameters of a detection. Lengths are in the units of the input,
angles in degrees.
*/
struct Parameters {
  /// largest distance of a point to the plane of its shape (epsilon of the paper)
  double maximum_distance = 0;
  /// largest angle between the normal of a point and that of its shape (alpha), in (0, 90)
  double maximum_angle = 25;
  /// angle within which shapes are made parallel or orthogonal (beta), in [0, 45)
  double angle_tolerance = 8;
  /// largest offset between parallel planes that are made coplanar (sigma)
  double maximum_offset = 0;
  /// smallest number of points of a shape
  std::size_t minimum_region_size = 0;
  /// number of neighbors of a point (k), in [3, 64]
  std::size_t k_neighbors = 12;
  /// largest number of points of an octree leaf, in [64, 65536]
  std::size_t cell_size = 8192;
  bool regularize_parallelism = true;
  bool regularize_orthogonality = true;
  bool regularize_coplanarity = true;
};

/// progress in [0, 1]; returning `false` cancels.
using Callback = std::function<bool(double)>;

} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_PARAMETERS_H
