// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_STATISTICS_H
#define CGAL_TANDEM_STATISTICS_H

#include <array>
#include <cstddef>
#include <string>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

Seconds spent in each stage of a detection.
*/
struct Stage_times {
  double normals = 0;    ///< estimation of normals, 0 if they are given
  double sort = 0;       ///< import of the points, and their order along the space-filling curve
  double neighbors = 0;  ///< nearest neighbors
  double growth = 0;     ///< growth of the shapes
  double regularity = 0; ///< links, unions, relations, planes that are applied to points
  double finish = 0;     ///< end game, exact check, export
  double total = 0;      ///< all stages, from the caller's range to the result
};

/*!
\ingroup PkgShapeRegularizationTandemRef

What a result is worth, in points: more is better, and what has another unit is priced. It compares results of the same
points with the same `maximum_distance`, `minimum_region_size` m, `simplicity`, `regularity` and `k_neighbors`, by which
the detection itself decided. The manual explains its terms:
\ref Tandem_algorithm_score.
*/
struct Result_score {
  double fit = 0;     ///< sum over the assigned points of 1 - (distance / `maximum_distance`)^2
  double links = 0;   ///< not positive: neighbors in other shapes, and in none three times as much
  double size = 0;    ///< sum over the shapes of `simplicity` N log2(N / m), N being the number of points
  double price = 0;   ///< not positive: .3 m for a shape
  double freedom = 0; ///< not positive: `regularity` (m + N / 10) for a degree of freedom, N being the points of its
                      ///< largest shape

  /// returns the score, the sum of the five terms, in numbers of points: the larger, the better
  double total() const { return fit + links + size + price + freedom; }
};

/*!
\ingroup PkgShapeRegularizationTandemRef

Why points have no shape: each valid point without one is counted once, by the first of these that holds for it. Planes,
neighbors and tolerances are those of the result; \ref Tandem_method_free_points tells them exactly.
*/
struct Free_points {
  std::size_t without_normal = 0;    ///< no normal could be estimated: the neighbors are on a line or in one place
  std::size_t misaligned = 0;        ///< within the tolerance of the plane of a shape that is next to the point, whose
                                     ///< given normal is beyond `maximum_angle`. With estimated normals, for which this
                                     ///< is 0, mostly about as many points more are in shapes
  std::size_t misfit = 0;            ///< within twice the tolerances of the plane of a shape that is next to the point
  std::size_t without_neighbors = 0; ///< no neighbor fits the plane through the point with its normal
  std::size_t in_small_regions = 0;  ///< more than half of the neighbors fit that plane; and all points of a cloud of
                                     ///< less than `minimum_region_size`
  std::size_t clutter = 0;           ///< the others: at most half do
  std::size_t unselected = 0;        ///< their shape was left out by `select_shapes()`, whatever else holds

  /// returns the number of free points: the sum of the seven numbers above
  std::size_t total() const
  {
    return without_normal + misaligned + misfit + without_neighbors + in_small_regions + clutter + unselected;
  }
};

/*!
\ingroup PkgShapeRegularizationTandemRef

What a detection did, in numbers.
*/
struct Statistics {
  std::size_t number_of_points = 0;              ///< items of the input range
  std::size_t number_of_ignored_coordinates = 0; ///< points with a coordinate that is not finite
  std::size_t number_of_ignored_normals = 0;     ///< points whose given normal is null or not finite
  std::size_t number_of_ignored_tolerances = 0;  ///< points whose given tolerance is not positive
  std::size_t number_of_far_points = 0;          ///< points left out, since they are too far from all others
  std::size_t number_of_assigned_points = 0;     ///< points that belong to a shape
  Free_points free_points;                       ///< valid points that belong to none, by reason
  std::size_t number_of_shapes = 0;              ///< connected pieces of planes
  std::size_t number_of_directions = 0;          ///< parallel groups: distinct directions of the shapes
  std::size_t number_of_planes = 0;              ///< coplanar groups: distinct planes of the shapes
  std::size_t number_of_orthogonal_pairs = 0;    ///< pairs of parallel groups that are orthogonal

  /// the ratio of the points that belong to a shape, in [0, 1]
  double coverage = 0;
  /// mean distance of the points of the shapes to their planes, in units of the input; measured on the grid, whose step
  /// is about a thousandth of `maximum_distance`
  double mean_distance = 0;
  /// degrees of freedom of the planes: 1 for the offset of each plane, and 2 for each direction, less 1 for each right
  /// angle of two directions that does not follow from other ones (so 3 for an orthogonal frame)
  std::size_t degrees_of_freedom = 0;
  /// the complexity of the paper: `degrees_of_freedom` / (3 `number_of_shapes`), or 0 if there are no shapes
  double complexity = 0;
  Result_score score; ///< what the result is worth, in points; distances are measured on the grid

  std::size_t number_of_rounds = 0; ///< rounds of growth and regularization
  Stage_times times;                ///< seconds spent in each stage
  std::size_t peak_bytes = 0;       ///< memory of all tables that have an entry for each point, when they are largest
  double grid_step = 0;             ///< the width of a step of the grid, in units of the input
  bool is_grid_coarse = false;      ///< whether `grid_step` exceeds `maximum_distance` / 1024: the extent is large
  /// from one scan line to the next, in units of the input: about the geometric mean over the points whose nearest
  /// neighbors are on a line; 0 if few of them are
  double line_spacing = 0;
  bool has_estimated_normals = false; ///< whether normals were estimated, because none were given
  bool is_cancelled = false;          ///< whether the callback ended the detection early
  /// a sentence that says why one estimated `maximum_distance` for all points is a compromise: coordinates are in
  /// steps, surfaces are close to others, the noise varies, or there is no surface. Empty if it is none, or was given
  std::string estimate_note;
  /// which of `maximum_angle` and `angle_tolerance`, which are in degrees, is also the cosine of an allowed angle, and
  /// so may have been meant as one, and what to pass then. Otherwise empty
  std::string angle_note;
  std::string backend; ///< the name of the back end that executed: "sequential", "parallel", ...

  /// the number of points with an invalid position, normal or tolerance, or too far away, which belong to no shape
  std::size_t number_of_ignored_points() const
  {
    return number_of_ignored_coordinates + number_of_ignored_normals + number_of_ignored_tolerances +
           number_of_far_points;
  }
};

/*!
\ingroup PkgShapeRegularizationTandemRef

How well the points of a shape determine its plane: standard deviations and covariances to first order, for errors of
the points that are independent and alike. The plane is that through its `centroid` and normal; the error of its offset
there and that of its normal are not correlated. The manual has the formulas, and what they leave out:
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

#endif // CGAL_TANDEM_STATISTICS_H
