// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds of known noise, for tests of what is estimated from it: turned, moved and scaled as a seed says.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NOISY_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NOISY_CLOUDS_H

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace noisy_clouds {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Points = std::vector<Point>;

// Numbers that do not depend on the library.
class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform() { return double(engine_() >> 5) * 0x1p-27; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  // Of variance 1.
  double normal()
  {
    const double u = uniform(), v = uniform();
    return std::sqrt(-2 * std::log(u + 1e-9)) * std::cos(6.283185307179586 * v);
  }

private:
  std::mt19937 engine_;
};

// A rotation, a shift and a scale.
struct Pose {
  Vector x, y, z, shift;
  double scale;

  Pose(unsigned seed, double s) : scale(s)
  {
    Random random(seed);
    const Vector u(random.normal(), random.normal(), random.normal()),
      v(random.normal(), random.normal(), random.normal());
    x = u / std::sqrt(u.squared_length());
    z = CGAL::cross_product(x, v);
    z = z / std::sqrt(z.squared_length());
    y = CGAL::cross_product(z, x);
    shift = s * Vector(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50));
  }

  Vector turned(const Vector& v) const { return v.x() * x + v.y() * y + v.z() * z; }

  Points operator()(const Points& points) const
  {
    Points moved;
    for(const Point& p : points)
      moved.push_back(CGAL::ORIGIN + (scale * turned(p - CGAL::ORIGIN) + shift));
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
                     noise * random.normal() * normal);
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
      copy.push_back(p + jitter * Vector(random.normal(), random.normal(), random.normal()));
  return copy;
}

// A low roof: the angle between its sides, in degrees.
inline Points ridge(std::size_t n, double degrees, double noise, Random& random)
{
  const double slope = std::tan(degrees / 2 * .017453292519943295);
  Points points;
  for(std::size_t i = 0; i < n; ++i) {
    const double x = random.uniform(-6, 6);
    points.emplace_back(x, random.uniform(0, 10), 5 - std::fabs(x) * slope + noise * random.normal());
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
      points.emplace_back(x, y, step * std::round((slope * x + .31 * slope * y) / step + noise * random.normal()));
    }
  return points;
}

// What a depth camera sees of a corridor with an end wall, with noise .0028 z^2 along each ray.
struct Corridor {
  Points points;
  std::vector<double> noise; // across the wall of each point
  double end;
  std::vector<bool> is_end;

  Corridor(int width, int height, double e, Random& random) : end(e)
  {
    const double focal = .9 * width;
    for(int j = 0; j < height; ++j)
      for(int i = 0; i < width; ++i) {
        const Vector ray((i - width / 2.) / focal, (j - height / 2.) / focal, 1);
        const double side = 1.2 / std::max(std::fabs(ray.x()), 1e-9);
        const double level = (ray.y() > 0 ? 1.2 : 1.3) / std::max(std::fabs(ray.y()), 1e-9);
        const double z = std::min({side, level, end});
        const double across = z == end ? 1 : z == side ? std::fabs(ray.x()) : std::fabs(ray.y());
        points.push_back(CGAL::ORIGIN + (z + .0028 * z * z * random.normal()) * ray);
        noise.push_back(.0028 * z * z * across);
        is_end.push_back(z == end);
      }
  }
};

} // namespace noisy_clouds

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NOISY_CLOUDS_H
