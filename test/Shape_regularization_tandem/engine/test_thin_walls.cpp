// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A wall that was scanned on both sides, with normals to either side, is two shapes, also where both are closer than
// the points of one. Normals of random sides have none, and some wrong ones among them do no harm.

#include "testing/test_support.h"

#include <string>

BOOST_AUTO_TEST_SUITE(test_thin_walls)

using scenes::Vec;

struct Wall {
  int sides;
  double gap, noise;
  double turned;     // share of wrong normals
  int points = 2000; // of a side
};

// The rectangle of each side is 4 by 2.5 units.
Cloud make_wall(const Wall& wall, std::uint64_t seed)
{
  scenes::Random random(seed);
  const Vec n = random.direction(), u = scenes::unit(scenes::cross(n, random.direction())), v = scenes::cross(n, u);
  Cloud cloud;
  for(int side = 0; side < wall.sides; ++side)
    for(int i = 0; i < wall.points; ++i) {
      const Vec p = (wall.gap * side + wall.noise * random.gaussian()) * n + (4 * random.uniform()) * u +
                    (2.5 * random.uniform()) * v;
      const bool is_turned = (random.uniform() < wall.turned) != (side == 1);
      add(cloud, p, (is_turned ? -1. : 1.) * n);
    }
  return cloud;
}

void check_wall(const std::string& name, const Cloud& cloud, double epsilon, std::size_t sides, double coverage)
{
  const Shapes shapes = detect_valid(name, cloud, make_parameters(epsilon, 50));
  check_equal(shapes.number_of_shapes(), sides, name + ": shapes");
  CHECK_AT(shapes.statistics().coverage > coverage,
           name + ": coverage " + std::to_string(shapes.statistics().coverage));
  for(std::size_t i = 0; i < cloud.size() && shapes.number_of_shapes() == sides; ++i)
    if(shapes.shape_index(i) >= 0)
      CHECK_AT(sides == 1 || (shapes.shape_index(i) == shapes.shape_index(0)) == (i < cloud.size() / 2) ||
                 shapes.shape_index(0) < 0,
               name + ": points of both sides in one shape");
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::string of = ", seed " + std::to_string(seed);
    check_wall("closer than the spacing" + of, make_wall({2, .04, .004, 0}, seed), .01, 2, .95);
    check_wall("far apart" + of, make_wall({2, .12, .005, 0}, seed), .015, 2, .97);
    check_wall("with some wrong sides" + of, make_wall({2, .04, .004, .06}, seed), .01, 2, .85);
    check_wall("one side" + of, make_wall({1, 0, .004, 0}, seed), .015, 1, .97);
    check_wall("random sides" + of, make_wall({1, 0, .004, .5}, seed), .015, 1, .97);
    check_wall("some wrong sides" + of, make_wall({1, 0, .004, .05}, seed), .015, 1, .97);
  }
  // Some 30 points are one surfel, beside one of those whose normals are wrong.
  check_wall("dense, with some wrong sides", make_wall({2, .35, .02, .03, 60000}, 7), .2, 2, .96);
}

BOOST_AUTO_TEST_SUITE_END()
