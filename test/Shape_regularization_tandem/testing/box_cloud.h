// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small cloud for the tests of the public face: the six noisy faces of a turned
// box and a few outliers. All numbers are floats, so that it is the same cloud in
// every kernel.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BOX_CLOUD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BOX_CLOUD_H

#include "checks.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/property_map.h>

#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Box_point {
  std::array<float, 3> position, normal;
};

inline float random_unit(std::mt19937& random) { return float(random() >> 8) * 0x1p-24f; }

inline std::vector<Box_point> make_box_cloud(int points_a_face = 1500, float noise = .002f)
{
  const double axis[3][3] = {{.36, .48, -.8}, {-.8, .6, 0}, {.48, .64, .6}}; // orthonormal
  const double size[3] = {1, .8, .6};
  std::mt19937 random(7);
  std::vector<Box_point> cloud;
  for(int face = 0; face < 6; ++face)
    for(int i = 0; i < points_a_face; ++i) {
      const int across = face / 2, side = face % 2;
      double c[3];
      for(int a = 0; a < 3; ++a)
        c[a] = random_unit(random) * size[a];
      c[across] = side * size[across] + noise * (random_unit(random) + random_unit(random) - 1);
      Box_point p;
      for(int a = 0; a < 3; ++a) {
        p.position[a] = float(c[0] * axis[0][a] + c[1] * axis[1][a] + c[2] * axis[2][a]);
        p.normal[a] = float((2 * side - 1) * axis[across][a] + .1 * (random_unit(random) - .5));
      }
      cloud.push_back(p);
    }
  for(int i = 0; i < points_a_face / 10; ++i) {
    Box_point p;
    for(int a = 0; a < 3; ++a) {
      p.position[a] = 2 * random_unit(random) - .5f;
      p.normal[a] = random_unit(random) - .5f;
    }
    cloud.push_back(p);
  }
  return cloud;
}

template <class Kernel>
using Pair = std::pair<typename Kernel::Point_3, typename Kernel::Vector_3>;

template <class Kernel>
using Pairs = std::vector<Pair<Kernel>>;

template <class Kernel>
Pairs<Kernel> make_pairs(const std::vector<Box_point>& cloud)
{
  Pairs<Kernel> pairs;
  for(const Box_point& p : cloud)
    pairs.emplace_back(typename Kernel::Point_3(p.position[0], p.position[1], p.position[2]),
                       typename Kernel::Vector_3(p.normal[0], p.normal[1], p.normal[2]));
  return pairs;
}

template <class Kernel>
using First = CGAL::First_of_pair_property_map<Pair<Kernel>>;

template <class Kernel>
using Second = CGAL::Second_of_pair_property_map<Pair<Kernel>>;

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BOX_CLOUD_H
