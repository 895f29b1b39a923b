// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Right angles among many directions: the same pairs, stars and partners as by comparing all with all, bit by bit, and
// far fewer comparisons.

#undef NDEBUG

#include "testing/checks.h"

#include <CGAL/Tandem/internal/regularity/Frames.h>
#include <CGAL/Tandem/internal/regularity/orthogonal_pairs.h>

#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <string>

using namespace CGAL::Tandem::internal;

namespace {

struct Random {
  std::mt19937_64 engine;
  std::normal_distribution<double> gauss;

  explicit Random(int seed) : engine(std::uint64_t(seed)) {}
  int below(int n) { return int(engine() % std::uint64_t(n)); }
  double uniform() { return double(engine() >> 11) * 0x1p-53; }
  Vector vector() { return {gauss(engine), gauss(engine), gauss(engine)}; }
  Vector direction() { return unit(vector()); }
};

using Directions = std::vector<Vector>;

Directions random_directions(Random& random, int n)
{
  Directions d;
  for(int i = 0; i < n; ++i)
    d.push_back(random.direction());
  return d;
}

// Orthogonal triples, and directions orthogonal to one of them.
Directions frames(Random& random, int n)
{
  Directions d;
  while(int(d.size()) < n) {
    const Vector z = random.direction(), x = made_orthogonal(random.direction(), z), y = orthogonal_to_both(z, x);
    d.insert(d.end(), {x, -y, z, made_orthogonal(random.direction(), z)});
  }
  return d;
}

// Turned from right angles by about the bound, or by much less: both sides, and equal to it.
Directions near_the_bound(Random& random, int n)
{
  Directions d = frames(random, n);
  for(Vector& v : d)
    if(random.below(2) == 0)
      v = add_scaled(v, std::ldexp(1.0, -40 - random.below(15)), random.direction());
  return d;
}

// Directions of a lattice: many are equal, and many lie on edges and corners of the cube.
Directions lattice(Random& random, int n)
{
  Directions d;
  for(int i = 0; i < n; ++i)
    d.push_back(unit({random.below(7) - 3., random.below(7) - 3., random.below(7) - 3.}));
  return d;
}

// A cylinder, and its axis; the axis is that of a coordinate for every other seed.
Directions cylinder(Random& random, int n)
{
  const Vector axis = random.below(2) == 0 ? Vector{1, 0, 0} : random.direction();
  Directions d = {axis};
  for(int i = 1; i < n; ++i)
    d.push_back(made_orthogonal(random.direction(), axis));
  return d;
}

// Around a few directions, closer than the cells of any grid.
Directions clusters(Random& random, int n)
{
  const Directions centers = frames(random, 8);
  Directions d;
  for(int i = 0; i < n; ++i)
    d.push_back(
      unit(add_scaled(centers[std::size_t(i) % 8], std::ldexp(1.0, -20 - random.below(20)), random.vector())));
  return d;
}

const std::map<std::string, Directions (*)(Random&, int)> families = {
  {"random", random_directions}, {"frames", frames},     {"near the bound", near_the_bound},
  {"lattice", lattice},          {"cylinder", cylinder}, {"clusters", clusters}};

void for_each_family(int n, int seeds, const std::function<void(const std::string&, Random&, const Directions&)>& test)
{
  for(const auto& [name, make] : families)
    for(int seed = 0; seed < seeds; ++seed) {
      Random random(seed);
      test(name + " " + std::to_string(seed), random, make(random, n));
    }
}

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

bool can_follow(const Star_candidate& m, const Star_candidate& j)
{
  const double product = std::fabs(rounded_dot(m.rounded, j.rounded));
  return product < (std::min)(m.sine, j.sine) && product <= (std::max)(m.reach, j.reach);
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

// A plate with this normal, of some size and noise.
Direction_group make_group(Random& random, const Vector& normal, bool is_small)
{
  const Vector n = unit(normal), u = made_orthogonal(random.direction(), n), v = cross(n, u);
  const auto term = [](double s, const Vector& a) {
    return Symmetric_matrix{s * a.x * a.x, s * a.x * a.y, s * a.x * a.z, s * a.y * a.y, s * a.y * a.z, s * a.z * a.z};
  };
  const double width = is_small ? 10 : 10 + 1e4 * random.uniform() * random.uniform();
  Direction_group g = direction_group({0}, .14);
  g.weight = double(100 + random.below(3));
  g.matrix = term(g.weight * width * width, u) + term(g.weight * width * width * random.uniform(), v) +
             term(g.weight * random.uniform(), n);
  if(random.below(4) == 0)
    g.sine = .14 * random.uniform();
  g.fit();
  return g;
}

bool is_same(const Vector& a, const Vector& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

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
        if(d.x >= side - 1e-9 && d.x <= side + 1e-9 &&
           Direction_index::squared_distance(d, group.direction) < 1e-9 * 1e-9 && are_orthogonal(d, master)) {
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
    Fixed_directions fixed(squared_rms, few);
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
  Fixed_directions fixed(4);
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

void test_work()
{
  check_growth("cells and directions", 40, count_of_pairs);
  for(double sine : {1e-9, 1e-3, .14})
    check_growth("stars within " + std::to_string(sine), 10,
                 [&](const Directions& d) { return count_of_stars(d, sine, sine); });
  check_growth("stars that bear little", 10, [](const Directions& d) { return count_of_stars(d, .14, 1e-3); });
  check_growth("partners", 10, count_of_partners);
}

} // namespace

int main()
{
  test_pairs();
  test_stars();
  test_partners(0);
  test_partners(Fixed_directions::few_directions);
  test_queries();
  test_work();
  return report();
}
