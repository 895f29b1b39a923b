// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Right angles among many directions, and queries of the Gauss map: the same pairs, stars and neighbors as by comparing
// all with all, bit by bit.

#undef NDEBUG

#include "testing/direction_families.h"

#include <CGAL/Tandem/internal/regularity/orthogonal_pairs.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Tandem::internal;

namespace {

void test_pairs()
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

void test_stars()
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

// Queries of the Gauss map: all normals within a chord, with their squared sines, each once. Those of smaller reach are
// a part of the others, in the same order.
void test_queries()
{
  using Found = std::vector<std::pair<std::size_t, double>>;
  std::size_t within = 0, largest = 0;
  for_each_family(200, 2, [&](const std::string& name, Random& random, Directions d) {
    for(const Vector& axis : {Vector{1, 0, 0}, Vector{0, -1, 0}, Vector{0, 0, 1}, unit({1, 1e-9, 0}), unit({1, 1, 0})})
      d.push_back(axis);
    for(double sine : {1e-9, .01, .14, .5, .7, 1.}) {
      const Direction_index index(d, sine);
      for(int q = 0; q < 40; ++q) {
        const Vector query = q % 2 == 0 ? d[std::size_t(random.below(int(d.size())))] : random.direction();
        const auto near = [&](double chord) {
          Found found;
          index.near(query, chord, [&](std::size_t i, double q2) { found.push_back({i, q2}); });
          return found;
        };
        const double chord = Direction_index::chord_of(sine);
        const Found all = near(chord);
        Found expected, sorted = all, smaller, weighed, filtered;
        for(std::size_t i = 0; i < d.size(); ++i) {
          const Vector a = rounded_normal(canonical(query)), b = rounded_normal(canonical(d[i]));
          for(const Vector& n : {b, -b}) {
            const double q2 = rounded_dot(a - n, a - n);
            if(q2 <= chord * chord && (n == b || b.z <= chord))
              expected.push_back({i, q2 * (1 - .25 * q2)});
          }
        }
        std::sort(expected.begin(), expected.end());
        std::sort(sorted.begin(), sorted.end());
        CHECK_AT(sorted == expected, name + ": normals within " + std::to_string(sine));
        const double reach = Direction_index::reach_of(sine / 3);
        smaller = near(reach);
        for(const auto& f : all)
          if(f.second <= reach * reach * (1 - .25 * (reach * reach)))
            filtered.push_back(f);
        CHECK_AT(smaller == filtered, name + ": normals within a third of " + std::to_string(sine));
        index.weigh(
          query, [](double q2) { return q2; },
          [&](std::size_t i, double q2) {
            weighed.push_back({i, q2});
          });
        CHECK_AT(weighed == all, name + ": weights within " + std::to_string(sine));
        within += all.size();
        largest = (std::max)(largest, all.size());
      }
    }
  });
  check(within > 10000 && largest > 100, "normals that are found", double(within));
}

} // namespace

int main()
{
  test_pairs();
  test_stars();
  test_queries();
  return report();
}
