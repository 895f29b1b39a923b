// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The noise that warnings are about, where it cannot be measured or is none, and the share of points in shapes, which
// counts no point at 0 0 0 twice.

#include "testing/checks.h"

#include "warnings.h"

#include <cstddef>
#include <limits>
#include <new>
#include <string>

BOOST_AUTO_TEST_SUITE(test_result_warnings)

// Another rank has measured this.
class Two_ranks : public program::Ranks {
public:
  explicit Two_ranks(double other) : other_(other) {}
  int size() const override { return 2; }
  double largest(double own) const override { return (std::max)(own, -other_); }

private:
  double other_;
};

// Of 1000 points 100 are in shapes and 600 at 0 0 0, far from the others; zeros says where these are counted.
void check_share(std::size_t CGAL::Tandem::Statistics::*zeros, double share)
{
  CGAL::Tandem::Statistics s;
  s.number_of_points = 1000;
  s.number_of_assigned_points = 100;
  s.number_of_ignored_coordinates = 50;
  s.free_points.clutter = 850;
  if(zeros != nullptr) {
    s.*zeros = 600;
    s.free_points.clutter = 250;
  }
  CHECK(program::share_in_shapes(s, {{5, 5, 5, 9, 9, 9}, 600}) == share);
  CHECK(program::share_in_shapes(s, {{5, 5, 5, 9, 9, 9}, 0}) == 100. / double(100 + s.free_points.clutter));
  const std::string text = program::why_poor(s), expected = zeros != nullptr ? "25 %" : "85 %";
  CHECK_AT(text.find("only 10 % of the points are in shapes, and " + expected + " are in clutter: ") == 0, text);
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  check_share(nullptr, 100. / 350);
  check_share(&CGAL::Tandem::Statistics::number_of_far_points, 100. / 350);
  check_share(&CGAL::Tandem::Statistics::number_of_ignored_normals, 100. / 350);
  check_share(&CGAL::Tandem::Statistics::number_of_ignored_tolerances, 100. / 350);
  const double infinity = std::numeric_limits<double>::infinity();
  const auto check = [&](const auto& measure, double alone) {
    CHECK(program::smallest_noise(measure, Two_ranks(infinity)) == alone);
    CHECK(program::smallest_noise(measure, Two_ranks(.25)) == .25);
  };
  check([] { return .5; }, .5);
  check([]() -> double { throw std::bad_alloc(); }, infinity); // it goes on, and takes part in what all ranks do
  check([] { return 0.; }, infinity);                          // all points are one
}

BOOST_AUTO_TEST_SUITE_END()
