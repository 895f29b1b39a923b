// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rough faces among many small patches that are exactly planar: the patches have the best seeds and
// are too small for a shape, so that in the first rounds nothing seems to grow.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PATCHES_CLOUD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PATCHES_CLOUD_H

#include "test_support.h"

constexpr std::size_t rough_faces = 30, points_of_rough_face = 400, points_of_patch = 30;

struct Roughness {
  double distance, angle; // standard deviations
};

// Somewhere in a cube of side 6, turned anyhow.
inline void add_square(scenes::Random& random, Cloud& cloud, std::size_t points, double side,
                       const Roughness& roughness)
{
  using scenes::Vec;
  const Vec n = random.direction();
  const Vec u = unit(cross(n, random.direction())), v = cross(n, u);
  const Vec corner{6 * random.uniform(), 6 * random.uniform(), 6 * random.uniform()};
  for(std::size_t i = 0; i < points; ++i) {
    const Vec in_plane = add_scaled(add_scaled(corner, side * random.uniform(), u), side * random.uniform(), v);
    const Vec p = add_scaled(in_plane, roughness.distance * random.gaussian(), n);
    const Vec m = unit(add_scaled(n, roughness.angle, random.gaussian_vector()));
    cloud.emplace_back(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(m.x, m.y, m.z));
  }
}

// The points of each face first, one face after the other.
inline Cloud make_patches_cloud(std::size_t patches, double face_noise)
{
  scenes::Random random(11);
  Cloud cloud;
  for(std::size_t i = 0; i < rough_faces; ++i)
    add_square(random, cloud, points_of_rough_face, 1, {face_noise, .1});
  for(std::size_t i = 0; i < patches; ++i)
    add_square(random, cloud, points_of_patch, .3, {0, 0});
  return cloud;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PATCHES_CLOUD_H
