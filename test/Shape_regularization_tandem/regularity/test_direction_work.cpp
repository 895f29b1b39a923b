// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions and right angles of many directions take far fewer comparisons than all pairs.

#include "testing/direction_families.h"

#include <CGAL/Tandem/internal/regularity/orthogonal_pairs.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_direction_work)

using namespace CGAL::Tandem::internal;

namespace {

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

// Cells and directions that are looked at when each direction looks for right angles.
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
  for(const auto& [family, make] : families) {
    if(family == "lattice") // most are equal: the pairs themselves are quadratic
      continue;
    Random random(3);
    const Directions directions = make(random, 16000);
    const double n = 16000, large = double(count(directions));
    const double small = double(count(Directions(directions.begin(), directions.begin() + 4000)));
    std::cout << name << ", " << family << ": " << large / n << " for each of 16000, " << 4 * small / n << " of 4000\n";
    check(large <= most * n * std::sqrt(n), name + " of " + family, large / (n * std::sqrt(n)), most);
    check(large <= 8.8 * (small + n), name + " of " + family + ", growth", large / small, 8);
  }
}

BOOST_AUTO_TEST_CASE(test_work)
{
  check_growth("cells and directions", 40, count_of_pairs);
  for(double sine : {1e-9, 1e-3, .14})
    check_growth("stars within " + std::to_string(sine), 10,
                 [&](const Directions& d) { return count_of_stars(d, sine, sine); });
  check_growth("stars that bear little", 10, [](const Directions& d) { return count_of_stars(d, .14, 1e-3); });
  check_growth("partners", 10, count_of_partners);
  check_growth("unions", 10, count_of_unions);
}

} // namespace

BOOST_AUTO_TEST_SUITE_END()
