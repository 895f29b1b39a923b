// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points as heights above a plane, and how well planes and bent surfaces explain them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SURFACE_FIT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SURFACE_FIT_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL::Tandem::internal::facts {

// About the first point, as coordinates may be large.
inline Scatter scatter_of(const std::vector<Vector>& points)
{
  Scatter s = {double(points.size()), {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
  for(const Vector& p : points)
    s.centroid = s.centroid + (p - points[0]);
  s.centroid = (1 / s.count) * s.centroid;
  for(const Vector& p : points) {
    const Vector v = p - points[0] - s.centroid;
    s.matrix = s.matrix + Symmetric_matrix{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
  }
  return s;
}

// Coordinates u and v in a plane and a height w above it, in units of `scale`.
class Height_frame {
public:
  // normal: of length 1; scale: positive
  Height_frame(const Vector& origin, const Vector& normal, double scale)
    : origin(origin), first(unit(cross(farthest_axis(normal), normal))), second(cross(normal, first)), normal(normal),
      scale(scale)
  {}

  Vector operator()(const Vector& p) const
  {
    const Vector v = p - origin;
    return {dot(first, v) / scale, dot(second, v) / scale, dot(normal, v) / scale};
  }

private:
  Vector origin, first, second, normal;
  double scale;
};

// The least-squares polynomials of degree 1 to 3 of heights: sums, so that those of several sets of points can be added.
class Surface_fit {
public:
  static constexpr std::size_t terms = 10; // of degree 3: 1, u, v, u^2, uv, v^2, and the four of degree 3

  // p: of a Height_frame
  void add(const Vector& p)
  {
    const double u = p.x, v = p.y;
    const std::array<double, terms + 1> row = {1,         u,         v,         u * u,     u * v, v * v,
                                               u * u * u, u * u * v, u * v * v, v * v * v, p.z};
    for(std::size_t i = 0; i <= terms; ++i)
      for(std::size_t j = 0; j <= i; ++j)
        products[i][j] += row[i] * row[j];
  }

  void operator+=(const Surface_fit& other)
  {
    for(std::size_t i = 0; i <= terms; ++i)
      for(std::size_t j = 0; j <= i; ++j)
        products[i][j] += other.products[i][j];
  }

  double number_of_points() const { return products[0][0]; }

  // The sums of squares of what the polynomials of degree 1, 2 and 3 leave of the heights: Gauss' elimination, of one term
  // after the other. Terms that depend on those before, as of points on a line, explain nothing more.
  std::array<double, 3> rests() const
  {
    constexpr double smallest_pivot = 1e-12; // of the sum of squares of the term
    constexpr std::array<std::size_t, 3> last_terms = {2, 5, 9};
    auto m = products;
    std::array<double, 3> result;
    auto rest = result.begin();
    for(std::size_t i = 0; i < terms; ++i) {
      if(m[i][i] > smallest_pivot * products[i][i])
        for(std::size_t j = i + 1; j <= terms; ++j)
          for(std::size_t k = i + 1; k <= j; ++k)
            m[j][k] -= m[j][i] * m[k][i] / m[i][i];
      if(i == last_terms[std::size_t(rest - result.begin())])
        *rest++ = (std::max)(m[terms][terms], 0.);
    }
    return result;
  }

private:
  std::array<std::array<double, terms + 1>, terms + 1> products = {}; // of which the lower half is used
};

} // namespace CGAL::Tandem::internal::facts

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SURFACE_FIT_H
