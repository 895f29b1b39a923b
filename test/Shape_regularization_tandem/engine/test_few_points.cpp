// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Few points on a tilted plane are a shape if as few are asked for, whatever the number of neighbors is.

#include "testing/test_support.h"

#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(test_few_points)

// Returns how many of some clouds of so many points are one shape.
int count_found(int n, const Parameters& parameters, Given given)
{
  const double length = std::sqrt(1 + .3 * .3);
  int found = 0;
  for(std::uint64_t seed = 1; seed <= 20; ++seed) {
    scenes::Random random(seed);
    Cloud cloud;
    for(int i = 0; i < n; ++i) {
      const double x = random.uniform(), y = random.uniform();
      add(cloud, {x, y, .3 * x}, {-.3 / length, 0, 1 / length});
    }
    const Shapes shapes = detect_valid(std::to_string(n) + " points", cloud, parameters, given);
    bool is_one = shapes.number_of_shapes() == 1;
    for(std::size_t i = 0; i < cloud.size(); ++i)
      is_one = is_one && shapes.shape_index(i) == 0;
    found += is_one;
  }
  return found;
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(std::size_t k : {6u, 12u})
    for(int n : {3, 4, 5, 6, 7, 8, 12, 20})
      for(Given given : {Given::normals, Given::nothing}) {
        Parameters parameters = make_parameters(.05, 3);
        parameters.k_neighbors = k;
        check_equal(count_found(n, parameters, given), 20,
                    "of 20 clouds of " + std::to_string(n) + " points with " + std::to_string(k) +
                      " neighbors, one shape");
      }
}

BOOST_AUTO_TEST_SUITE_END()
