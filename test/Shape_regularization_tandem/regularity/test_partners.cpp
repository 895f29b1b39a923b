// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Right angles among many directions, stars, and partners among fixed directions: the same as by comparing all with
// all, bit by bit, with far fewer comparisons.

#include "testing/direction_families.h"

#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>

#include <algorithm>
#include <cmath>
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

BOOST_AUTO_TEST_CASE(stars)
{
  std::size_t followers = 0;
  for_each_family(400, 10, [&](const std::string& name, Random& random, const Directions& d) {
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
  check(followers > 5000, "followers in all", double(followers));
}

// Stars of 1 to 8 groups, fixed in turn in both ways: fixed directions are looked at one by one, or searched. No group
// pays more than the price for its partners, and followers stay orthogonal to their master. What equals an earlier
// direction becomes that one.
class Fixed_pair {
public:
  explicit Fixed_pair(const Regularity_parameters& options)
    : options_(options), searched_(options, 0), listed_(options, std::size_t(-1))
  {}

  // Returns the direction of the star.
  Vector fix_star(Direction_group star)
  {
    searched_.begin_star();
    listed_.begin_star();
    const Vector n = searched_.chained(star);
    CHECK_AT(is_same(n, listed_.chained(star)), "star");
    chained += !is_same(n, star.fitted);
    return fix(star, n, {0, 0, 0}, true);
  }

  void fix_follower(Direction_group group, const Vector& x)
  {
    Vector a = fit_orthogonal(group.matrix, x, group.fitted), b = a;
    const bool has_partner = searched_.chain(group, x, group.rounded, a);
    CHECK_AT(has_partner == listed_.chain(group, x, group.rounded, b) && is_same(a, b), "follower");
    chained += has_partner;
    fix(group, a, x, has_partner);
  }

  std::size_t chained = 0, merged = 0;

private:
  Vector fix(Direction_group& group, const Vector& n, const Vector& master, bool is_priced)
  {
    const double rounding = 1e-12 * group.eigen.value[2];
    check(!is_priced || group.cost(n) <= options_.price(group.largest) + rounding, "cost", group.cost(n));
    const Vector result = searched_.fix(group, n, master);
    CHECK_AT(is_same(listed_.fix(group, n, master), result) && are_orthogonal(result, master), "fixed");
    const auto is_equal = [&](const Vector& d) { return squared_sine(d, n) < 1e-18 && are_orthogonal(d, master); };
    const bool is_known = std::any_of(fixed_.begin(), fixed_.end(), is_equal);
    CHECK_AT(is_known ? std::count(fixed_.begin(), fixed_.end(), result) > 0 : is_same(result, canonical(n)), "equal");
    merged += is_known;
    fixed_.push_back(result);
    return result;
  }

  const Regularity_parameters& options_;
  Fixed_directions searched_, listed_;
  Directions fixed_;
};

BOOST_AUTO_TEST_CASE(partners)
{
  std::size_t chained = 0, merged = 0;
  for_each_family(300, 12, [&](const std::string&, Random& random, const Directions& d) {
    Regularity_parameters options;
    options.maximum_distance_steps = 1;
    options.freedom.per_point = 1 + 100 * random.uniform();
    Fixed_pair fixed(options);
    const bool is_small = random.below(2) == 0;
    for(std::size_t i = 0; i < d.size();) {
      const Vector x = fixed.fix_star(make_group(random, d[i++], is_small));
      for(int follower = random.below(8); follower > 0 && i < d.size(); --follower)
        fixed.fix_follower(make_group(random, made_orthogonal(d[i++], x), is_small), x);
    }
    chained += fixed.chained;
    merged += fixed.merged;
  });
  check(chained > 500, "chained directions in all", double(chained));
  check(merged > 100, "directions that became one, in all", double(merged));
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
      index.search(Right_angle_region(d), [&](int) { ++count; });
      index.add(d, 0);
    }
    const double per_root = double(count) / (n * std::sqrt(double(n)));
    check(family == "lattice" || per_root <= 40, "directions of " + family, per_root, 40);
  }
}

BOOST_AUTO_TEST_SUITE_END()
