// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Levels of tolerances: never above the tolerance, nor far below it; their integer squares; and the tolerance of a test.

#include "testing/test_support.h"

#include <CGAL/Tandem/internal/base/types.h>

#include <cmath>

BOOST_AUTO_TEST_SUITE(test_levels)

using namespace CGAL::Tandem::internal;

void test_level(double tolerance, double epsilon)
{
  const std::string of = std::to_string(tolerance / epsilon) + " of " + std::to_string(epsilon);
  const std::uint8_t level = level_of(tolerance, epsilon);
  const double rounded = epsilon * level_factor(level);
  CHECK_AT(rounded <= tolerance, of);
  if(tolerance >= epsilon)
    check_equal(int(level), 0, of);
  else if(tolerance > epsilon * 1e-9)
    CHECK_AT(tolerance < rounded * std::exp2(.1251), of);
  // It is the smallest one.
  CHECK_AT(level == 0 || epsilon * level_factor(std::uint8_t(level - 1)) > tolerance, of);
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  scenes::Random random(5);
  for(int i = 0; i < 20000; ++i)
    test_level(std::exp2(40 * random.uniform() - 38), i % 3 == 0 ? 1 : std::exp2(30 * random.uniform() - 15));
  for(int octave = 0; octave < 32; ++octave)
    for(double factor : {1., std::nextafter(1., 0.), std::nextafter(1., 2.)})
      test_level(factor * std::ldexp(.3, -octave), .3);
  for(double tolerance : {1e-300, 1e-320, HUGE_VAL})
    test_level(tolerance, .01);
  check_equal(level_factor(no_level), 0., "below all levels");

  for(int level = 0; level < no_level; ++level) {
    const double factor = level_factor(std::uint8_t(level));
    CHECK_AT(std::fabs(factor - std::exp2(-level / 8.)) <= 1e-15 * factor, std::to_string(level));
    const double square = double(squared_level(std::uint8_t(level))) / double(squared_level_unit);
    CHECK_AT(square >= 1 / double(squared_level_unit) && std::fabs(square - factor * factor) < 2e-7,
             std::to_string(level));
  }

  const Tolerance most = {1000 << 20, 77, -3};
  check_equal(most.at(0).distance, most.distance, "of level 0");
  check_equal(most.at(8).distance + 3, (most.distance + 3) / 2, "of level 8");
  check_equal(most.at(no_level).distance, std::int64_t(1) - 3, "of no level");
  check_equal(most.at(8).squared_cosine, most.squared_cosine, "the angle of level 8");
}

BOOST_AUTO_TEST_SUITE_END()
