// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks of the uncertainty of planes: from the caller's coordinates in double, where the detection has integers of the
// grid. Margins bound what its rounding changes. Each function returns the first violation, or an empty text.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_UNCERTAINTY_VIOLATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_UNCERTAINTY_VIOLATION_H

#include <CGAL/Shape_regularization_tandem/internal/Result_checker.h>
#include <CGAL/Tandem/internal/engine/make_options.h>
#include <CGAL/Tandem/internal/result/measure_planes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Sums over the points of a shape, relative to the centroid that is to be checked, in steps of the grid.
struct Plane_sums {
  double count = 0, squares = 0; // of distances to the plane
  std::array<double, 3> sum = {0, 0, 0};
  std::array<double, 6> product = {0, 0, 0, 0, 0, 0};

  void add(const Vector& p, const Plane_uncertainty& u, double distance, double step)
  {
    const double v[3] = {(p.x - u.centroid[0]) / step, (p.y - u.centroid[1]) / step, (p.z - u.centroid[2]) / step};
    ++count;
    squares += (distance / step) * (distance / step);
    for(int i = 0, k = 0; i < 3; ++i) {
      sum[i] += v[i];
      for(int j = i; j < 3; ++j, ++k)
        product[k] += v[i] * v[j];
    }
  }

  // About the centroid of the points.
  Symmetric_matrix scatter() const
  {
    const auto about = [&](int k, int i, int j) { return product[k] - sum[i] * sum[j] / count; };
    return {about(0, 0, 0), about(1, 0, 1), about(2, 0, 2), about(3, 1, 1), about(4, 1, 2), about(5, 2, 2)};
  }
};

// A symmetric matrix of two axes of the plane; its eigenvectors are (cosine, sine) and (-sine, cosine).
struct Matrix_in_plane {
  double larger, smaller, cosine, sine;

  Matrix_in_plane(const Symmetric_matrix& m, const Plane_axes& axes)
  {
    const double aa = quadratic_form(m, axes.a), bb = quadratic_form(m, axes.b), ab = dot(axes.a, m * axes.b);
    const double half = std::hypot((aa - bb) / 2, ab), turn = std::atan2(2 * ab, aa - bb) / 2;
    larger = (aa + bb) / 2 + half;
    smaller = (aa + bb) / 2 - half;
    cosine = std::cos(turn);
    sine = std::sin(turn);
  }
};

// One shape. Lengths are in steps of the grid, so that squares of all units can be computed. change: of a coordinate, by
// the grid.
struct Uncertainty_check {
  const Plane_uncertainty& found;
  const Coefficients& plane;
  const Plane_sums& sums;
  double maximum_distance, step, change;

  // What is wrong, or null.
  const char* wrong_part() const
  {
    const double n = sums.count;
    for(const double s : sums.sum)
      if(!(std::fabs(s / n) <= change))
        return "centroid";
    const bool has_residual = n > 3;
    const double expected = has_residual ? std::sqrt(sums.squares / (n - 3)) : maximum_distance / step;
    const double margin = 1e-9 * expected + (has_residual ? change * std::sqrt(n / (n - 3)) : 0);
    if(!(found.noise >= 0 && std::fabs(noise() - expected) <= margin))
      return "noise";
    if(!(std::fabs(found.offset_deviation / step - noise() / std::sqrt(n)) <= 1e-9 * noise()))
      return "offset_deviation";
    return is_covariance_right() ? nullptr : "normal_covariance";
  }

private:
  double noise() const { return found.noise / step; }

  // Along an axis, with the spread of the points along it.
  double variance(double spread) const
  {
    const double noise2 = noise() * noise(), width = spread - sums.count * noise2;
    return width > 0 ? (std::min)(noise2 * spread / (width * width), 1.) : 1;
  }

  // What the grid may change of the spread along an axis, or of the product of two.
  double change_of(double spread, double other) const
  {
    const double n = sums.count;
    return n * change * (std::sqrt(spread / n) + std::sqrt(other / n) + change) + 1e-12 * (spread + other);
  }

  double change_of_variance(double spread) const
  {
    const double by = change_of(spread, spread);
    return variance((std::max)(spread - by, 0.)) - variance(spread + by);
  }

  // The more uncertain a plane is, the more the grid counts: by the spreads, and by the directions of both axes.
  bool is_covariance_right() const
  {
    const Plane_axes axes({plane[0], plane[1], plane[2]});
    const Matrix_in_plane spread(sums.scatter(), axes);
    const double wide = spread.larger, narrow = (std::max)(spread.smaller, 0.);
    const double least = variance(wide), most = variance(narrow);
    const double turn = (std::min)(change_of(narrow, wide) / (wide - narrow), 1.); // 1 if both are 0
    const double margin =
      1e-9 * most + 2 * ((most - least) * turn + (std::max)(change_of_variance(narrow), change_of_variance(wide)));
    std::array<double, 6> expected = {0, 0, 0, 0, 0, 0};
    add_outer(least, spread.cosine * axes.a + spread.sine * axes.b, expected);
    add_outer(most, spread.cosine * axes.b - spread.sine * axes.a, expected);
    const auto& c = found.normal_covariance;
    for(std::size_t k = 0; k < c.size(); ++k)
      if(!(std::fabs(c[k] - expected[k]) <= margin))
        return false;
    const double angle = std::sqrt((std::max)(Matrix_in_plane({c[0], c[1], c[2], c[3], c[4], c[5]}, axes).larger, 0.));
    return std::fabs(found.angle_deg * (3.14159265358979323846 / 180) - angle) <= 1e-6 * angle;
  }
};

inline std::string uncertainty_violation(const Shapes_data& data, const Grid& grid, const std::vector<Plane_sums>& sums)
{
  for(std::size_t s = 0; s < sums.size(); ++s) {
    const Uncertainty_check check = {
      data.uncertainty[s], data.coefficients[s], sums[s], data.parameters.maximum_distance,
      grid.step,           distance_margin(grid)};
    if(const char* part = check.wrong_part())
      return "the uncertainty is wrong: " + std::string(part) + " of " + numbered("shape", s);
  }
  return {};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_UNCERTAINTY_VIOLATION_H
