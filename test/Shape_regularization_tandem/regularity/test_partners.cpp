// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Partners at right angles among fixed directions: the same as by a look at all of them, bit by bit.

#include "testing/direction_families.h"
#include "testing/same_bits.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_partners)

using namespace CGAL::Tandem::internal;

namespace {

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

// Stars of 1 to 8 groups, fixed in turn in both ways. few: so many are looked at one by one, more are searched.
void test_partners(std::size_t few)
{
  std::size_t chained = 0, merged = 0;
  for_each_family(300, 12, [&](const std::string& name, Random& random, const Directions& d) {
    const double squared_rms = 1 + 100 * random.uniform();
    Regularity_options options;
    options.maximum_distance = 1;
    options.freedom.per_point = squared_rms;
    Fixed_directions fixed(options, few);
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
  check(chained > 1000, "chained directions in all", double(chained));
  check(merged > 100, "directions that became one, in all", double(merged));
}

} // namespace

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_partners(0);
  test_partners(Fixed_directions::few_directions);
}

BOOST_AUTO_TEST_SUITE_END()
