// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Right angles among many directions, and queries of the Gauss map: the same pairs, stars and neighbors as by comparing
// all with all, bit by bit.

#include "testing/direction_families.h"

#include <CGAL/Tandem/internal/regularity/orthogonal_pairs.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_great_circles)

using namespace CGAL::Tandem::internal;

namespace {

BOOST_AUTO_TEST_CASE(test_pairs)
{
  std::size_t all = 0;
  for_each_family(400, 20, [&](const std::string& name, Random&, const Directions& d) {
    std::vector<std::pair<int, int>> expected;
    for(std::size_t i = 0; i < d.size(); ++i)
      for(std::size_t j = i + 1; j < d.size(); ++j)
        if(dot(d[i], d[i]) > 0 && dot(d[j], d[j]) > 0 && are_orthogonal(d[i], d[j]))
          expected.push_back({int(i), int(j)});
    CHECK_AT(orthogonal_pairs(d) == expected, name);
    all += expected.size();
  });
  check(all > 100000, "orthogonal pairs in all", double(all));
}

// Sines and reaches with ties: some equal the dot product of two candidates.
std::vector<Star_candidate> make_candidates(Random& random, const Directions& directions)
{
  std::vector<Star_candidate> candidates;
  const double sines[3] = {random.uniform() * .3, random.uniform() * .01, random.below(2) * 1e-9};
  for(const Vector& d : directions)
    if(dot(d, d) > 0)
      candidates.push_back({rounded_normal(canonical(d)), sines[random.below(3)], 0, int(candidates.size())});
  for(Star_candidate& c : candidates) {
    const Star_candidate& other = candidates[std::size_t(random.below(int(candidates.size())))];
    const double product = std::fabs(rounded_dot(c.rounded, other.rounded));
    if(random.below(3) == 0 && product < .7)
      c.sine = product;
    c.reach = random.below(3) == 0 ? (std::min)(c.sine, product) : c.sine * random.uniform();
  }
  return candidates;
}

BOOST_AUTO_TEST_CASE(test_stars)
{
  std::size_t followers = 0;
  for_each_family(400, 20, [&](const std::string& name, Random& random, const Directions& d) {
    const std::vector<Star_candidate> candidates = make_candidates(random, d);
    std::vector<Star> expected;
    for(std::vector<Star_candidate> rest = candidates, left; !rest.empty(); rest.swap(left)) {
      expected.push_back({rest.front().group, {}});
      left.clear();
      for(std::size_t k = 1; k < rest.size(); ++k)
        if(can_follow(rest.front(), rest[k]))
          expected.back().followers.push_back(rest[k].group);
        else
          left.push_back(rest[k]);
    }
    const std::vector<Star> stars = find_stars(candidates, can_follow);
    check_equal(stars.size(), expected.size(), name + ": stars");
    for(std::size_t s = 0; s < stars.size() && s < expected.size(); ++s) {
      CHECK_AT(stars[s].master == expected[s].master && stars[s].followers == expected[s].followers, name);
      followers += stars[s].followers.size();
    }
  });
  check(followers > 10000, "followers in all", double(followers));
}

// All directions within an angle, whatever their signs, also where they lie on another face of the cube.
BOOST_AUTO_TEST_CASE(test_near_directions)
{
  std::size_t within = 0;
  for_each_family(200, 2, [&](const std::string& name, Random& random, Directions d) {
    for(const Vector& axis : {Vector{1, 0, 0}, Vector{0, -1, 0}, Vector{0, 0, 1}, unit({1, 1e-9, 0}), unit({1, 1, 0})})
      d.push_back(axis);
    Great_circle_index index;
    for(const Vector& v : d)
      index.add(v, 0);
    for(double sine : {1e-9, .01, .14, .2, .21, .5, .7})
      for(int q = 0; q < 60; ++q) {
        const Vector query = q % 2 == 0 ? d[std::size_t(random.below(int(d.size())))] : random.direction();
        std::vector<int> found, expected;
        index.search(Near_direction_region(query, sine), [&](int i) {
          const Vector& v = d[std::size_t(i)];
          if(dot(v, v) > 0 && squared_sine(query, v) <= sine * sine) // the lattice has the null vector
            found.push_back(i);
        });
        for(std::size_t i = 0; i < d.size(); ++i)
          if(dot(d[i], d[i]) > 0 && squared_sine(query, d[i]) <= sine * sine)
            expected.push_back(int(i));
        std::sort(found.begin(), found.end());
        CHECK_AT(found == expected, name + ": directions within " + std::to_string(sine));
        within += found.size();
      }
  });
  check(within > 10000, "directions that are found", double(within));
}

} // namespace

BOOST_AUTO_TEST_SUITE_END()
