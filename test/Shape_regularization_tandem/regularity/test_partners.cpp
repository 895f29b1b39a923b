// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Right angles among many directions, queries of the Gauss map, and partners among fixed directions: the same as by
// comparing all with all, bit by bit, with far fewer comparisons.

#include "testing/direction_families.h"
#include "testing/same_bits.h"

#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
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

// All directions within an angle, whatever their signs, also where they lie on another face of the cube.
BOOST_AUTO_TEST_CASE(near_directions)
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

// Fixed directions as they are defined: every decision looks at all of them, in their order.
struct All_fixed {
  struct Fixed {
    Vector direction, rounded;
    double sine, weight;
  };

  double squared_rms;
  std::size_t known = 0;
  std::vector<Fixed> fixed;

  template <class Score>
  std::size_t best_partner(const Vector& fit, double sine, Score score_of) const
  {
    std::size_t best = known;
    double maximum = 0;
    for(std::size_t i = 0; i < known; ++i) {
      if(!(std::fabs(rounded_dot(fixed[i].rounded, fit)) < (std::min)(fixed[i].sine, sine)))
        continue;
      const double value = std::sqrt(fixed[i].weight) * score_of(fixed[i].direction);
      if(value > maximum) {
        maximum = value;
        best = i;
      }
    }
    return best;
  }

  Vector chained(const Direction_group& star) const
  {
    const double allowed = squared_rms * star.weight;
    const std::size_t p = best_partner(star.rounded, star.sine, [&](const Vector& d) {
      return score_of_cost(cost_of_right_angle(star.eigen, d), allowed);
    });
    if(p == known)
      return star.fitted;
    const Vector n = fit_orthogonal(star.matrix, fixed[p].direction, star.fitted);
    if(star.cost(n) > allowed)
      return star.fitted;
    Vector both = n;
    return chain(star, fixed[p].direction, rounded_normal(n), both) ? both : n;
  }

  bool chain(const Direction_group& group, const Vector& p, const Vector& fit, Vector& result) const
  {
    const std::size_t q = best_partner(fit, group.sine, [&](const Vector& d) {
      const Vector c = cross(p, d);
      return dot(c, c) > .04 ? score_of_cost(group.cost(unit(c)), squared_rms * group.weight) : 0;
    });
    if(q < known)
      result = orthogonal_to_both(p, fixed[q].direction);
    return q < known;
  }

  Vector fix(Direction_group& group, const Vector& n, const Vector& master)
  {
    group.direction = canonical(n);
    std::vector<std::size_t> order(fixed.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return fixed[a].direction.x < fixed[b].direction.x; });
    for(double side : {group.direction.x, -group.direction.x})
      for(std::size_t i : order) {
        const Vector& d = fixed[i].direction;
        if(d.x >= side - 1e-9 && d.x <= side + 1e-9 && squared_sine(d, group.direction) < 1e-9 * 1e-9 &&
           are_orthogonal(d, master)) {
          fixed[i].weight += group.weight;
          return group.direction = d;
        }
      }
    fixed.push_back({group.direction, rounded_normal(group.direction), group.sine, group.weight});
    return group.direction;
  }
};

// Stars of 1 to 8 groups, fixed in turn in both ways. Few are looked at one by one, more are searched; or all are.
BOOST_AUTO_TEST_CASE(partners)
{
  std::size_t chained = 0, merged = 0;
  for_each_family(300, 12, [&](const std::string& name, Random& random, const Directions& d) {
    const double squared_rms = 1 + 100 * random.uniform();
    Regularity_options options;
    options.maximum_distance = 1;
    options.freedom.per_point = squared_rms;
    Fixed_directions fixed(options, random.below(2) == 0 ? 0 : Fixed_directions::few_directions);
    All_fixed all = {squared_rms, 0, {}};
    const bool is_small = random.below(2) == 0;
    for(std::size_t i = 0; i < d.size();) {
      fixed.begin_star();
      all.known = all.fixed.size();
      Direction_group master = make_group(random, d[i++], is_small);
      const Vector n = fixed.chained(master);
      CHECK_AT(is_same(n, all.chained(master)), name + ", star");
      chained += !is_same(n, master.fitted);
      const Vector x = fixed.fix(master, n, {0, 0, 0});
      CHECK_AT(is_same(x, all.fix(master, n, {0, 0, 0})), name + ", fixed star");
      for(int follower = random.below(8); follower > 0 && i < d.size(); --follower) {
        Direction_group g = make_group(random, made_orthogonal(d[i++], x), is_small);
        Vector a = fit_orthogonal(g.matrix, x, g.fitted), b = a;
        const bool is_chained = fixed.chain(g, x, g.rounded, a);
        CHECK_AT(is_chained == all.chain(g, x, g.rounded, b) && is_same(a, b), name + ", follower");
        chained += is_chained;
        const std::size_t before = all.fixed.size();
        const Vector expected = all.fix(g, a, x);
        CHECK_AT(is_same(fixed.fix(g, a, x), expected), name + ", fixed follower");
        merged += all.fixed.size() == before;
      }
    }
  });
  check(chained > 500, "chained directions in all", double(chained));
  check(merged > 100, "directions that became one, in all", double(merged));
}

