// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What directions are found by: angles, and fits of one and of several shapes.

#include "testing/rectangles.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_direction_fits)

using namespace CGAL::Tandem::internal;

BOOST_AUTO_TEST_CASE(angles)
{
  const double pi = 3.14159265358979323846;
  for(double d = -725; d <= 725; d += 0.37) {
    check_close(sine_deg(d), std::sin(std::fmod(d, 360) * pi / 180), 2e-15, "sine of " + std::to_string(d));
    check_close(cosine_deg(d), std::cos(std::fmod(d, 360) * pi / 180), 2e-15, "cosine of " + std::to_string(d));
  }
  for(double d = 0; d <= 90; d += 0.01) {
    const double s = sine_deg(d), c = cosine_deg(d);
    check_close(s, double(std::sin((long double)d * 3.14159265358979323846264338327950288L / 180)), 4e-16, "sine");
    check_close(c, double(std::cos((long double)d * 3.14159265358979323846264338327950288L / 180)), 4e-16, "cosine");
  }
  check_equal(sine_deg(90), 1, "sine of 90");
  check_equal(cosine_deg(90), 0, "cosine of 90");
}

BOOST_AUTO_TEST_CASE(group_fit)
{
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.03);
  Shape_fits shapes;
  Symmetric_matrix sum = {0, 0, 0, 0, 0, 0};
  for(int i = 0; i < 5; ++i) {
    shapes.push_back(make_shape({{0.3 + noise(random), 0.4 + noise(random), 0.86},
                                 {1e5 * i, 0, 0},
                                 4 * epsilon,
                                 (2 + i) * epsilon,
                                 100,
                                 500.0 + 300 * i}));
    sum = sum + shapes.back().scatter.matrix;
  }
  const Relations r = run(shapes, all_on(1e6));
  check_equal(r.directions.size(), 1u, "directions of the group");
  const Vector n = r.directions[0];
  const Plane_basis b(n);
  for(double step : {1e-6, 1e-4, 1e-2})
    for(int k = 0; k < 360; k += 5) {
      const Vector other = unit(add_scaled(n, step, b.lifted(cosine_deg(k), sine_deg(k))));
      check(quadratic_form(sum, other) >= quadratic_form(sum, n) * (1 - 1e-12), "a better direction of the group", k);
    }
}

BOOST_AUTO_TEST_CASE(constrained_fits)
{
  const Vector x = unit({1, 2, 3});
  const Plane_basis b(x);
  const Shape_fit s = make_shape({{3, -1.4, 0}, {0, 0, 0}}),
                  t = make_shape({{1.0, 2.1, -1.8}, {0, 0, 0}, 9000, 5000, 200, 900});
  const Vector f = fit_orthogonal(s.scatter.matrix, x, s.fit.normal);
  const Vector g = fit_frame(s.scatter.matrix, t.scatter.matrix, x, s.fit.normal), h = orthogonal_to_both(x, g);
  check(are_orthogonal(f, x) && are_orthogonal(g, x) && are_orthogonal(h, x) && are_orthogonal(g, h), "constraints");
  const double one = quadratic_form(s.scatter.matrix, f);
  const double two = quadratic_form(s.scatter.matrix, g) + quadratic_form(t.scatter.matrix, h);
  for(int k = 0; k < 3600; ++k) {
    const Vector v = b.lifted(cosine_deg(0.1 * k), sine_deg(0.1 * k)), w = cross(x, v);
    check(quadratic_form(s.scatter.matrix, v) >= one * (1 - 1e-12), "a better normal orthogonal to x", k);
    check(quadratic_form(s.scatter.matrix, v) + quadratic_form(t.scatter.matrix, w) >= two * (1 - 1e-12),
          "a better frame", k);
  }
  // first-order cost of a right angle against the constrained fit
  const Eigen_system e = eigen_system(s.scatter.matrix);
  const Vector near = unit(add_scaled(x, -dot(x, e.vector[0]) + 0.02, e.vector[0]));
  const double exact = quadratic_form(s.scatter.matrix, fit_orthogonal(s.scatter.matrix, near, f)) - e.value[0];
  check_close(cost_of_right_angle(e, near) / exact, 1, 0.01, "cost of a right angle");
}

BOOST_AUTO_TEST_SUITE_END()
