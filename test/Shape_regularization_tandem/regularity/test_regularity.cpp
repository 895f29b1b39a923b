// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Angles, constrained fits, and the regularity step as a whole on analytic sets of shapes: which
// become orthogonal and which do not, and degenerate input.

#include "testing/rectangles.h"

#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_regularity)

using namespace CGAL::Tandem::internal;

BOOST_AUTO_TEST_CASE(angles)
{
  constexpr long double degree = 3.14159265358979323846264338327950288L / 180;
  for(double d = -725; d <= 725; d += d >= 0 && d < 90 ? .01 : .37) {
    check_close(sine_deg(d), double(std::sin(d * degree)), 4e-16, "sine of " + std::to_string(d));
    check_close(cosine_deg(d), double(std::cos(d * degree)), 4e-16, "cosine of " + std::to_string(d));
  }
  check_equal(sine_deg(90), 1, "sine of 90");
  check_equal(cosine_deg(90), 0, "cosine of 90");
}

BOOST_AUTO_TEST_CASE(constrained_fits)
{
  const Vector x = unit({1, 2, 3});
  const Plane_basis b(x);
  const Shape_fit s = make_shape({{3, -1.4, 0}, {0, 0, 0}});
  const Vector f = fit_orthogonal(s.scatter.matrix, x, s.fit.normal);
  const Vector y = unit({3, -2, 1}), h = orthogonal_to_both(x, y);
  check(are_orthogonal(f, x) && are_orthogonal(h, x) && are_orthogonal(h, y), "constraints");
  const double one = quadratic_form(s.scatter.matrix, f);
  for(int k = 0; k < 3600; ++k)
    check(quadratic_form(s.scatter.matrix, b.lifted(cosine_deg(0.1 * k), sine_deg(0.1 * k))) >= one * (1 - 1e-12),
          "a better normal orthogonal to x", k);
  // first-order cost of a right angle against the constrained fit
  const Eigen_system e = eigen_system(s.scatter.matrix);
  const Vector near = unit(add_scaled(x, -dot(x, e.vector[0]) + 0.02, e.vector[0]));
  const double exact = quadratic_form(s.scatter.matrix, fit_orthogonal(s.scatter.matrix, near, f)) - e.value[0];
  const Stiffness stiffness(e);
  check_close(stiffness.cost(near) / exact, 1, 0.01, "cost of a right angle");
  // beside another one, which the normal has
  const Vector beside = unit(cross(e.vector[0], f)), both = orthogonal_to_both(near, beside);
  const double d = dot(e.vector[0], near);
  check_close(stiffness(near, beside) * d * d / (quadratic_form(s.scatter.matrix, both) - e.value[0]), 1, 0.01,
              "cost of a second right angle");
}

// Boxes with gabled roofs on two walls: each roof plane is orthogonal to one wall, not to the other.
BOOST_AUTO_TEST_CASE(chained_frames)
{
  for(int seed = 0; seed < 50; ++seed) {
    std::vector<Rectangle> house = tilted_box(seed);
    const Vector n[3] = {house[0].normal, house[2].normal, house[4].normal};
    for(double tilt : {35.0, -35.0, 20.0})
      house.push_back(
        {add_scaled(cosine_deg(tilt) * n[2], sine_deg(tilt), n[0]), {3e5, tilt * 1e4, 0}, 9000, 7000, 150, 300});
    const Relations r = run(house, all_on(200));
    check_tables(r, 9, "house " + std::to_string(seed));
    check_equal(r.directions.size(), 6u, "directions of house " + std::to_string(seed));
    check_equal(inexact_pairs(r, 4), 0, "nearly orthogonal pairs of house " + std::to_string(seed));
    check_equal(orthogonal_pairs(r.directions).size(), 6u, "right angles of house " + std::to_string(seed));
  }
}

BOOST_AUTO_TEST_CASE(degenerate)
{
  check_equal(run(Shape_fits()).planes.size(), 0u, "planes of nothing");
  Shape_fit point = {};
  point.scatter.count = 5;
  point.fit = fit_plane(point.scatter);
  Shape_fit empty = {};
  const Shape_fits shapes = {point, empty, make_shape({{0, 0, 1}, {0, 0, 0}}), point};
  const Relations r = run(shapes);
  check_equal(r.direction_of.size(), 4u, "shapes, some of them degenerate");
  for(double w : {0.0, 1e-9}) { // flat faces
    Rectangle a{{0, 0, 1}, {0, 0, 0}}, b{{w, 0, 1}, {5e5, 0, 0}};
    a.noise = b.noise = 0;
    check_equal(run({a, b}).directions.size(), 1u, "directions of flat faces");
  }
}

BOOST_AUTO_TEST_SUITE_END()
