// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes that are made of rectangles, without points, and the regularity step on them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RECTANGLES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RECTANGLES_H

#include "checks.h"
#include "same_bits.h"

#include <CGAL/Tandem/internal/regularity/regularize.h>

#include <random>
#include <string>
#include <vector>

namespace CGAL::Tandem::internal {

// s v v^T
inline Symmetric_matrix square(double s, const Vector& v)
{
  return {s * v.x * v.x, s * v.x * v.y, s * v.x * v.z, s * v.y * v.y, s * v.y * v.z, s * v.z * v.z};
}

const double epsilon = 1024;

inline Vector polar(double azimuth_deg, double elevation_deg)
{
  const double c = cosine_deg(elevation_deg);
  return {c * cosine_deg(azimuth_deg), c * sine_deg(azimuth_deg), sine_deg(elevation_deg)};
}

struct Rectangle {
  Vector normal, center;
  double half_width = 20 * epsilon, half_height = 15 * epsilon, noise = 0.2 * epsilon, count = 2000;
};

inline Shape_fit make_shape(const Rectangle& r)
{
  const Vector n = unit(r.normal);
  const Plane_basis b(n);
  Shape_fit s;
  s.scatter.count = r.count;
  s.scatter.centroid = r.center;
  s.scatter.matrix = square(r.count * r.half_width * r.half_width / 3, b.u) +
                     square(r.count * r.half_height * r.half_height / 3, b.v) + square(r.count * r.noise * r.noise, n);
  s.fit = fit_plane(s.scatter);
  return s;
}

// price: of a degree of freedom, in points, whatever the size of the shape.
inline Regularity_parameters all_on(double price = 20)
{
  Regularity_parameters o;
  o.angle_tolerance_deg = 8;
  o.maximum_offset_steps = o.maximum_distance_steps = epsilon;
  o.freedom.least = price;
  return o;
}

inline Relations run(const Shape_fits& shapes, const Regularity_parameters& options = all_on())
{
  return regularize(shapes, std::vector<char>(shapes.size(), 0), options);
}

inline Shape_fits make_shapes(const std::vector<Rectangle>& rectangles)
{
  Shape_fits shapes;
  for(const Rectangle& r : rectangles)
    shapes.push_back(make_shape(r));
  return shapes;
}

inline Relations run(const std::vector<Rectangle>& rectangles, const Regularity_parameters& options = all_on())
{
  return run(make_shapes(rectangles), options);
}

// What a normal adds to the sum of squared distances of a shape (steps^2).
inline double loss(const Shape_fit& s, const Vector& n)
{
  return quadratic_form(s.scatter.matrix, n) - quadratic_form(s.scatter.matrix, canonical(s.fit.normal));
}

// What every result promises.
inline void check_tables(const Relations& r, std::size_t n, const std::string& what)
{
  check_equal(double(r.direction_of.size()), double(n), what + ": directions of shapes");
  check_equal(double(r.plane_of.size()), double(n), what + ": planes of shapes");
  check_equal(double(r.is_rolled_back.size()), double(n), what + ": flags");
  for(std::size_t i = 0; i < n; ++i) {
    const Vector& d = r.directions.at(r.direction_of[i]);
    check(is_same(d, r.planes.at(r.plane_of[i]).normal), what + ": the plane has the bits of the direction, shape",
          double(i));
    check_close(dot(d, d), 1, 1e-15, what + ": unit");
  }
}

// Pairs of directions within the angle of orthogonal that are not exactly so.
inline int inexact_pairs(const Relations& r, double angle_deg)
{
  int inexact = 0;
  for(std::size_t i = 0; i < r.directions.size(); ++i)
    for(std::size_t j = i + 1; j < r.directions.size(); ++j)
      if(std::fabs(dot(r.directions[i], r.directions[j])) < sine_deg(angle_deg) &&
         !are_orthogonal(r.directions[i], r.directions[j])) {
        ++inexact;
      }
  return inexact;
}

// The faces of a box, tilted by about a degree
inline std::vector<Rectangle> tilted_box(int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0, 1);
  auto any = [&] { return Vector{gauss(random), gauss(random), gauss(random)}; };
  const Vector z = unit(any()), x = made_orthogonal(any(), z), y = cross(z, x);
  std::vector<Rectangle> box;
  const Vector axis[3] = {x, y, z};
  for(int f = 0; f < 6; ++f) {
    const Vector n = unit(add_scaled(axis[f / 2], 0.01, any()));
    box.push_back(
      {n, (f % 2 ? 1e5 : -1e5) * axis[f / 2], (10.0 + f) * epsilon, (8.0 + f) * epsilon, 200, 1000.0 + 100 * f});
  }
  return box;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RECTANGLES_H
