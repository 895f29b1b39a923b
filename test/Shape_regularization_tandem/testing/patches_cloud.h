// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rough faces among many small patches that are exactly planar: the patches have the best seeds and
// are too small for a shape, so that in the first rounds nothing seems to grow.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PATCHES_CLOUD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PATCHES_CLOUD_H

#include "test_support.h"

// Turned anyhow, with a corner somewhere in the cube [low, high]^3.
struct Squares {
  std::size_t count, points; // of each
  double width;
  double distance_noise = 0, angle_noise = 0; // standard deviations
  double low = 0, high = 6;
};

inline void add_squares(scenes::Random& random, Cloud& cloud, const Squares& squares)
{
  using scenes::Vec;
  const auto place = [&] { return squares.low + (squares.high - squares.low) * random.uniform(); };
  for(std::size_t i = 0; i < squares.count; ++i) {
    const Vec n = random.direction();
    const Vec u = unit(cross(n, random.direction())), v = cross(n, u);
    const double x = place(), y = place(), z = place();
    for(std::size_t j = 0; j < squares.points; ++j) {
      const double a = squares.width * random.uniform(), b = squares.width * random.uniform();
      const Vec in_plane = add_scaled(add_scaled(Vec{x, y, z}, a, u), b, v);
      const Vec p = add_scaled(in_plane, squares.distance_noise * random.gaussian(), n);
      const Vec m = unit(add_scaled(n, squares.angle_noise, random.gaussian_vector()));
      add(cloud, p, m);
    }
  }
}

// The points of the faces first, one face after the other.
inline Cloud make_squares_cloud(const Squares& faces, const Squares& patches)
{
  scenes::Random random(11);
  Cloud cloud;
  add_squares(random, cloud, faces);
  add_squares(random, cloud, patches);
  return cloud;
}

constexpr std::size_t points_of_patch = 30;

inline Squares make_rough_faces(double noise) { return {30, 400, 1, noise, .1}; }
inline Squares make_patches(std::size_t count) { return {count, points_of_patch, .3}; }

inline Cloud make_patches_cloud(std::size_t patches, double face_noise)
{
  return make_squares_cloud(make_rough_faces(face_noise), make_patches(patches));
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PATCHES_CLOUD_H
