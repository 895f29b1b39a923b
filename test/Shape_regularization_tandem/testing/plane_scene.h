// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points with the planes that they were found in: a noisy, turned box.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLANE_SCENE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLANE_SCENE_H

#include "scenes/scenes.h"

#include <CGAL/property_map.h>

#include <array>
#include <vector>

template <class Kernel>
struct Scene {
  std::vector<typename Kernel::Point_3> points;
  std::vector<typename Kernel::Plane_3> planes;
  std::vector<int> index;

  auto index_map() const { return CGAL::make_property_map(index.data()); }
};

using V = std::array<double, 3>;

inline double dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The faces of a box of extent 10, moved by `far`, and two halves of a seventh face
// parallel to the last one. Points have noise; given planes are off by up to two degrees.
template <class Kernel>
Scene<Kernel> make_box(int seed, double noise, double far = 0)
{
  using Vec = CGAL::Tandem::scenes::Vec;
  using RT = typename Kernel::RT;
  CGAL::Tandem::scenes::Random random(std::uint64_t(seed) + 1);
  const auto uniform = [&] { return 2 * random.uniform() - 1; };
  const auto frame = CGAL::Tandem::scenes::Frame().turned(random.direction(), .7);
  const Vec axis[] = {frame.x, frame.y, frame.z, frame.x, frame.y}, shift = {far, far, far};
  Scene<Kernel> s;
  for(int f = 0; f < 8; ++f) {
    const Vec* const axes = axis + (std::min)(f / 2, 2); // the normal first
    const double offset = f < 6 ? (f % 2 ? 5 : -5) : 8 + (f == 6 ? .004 : -.004);
    const int n = 500 + 20 * f;
    Vec mean = {0, 0, 0};
    for(int i = 0; i < n; ++i) {
      const double b = f < 6 ? 5 * uniform() : (f == 6 ? 3 : -3) + 2 * uniform();
      const Vec in_plane = add_scaled(5 * uniform() * axes[1], b, axes[2]);
      const Vec p = shift + add_scaled(in_plane, offset + noise * random.gaussian(), axes[0]);
      mean = add_scaled(mean, 1. / n, p);
      s.points.push_back(typename Kernel::Point_3(p.x, p.y, p.z));
      s.index.push_back(f);
    }
    const double u = .02 * uniform(), v = .02 * uniform();
    const Vec tilted = (f % 3 ? 1. : -1.) * add_scaled(add_scaled(axes[0], u, axes[1]), v, axes[2]);
    s.planes.push_back(typename Kernel::Plane_3(RT(tilted.x), RT(tilted.y), RT(tilted.z), RT(-dot(tilted, mean))));
  }
  for(int i = 0; i < 50; ++i) { // clutter
    s.points.push_back({far + 9 * uniform(), far + 9 * uniform(), far + 9 * uniform()});
    s.index.push_back(-1);
  }
  return s;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PLANE_SCENE_H
