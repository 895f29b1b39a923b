// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds of known noise, for tests of what is estimated from it: turned, moved and scaled as a seed says.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NOISY_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NOISY_CLOUDS_H

#include "tolerances.h"

namespace noisy_clouds {

using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Points = std::vector<Point>;
using scenes::Random;

inline Vector random_vector(Random& random)
{
  const scenes::Vec v = random.gaussian_vector();
  return {v.x, v.y, v.z};
}

// A rotation, a shift and a scale.
struct Pose {
  scenes::Frame frame;
  double scale;

  Pose(unsigned seed, double s) : scale(s)
  {
    Random random(seed);
    frame = scenes::Frame().turned(random.direction(), .7);
    frame.origin = 50 * random.direction();
  }

  Points operator()(const Points& points) const
  {
    Points moved;
    for(const Point& p : points) {
      const scenes::Vec q = scale * frame.point({p.x(), p.y(), p.z()});
      moved.emplace_back(q.x, q.y, q.z);
    }
    return moved;
  }
};

struct Parallelogram {
  Point origin;
  Vector u, v;
};

// n points of a parallelogram.
inline void add_patch(Points& points, std::size_t n, const Parallelogram& patch, double noise, Random& random)
{
  const Vector w = CGAL::cross_product(patch.u, patch.v), normal = w / std::sqrt(w.squared_length());
  for(std::size_t i = 0; i < n; ++i)
    points.push_back(patch.origin + random.uniform() * patch.u + random.uniform() * patch.v +
                     noise * random.gaussian() * normal);
}

// Floor and two walls.
inline Points room(std::size_t n, double noise, Random& random)
{
  Points points;
  add_patch(points, n / 3, {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, noise, random);
  add_patch(points, n / 3, {{0, 3, 0}, {4, 0, 0}, {0, 0, 2.5}}, noise, random);
  add_patch(points, n / 3, {{4, 0, 0}, {0, 3, 0}, {0, 0, 2.5}}, noise, random);
  return points;
}

// Each point so many times, so far apart.
inline Points copied(const Points& points, int copies, double jitter, Random& random)
{
  Points copy;
  for(const Point& p : points)
    for(int i = 0; i < copies; ++i)
      copy.push_back(p + jitter * random_vector(random));
  return copy;
}

// A low roof: the angle between its sides, in degrees.
inline Points ridge(std::size_t n, double degrees, double noise, Random& random)
{
  const double slope = std::tan(degrees / 2 * .017453292519943295);
  Points points;
  for(std::size_t i = 0; i < n; ++i) {
    const double x = 12 * random.uniform() - 6, y = 10 * random.uniform();
    points.emplace_back(x, y, 5 - std::fabs(x) * slope + noise * random.gaussian());
  }
  return points;
}

// A tilted plane of side^2 points whose height is rounded to steps; noise in steps.
inline Points steps(int side, double step, double degrees, double noise, Random& random)
{
  const double slope = std::tan(degrees * .017453292519943295);
  Points points;
  for(int i = 0; i < side; ++i)
    for(int j = 0; j < side; ++j) {
      const double x = 2. * i / (side - 1), y = 2. * j / (side - 1);
      points.emplace_back(x, y, step * std::round((slope * x + .31 * slope * y) / step + noise * random.gaussian()));
    }
  return points;
}

// What a depth camera sees of a corridor, and the noise across the wall of each point.
struct Noisy_corridor {
  Points points;
  std::vector<double> noise;
  std::vector<bool> is_end;

  Noisy_corridor(int width, int height, double end, Random& random)
  {
    const Corridor seen(width, height, end, random);
    for(std::size_t i = 0; i < seen.cloud.size(); ++i) {
      const auto& [p, n] = seen.cloud[i];
      points.push_back(p);
      noise.push_back(.0028 * p.z() * std::fabs(n * (p - CGAL::ORIGIN)));
      is_end.push_back(seen.label[i] == 4);
    }
  }
};

} // namespace noisy_clouds

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NOISY_CLOUDS_H
