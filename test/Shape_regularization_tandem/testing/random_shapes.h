// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of one shape with their fit and their sample, and random ones, for tests of unions.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_SHAPES_H

#include "fragments.h"

#include <random>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Points {
  Grid_points point;
  Fitted_moments fitted;
  Shape_sample sample;

  void finish(std::uint32_t first_position, std::uint8_t tolerance_level = 0)
  {
    for(const Grid_point& p : point)
      fitted.moments.add(p, 1, tolerance_level);
    refit(fitted);
    sample = sample_of(point, first_position, tolerance_level);
  }
  std::int64_t size() const { return std::int64_t(point.size()); }
};

// Up to 64 points of a square on a plane, with noise; some normals lean too much for the plane.
inline Points random_shape(int n, int x, std::mt19937& random)
{
  const auto uniform = [&](double low, double high) { return low + (high - low) * double(random() % 100000) / 100000; };
  const double slope_x = uniform(-.1, .1), slope_y = uniform(-.05, .05), height = uniform(-1, 1) * maximum_distance;
  const double noise = uniform(0, .6) * maximum_distance;
  const bool has_outliers = random() % 2 == 0;
  Points s;
  for(int i = 0; i < n; ++i) {
    const double u = uniform(-500, 500), v = uniform(-500, 500);
    const double lean = has_outliers && random() % 12 == 0 ? .45 : 0; // 24 degrees, and the slope
    s.point.push_back({x + int(u), int(v), int(slope_x * u + slope_y * v + height + uniform(-noise, noise)),
                       encode_normal({lean - slope_x, -slope_y, 1})});
  }
  return s;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_SHAPES_H
