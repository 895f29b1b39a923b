// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Right angles among many directions, and partners among those that are placed: the same as by comparing all with all,
// bit by bit, with far fewer comparisons.

#include "testing/direction_families.h"

#include <CGAL/Tandem/internal/regularity/Greedy_directions.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_partners)

using namespace CGAL::Tandem::internal;

BOOST_AUTO_TEST_CASE(pairs)
{
  std::size_t all = 0;
  for_each_family(400, 10, [&](const std::string& name, Random&, const Directions& d) {
    std::vector<std::pair<int, int>> expected;
    for(std::size_t i = 0; i < d.size(); ++i)
      for(std::size_t j = i + 1; j < d.size(); ++j)
        if(dot(d[i], d[i]) > 0 && dot(d[j], d[j]) > 0 && are_orthogonal(d[i], d[j]))
          expected.push_back({int(i), int(j)});
    CHECK_AT(orthogonal_pairs(d) == expected, name);
    all += expected.size();
  });
  check(all > 50000, "orthogonal pairs in all", double(all));
}

// The first directions of which the right angle may be worth its cost.
BOOST_AUTO_TEST_CASE(partners)
{
  std::size_t all = 0, full = 0;
  for_each_family(400, 10, [&](const std::string& name, Random& random, const Directions& d) {
    Great_circle_index index;
    std::vector<int> added;
    for(std::size_t i = 0; i < d.size(); ++i)
      if(dot(d[i], d[i]) > 0)
        added.push_back(int(i));
    for(int i : added)
      index.add(d[std::size_t(i)], Partner_region::value_of(i));
    for(std::size_t i = 0; i < d.size(); ++i) {
      const Direction_group group = make_group(random, random.below(2) == 0 ? d[i] : random.direction(), i % 2 == 0);
      const double sine = .3 * random.uniform(), price = std::exp(16 * random.uniform());
      const Stiffness stiffness(group.eigen);
      const auto is_partner = [&](int k) {
        const Vector& v = d[std::size_t(k)];
        return std::fabs(dot(v, group.fitted)) < sine && stiffness.cost(v) < price;
      };
      std::vector<int> expected;
      std::copy_if(added.begin(), added.end(), std::back_inserter(expected), is_partner);
      full += expected.size() > tuning::directions::partners;
      expected.resize((std::min)(expected.size(), tuning::directions::partners));
      Partner_region region(group, sine, price);
      index.search(region, [&](int number) {
        if(is_partner(added[std::size_t(number)]))
          region.add(added[std::size_t(number)]);
      });
      CHECK_AT(region.first() == expected, name);
      all += expected.size();
    }
  });
  check(all > 20000 && full > 1000, "partners, and lists that are full", double(all), double(full));
}

// Directions that are looked at when each of n looks for right angles are less than 40 n^1.5. Most of a lattice are
// equal: their pairs are quadratic.
BOOST_AUTO_TEST_CASE(work)
{
  constexpr int n = 8000;
  for(const auto& [family, make] : families) {
    Random random(3);
    Great_circle_index index;
    std::size_t count = 0;
    for(const Vector& d : make(random, n)) {
      index.search(Great_circle(d), [&](int) { ++count; });
      index.add(d, 0);
    }
    const double per_root = double(count) / (n * std::sqrt(double(n)));
    check(family == "lattice" || per_root <= 40, "directions of " + family, per_root, 40);
  }
}

BOOST_AUTO_TEST_SUITE_END()
