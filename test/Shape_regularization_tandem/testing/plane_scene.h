// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points with the planes that they were found in: a noisy, turned box.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLANE_SCENE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLANE_SCENE_H

#include <CGAL/number_utils.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

struct Index_map {
  using key_type = std::size_t;
  using value_type = int;
  using reference = int;
  using category = boost::readable_property_map_tag;
  const std::vector<int>* index;
  friend int get(const Index_map& map, std::size_t i) { return (*map.index)[i]; }
};

template <class Kernel>
struct Scene {
  using Point_3 = typename Kernel::Point_3;
  using Plane_3 = typename Kernel::Plane_3;
  std::vector<Point_3> points;
  std::vector<Plane_3> planes;
  std::vector<int> index;

  Index_map index_map() const { return {&index}; }
};

using V = std::array<double, 3>;

inline double dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline V cross(const V& a, const V& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline V unit(const V& a)
{
  const double l = std::sqrt(dot(a, a));
  return {a[0] / l, a[1] / l, a[2] / l};
}

// The frame of the box: turned by some angles.
inline void make_frame(int seed, V& x, V& y, V& z)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0, 1);
  z = unit({gauss(random), gauss(random), gauss(random)});
  x = unit(cross(z, {gauss(random), gauss(random), gauss(random)}));
  y = cross(z, x);
}

// The faces of a box of extent 10, moved by `far`, and two halves of a seventh face
// parallel to the last one. Points have noise; given planes are off by up to two degrees.
template <class Kernel>
Scene<Kernel> make_box(int seed, double noise, double far = 0)
{
  V axis[3];
  make_frame(seed, axis[0], axis[1], axis[2]);
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss(0, 1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Scene<Kernel> s;
  for(int f = 0; f < 8; ++f) {
    const V &n = axis[(std::min)(f / 2, 2)], &u = axis[((std::min)(f / 2, 2) + 1) % 3],
            &v = axis[((std::min)(f / 2, 2) + 2) % 3];
    const double offset = f < 6 ? (f % 2 ? 5 : -5) : 8 + (f == 6 ? 0.004 : -0.004);
    V mean = {0, 0, 0};
    for(int i = 0; i < 500 + 20 * f; ++i) {
      const double a = 5 * uniform(random), b = f < 6 ? 5 * uniform(random) : (f == 6 ? 3 : -3) + 2 * uniform(random);
      V p;
      for(int c = 0; c < 3; ++c) {
        p[c] = far + (offset + noise * gauss(random)) * n[c] + a * u[c] + b * v[c];
        mean[c] += p[c] / (500 + 20 * f);
      }
      s.points.push_back(typename Kernel::Point_3(p[0], p[1], p[2]));
      s.index.push_back(f);
    }
    const double sign = f % 3 ? 1 : -1;
    V tilted;
    for(int c = 0; c < 3; ++c)
      tilted[c] = sign * (n[c] + 0.02 * uniform(random) * u[c] + 0.02 * uniform(random) * v[c]);
    using RT = typename Kernel::RT;
    s.planes.push_back(typename Kernel::Plane_3(RT(tilted[0]), RT(tilted[1]), RT(tilted[2]), RT(-dot(tilted, mean))));
  }
  for(int i = 0; i < 50; ++i) { // clutter
    s.points.push_back({far + 9 * uniform(random), far + 9 * uniform(random), far + 9 * uniform(random)});
    s.index.push_back(-1);
  }
  return s;
}

template <class Plane_3>
V normal_of(const Plane_3& p)
{
  return {CGAL::to_double(p.a()), CGAL::to_double(p.b()), CGAL::to_double(p.c())};
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLANE_SCENE_H
