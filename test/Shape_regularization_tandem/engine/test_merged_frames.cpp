// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Copies of points, exact and jittered, and frames of a depth camera at rest are what one of them is: the planes of the
// scene, whatever the number of copies, the unit, and the pose.

#include "testing/test_support.h"

#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_merged_frames)

using scenes::Vec;

// A turned frame of reference and a unit of length.
struct Pose {
  explicit Pose(scenes::Random& random)
    : x(random.direction()), y(scenes::unit(scenes::cross(x, random.direction()))), z(scenes::cross(x, y)),
      unit(std::exp2(6 * random.uniform() - 3))
  {}

  Vec at(double a, double b, double c) const { return unit * (a * x + b * y + c * z); }

  Vec x, y, z;
  double unit;
};

// Three walls of a room, 4 by 3 by 2.5. Each point is there several times.
Cloud copies_of_room(int copies, double jitter, scenes::Random& random, const Pose& pose)
{
  Cloud cloud;
  for(int i = 0; i < 900; ++i) {
    const double a = random.uniform(), b = random.uniform();
    const Vec p = i % 3 == 0 ? Vec{4 * a, 3 * b, 0} : i % 3 == 1 ? Vec{4 * a, 3, 2.5 * b} : Vec{4, 3 * a, 2.5 * b};
    const Vec rounded = {std::round(100 * p.x) / 100, std::round(100 * p.y) / 100, std::round(100 * p.z) / 100};
    for(int c = 0; c < copies; ++c) {
      const Vec q = rounded + jitter * random.gaussian_vector();
      add(cloud, pose.at(q.x, q.y, q.z), pose.z);
    }
  }
  return cloud;
}

// A corridor with an end wall, seen by a camera that stands still; the noise is along the rays.
Cloud frames_of_corridor(int frames, scenes::Random& random, const Pose& pose)
{
  Cloud cloud;
  for(int row = 0; row < 36; ++row)
    for(int column = 0; column < 48; ++column) {
      const double a = (column - 24) / 43., b = (row - 18) / 43.;
      const double z = (std::min)({2.5, 1.2 / (std::max)(std::fabs(a), 1e-9), 1.25 / (std::max)(std::fabs(b), 1e-9)});
      for(int f = 0; f < frames; ++f) {
        const double depth = z + .0028 * z * z * random.gaussian();
        add(cloud, pose.at(a * depth, b * depth, depth), pose.z);
      }
    }
  return cloud;
}

void check_planes(const std::string& name, const Cloud& cloud, double epsilon, std::size_t minimum)
{
  const Shapes shapes = detect_valid(name, cloud, make_parameters(epsilon, minimum), Given::nothing);
  check_equal(shapes.number_of_coplanar_groups(), std::size_t(3), name + ": planes");
  check_equal(shapes.number_of_shapes(), std::size_t(3), name + ": shapes");
  CHECK_AT(shapes.statistics().coverage > .93, name + ": coverage " + std::to_string(shapes.statistics().coverage));
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(std::uint64_t seed = 1; seed <= 3; ++seed) {
    scenes::Random random(seed);
    const Pose pose(random);
    const std::string of = ", seed " + std::to_string(seed);
    for(const int copies : {1, 2, 8, 20})
      check_planes(std::to_string(copies) + " copies" + of, copies_of_room(copies, 0, random, pose), .02 * pose.unit,
                   40);
    for(const int copies : {3, 15})
      check_planes(std::to_string(copies) + " jittered copies" + of, copies_of_room(copies, .003, random, pose),
                   .02 * pose.unit, 40);
    for(const int frames : {1, 4, 8, 15})
      check_planes(std::to_string(frames) + " frames" + of, frames_of_corridor(frames, random, pose), .05 * pose.unit,
                   100);
  }
  // Few surfels in a cell; and a heap of all points of a dead sensor.
  scenes::Random random(9);
  const Pose pose(random);
  check_planes("200 copies", copies_of_room(200, 0, random, pose), .02 * pose.unit, 40);
  Cloud with_heap = copies_of_room(4, 0, random, pose);
  for(int i = 0; i < 100000; ++i)
    add(with_heap, {7 * pose.unit, 7 * pose.unit, 7 * pose.unit}, pose.z);
  const Shapes shapes = detect_valid("a heap", with_heap, make_parameters(.02 * pose.unit, 40), Given::nothing);
  check_equal(shapes.number_of_shapes(), std::size_t(3), "shapes beside a heap of equal points");
}

BOOST_AUTO_TEST_SUITE_END()