// Counts the cells that are looked at.
template <class Region>
struct Counted {
  const Region& region;
  std::size_t& count;

  bool meets(const Direction_cell& cell, double largest) const
  {
    ++count;
    return region.meets(cell, largest);
  }

  int nearest_quarter(const Direction_cell& cell) const { return region.nearest_quarter(cell); }
};

// The cells and directions that are looked at when each direction looks for right angles.
std::size_t count_of_pairs(const Directions& directions)
{
  Great_circle_index index;
  std::size_t count = 0;
  for(const Vector& d : directions) {
    const Right_angle_region region(d);
    index.search(Counted<Right_angle_region>{region, count}, [&](int) { ++count; });
    index.add(d, 0);
  }
  return count;
}

// Comparisons for the stars of directions, of which each one can bear an angle.
std::size_t count_of_stars(const Directions& directions, double sine, double reach)
{
  std::vector<Star_candidate> candidates;
  for(const Vector& d : directions)
    candidates.push_back({rounded_normal(canonical(d)), sine, reach, int(candidates.size())});
  std::size_t count = 0;
  find_stars(candidates, [&](const Star_candidate& m, const Star_candidate& j) {
    ++count;
    return can_follow(m, j);
  });
  return count;
}

// Costs that are evaluated when each group looks for a partner among all of them.
std::size_t count_of_partners(const Directions& directions)
{
  Random random(1);
  std::vector<Direction_group> groups;
  Regularity_options options;
  options.maximum_distance = 1;
  options.freedom.per_point = 4;
  Fixed_directions fixed(options);
  for(const Vector& d : directions) {
    groups.push_back(make_group(random, d, true));
    fixed.fix(groups.back(), groups.back().fitted, {0, 0, 0});
  }
  fixed.begin_star();
  std::size_t count = 0;
  for(const Direction_group& g : groups)
    fixed.best_partner(g, g.rounded, Partner_region(g, g.rounded, least_cost(g), 4 * g.weight), [&](const Vector& d) {
      ++count;
      return score_of_cost(cost_of_right_angle(g.eigen, d), 4 * g.weight);
    });
  return count;
}

// Cells and directions that are looked at when groups, in their order, look for one that they can join: those that find
// none may be joined.
std::size_t count_of_unions(const Directions& directions)
{
  Random random(1);
  Directions leaders;
  Great_circle_index index;
  std::size_t count = 0;
  for(const Vector& d : directions) {
    const Direction_group g = make_group(random, d, false);
    const double price = 40 + .02 * g.weight;
    const Near_direction_region region(g.fitted, (std::min)(g.sine, g.bearable_sine(price)));
    bool joins = false;
    index.search(Counted<Near_direction_region>{region, count}, [&](int k) {
      ++count;
      joins = joins || g.cost(leaders[std::size_t(k)]) <= price;
    });
    if(joins)
      continue;
    leaders.push_back(g.fitted);
    index.add(g.fitted, 0);
  }
  return count;
}

// The work for n directions is less than so many times n^1.5, and four times as many take no more than 8 times that,
// within a tenth.
void check_growth(const std::string& name, double most, const std::function<std::size_t(const Directions&)>& count)
{
  constexpr std::size_t n = 8000;
  for(const auto& [family, make] : families) {
    if(family == "lattice") // most are equal: the pairs themselves are quadratic
      continue;
    Random random(3);
    const Directions directions = make(random, n);
    const double large = double(count(directions)), per_root = large / (n * std::sqrt(double(n)));
    const double small = double(count(Directions(directions.begin(), directions.begin() + n / 4)));
    check(per_root <= most, name + " of " + family, per_root, most);
    check(large <= 8.8 * (small + n), name + " of " + family + ", growth", large / small, 8);
  }
}

BOOST_AUTO_TEST_CASE(work)
{
  check_growth("cells and directions", 40, count_of_pairs);
  check_growth("stars", 10, [](const Directions& d) { return count_of_stars(d, .14, .14); });
  check_growth("stars that bear little", 10, [](const Directions& d) { return count_of_stars(d, .14, 1e-3); });
  check_growth("partners", 10, count_of_partners);
  check_growth("unions", 10, count_of_unions);
}

BOOST_AUTO_TEST_SUITE_END()
