// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The counterpart of CGAL's own test of plane regularization, with assertions that can fail.

#include "testing/test_support.h"

BOOST_AUTO_TEST_SUITE(test_cgal_scenes)

using scenes::Random;
using scenes::Vec;

// test_plane_regularization: two unit squares of 5000 points, `degrees` apart. There "changed" is only printed.
Cloud two_planes(double degrees, double offset)
{
  Cloud cloud;
  Random random(3);
  const double radians = degrees * .017453292519943295;
  const Vec u = {std::cos(radians), 0, std::sin(radians)}, n = {-u.z, 0, u.x};
  for(int i = 0; i < 5000; ++i) {
    const double a = random.uniform(), b = random.uniform();
    add(cloud, {a, b, 0}, {0, 0, 1});
    add(cloud, Vec{2.2, 0, offset} + (random.uniform() - .5) * u + Vec{0, random.uniform(), 0}, n);
  }
  return cloud;
}

// A degree of freedom is worth 70 points here: .1 of 200 and 1 % of 5000; a direction has two. To turn a square by 2
// degrees costs 35 points, by 3 degrees 80, by 10 degrees 870; to move both by .0075 costs 40, by .03 it costs 630.
BOOST_AUTO_TEST_CASE(test_regularization)
{
  struct Case {
    double degrees, offset, tolerance, maximum_offset;
    std::size_t directions, right_angles, planes;
  };
  for(const Case& c : {Case{3, .5, 2, .1, 2, 0, 2}, Case{3, .5, 6, .1, 1, 0, 2}, Case{10, .5, 15, .1, 2, 0, 2},
                       Case{88, .7, 1, .1, 2, 0, 2}, Case{88, .7, 6, .1, 2, 1, 2}, Case{80, .7, 15, .1, 2, 0, 2},
                       Case{0, .015, 5, .01, 1, 0, 2}, Case{0, .015, 5, .1, 1, 0, 1}, Case{0, .06, 5, .1, 1, 0, 2}}) {
    Parameters p = make_parameters(.12, 200);
    p.angle_tolerance = c.tolerance;
    p.maximum_offset = c.maximum_offset;
    const std::string name = std::to_string(c.degrees) + " degrees within " + std::to_string(c.tolerance);
    const Shapes shapes = detect_valid(name, two_planes(c.degrees, c.offset), p);
    check_counts(name, shapes, 2, c.directions, c.planes);
    check_equal(shapes.orthogonal_groups().size(), c.right_angles, name + ": right angles");
  }
}

BOOST_AUTO_TEST_SUITE_END()
