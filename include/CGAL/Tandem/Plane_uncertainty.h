// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_PLANE_UNCERTAINTY_H
#define CGAL_TANDEM_PLANE_UNCERTAINTY_H

#include <array>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

How well the points of a shape determine its plane: standard deviations and covariances to first order, for errors of the
points that are independent and alike. The plane is that through its `centroid` and normal; the error of its offset there
and that of its normal are not correlated. The manual has the formulas, and what they leave out:
\ref Tandem_method_uncertainty.
*/
struct Plane_uncertainty {
  /// of the points of the shape, in the coordinates of the input
  std::array<double, 3> centroid = {0, 0, 0};
  /// the noise of a point across the plane: the root of the sum of the squared distances to the plane by the number of
  /// points less 3. It is `maximum_distance` for a shape of three points, which have no residual.
  double noise = 0;
  /// the covariance of the unit normal, without a unit (radians): xx, xy, xz, yy, yz, zz. It has no part along the
  /// normal. Its other two eigenvalues are at most 1, which stands for a direction that the points do not determine.
  std::array<double, 6> normal_covariance = {0, 0, 0, 0, 0, 0};
  /// the standard deviation of the plane along its normal at the `centroid`
  double offset_deviation = 0;
  /// the standard deviation of the normal, in degrees, along the axis where it is largest
  double angle_deg = 0;
};

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_PLANE_UNCERTAINTY_H
