// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parallel and coplanar groups are the same as by a look at all pairs, in the definition. By their prices, shapes are
// related exactly where that is worth more than what it costs their points, and none pays more than its relations are
// worth.

#include "testing/direction_families.h"
#include "testing/rectangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_groups)

using namespace CGAL::Tandem::internal;

std::vector<int> all_of(const Shape_fits& shapes)
{
  std::vector<int> all(shapes.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// Plates of some sizes whose normals lie around some directions, within a multiple of the tolerance of 8 degrees.
Shape_fits random_plates(Random& random, int n, int centers, double spread)
{
  const Directions center = random_directions(random, centers);
  Shape_fits shapes;
  for(int i = 0; i < n; ++i) {
    const Vector normal =
      unit(add_scaled(center[std::size_t(i % centers)], spread * .14 * random.uniform(), random.direction()));
    const double size = std::exp(4 * random.uniform()) * epsilon;
    const Vector place = 100 * epsilon * random.vector();
    shapes.push_back(make_shape({normal, place, size, size * (.05 + random.uniform()), .3 * epsilon,
                                 double(100 + random.below(20) * random.below(100))}));
  }
  return shapes;
}

// The groups of the definition. In each step all groups look at all that are heavier, in the order of weight.
class Naive_groups {
public:
  Naive_groups(const Shape_fits& shapes, const Regularity_parameters& options)
    : shapes_(shapes), options_(options), sine_(sine_deg(options.angle_tolerance_deg))
  {
    for(const Vector& d : options.fixed_directions)
      groups.push_back(given_direction_group(d, sine_));
    for(int i : all_of(shapes))
      groups.push_back(direction_group({i}, sine_));
    for(std::size_t before = groups.size() + 1; groups.size() < before;) {
      before = groups.size();
      for(Direction_group& g : groups)
        g.fit(shapes);
      unite();
    }
  }

  std::vector<Direction_group> groups;

private:
  void unite()
  {
    std::vector<int> leaders;
    std::vector<Direction_group> united = groups;
    for(int k : by_weight(groups)) {
      const int leader = best_leader(groups[std::size_t(k)], leaders);
      if(leader < 0) {
        leaders.push_back(k);
        continue;
      }
      std::vector<int>&from = united[std::size_t(k)].members, &to = united[std::size_t(leader)].members;
      to.insert(to.end(), from.begin(), from.end());
      std::sort(to.begin(), to.end());
      from.clear();
    }
    drop_empty(united);
    groups = united;
  }

  int best_leader(const Direction_group& g, const std::vector<int>& leaders) const
  {
    double best = 0;
    int result = -1;
    for(int l : leaders) {
      const Direction_group& leader = groups[std::size_t(l)];
      const double largest = leader.is_given ? g.largest : (std::min)(g.largest, leader.largest);
      const double gain = 2 * options_.price(largest) - g.cost(leader.fitted);
      if(!g.is_given && squared_sine(g.fitted, leader.fitted) <= sine_ * sine_ && gain > best) {
        best = gain;
        result = l;
      }
    }
    return result;
  }

  const Shape_fits& shapes_;
  const Regularity_parameters& options_;
  double sine_;
};

// With a price that grows with the points.
Regularity_parameters random_options(Random& random)
{
  Regularity_parameters o = all_on(std::exp(8 * random.uniform()));
  o.freedom.per_point = .01;
  return o;
}

BOOST_AUTO_TEST_CASE(parallel_groups)
{
  std::size_t united = 0, joined_given = 0;
  for(int seed = 0; seed < 80; ++seed) {
    Random random(seed);
    const Shape_fits shapes = random_plates(random, 150, 1 + random.below(12), 4 * random.uniform());
    Regularity_parameters o = random_options(random);
    o.angle_tolerance_deg = std::vector<double>{8, 3, 20, 44}[std::size_t(seed % 4)];
    for(int i = seed % 3; i > 0; --i)
      o.fixed_directions.push_back(canonical(shapes[std::size_t(i)].fit.normal));
    const std::vector<Direction_group> groups = Parallel_groups(shapes, o)(all_of(shapes));
    const std::vector<Direction_group> expected = Naive_groups(shapes, o).groups;
    CHECK_AT(std::equal(groups.begin(), groups.end(), expected.begin(), expected.end(),
                        [](const auto& a, const auto& b) { return a.members == b.members; }),
             "groups " + std::to_string(seed));
    for(const Direction_group& g : groups) {
      united += g.members.size() > 1;
      joined_given += g.is_given ? g.members.size() : 0;
      const auto sum = [&](const Vector& n) {
        return std::accumulate(g.members.begin(), g.members.end(), 0., [&](double all, int i) {
          return all + quadratic_form(shapes[std::size_t(i)].scatter.matrix, n);
        });
      };
      for(double step : {1e-5, 1e-3, 1e-1})
        CHECK_AT(g.is_given || sum(unit(add_scaled(g.fitted, step, random.direction()))) >= sum(g.fitted) * (1 - 1e-9),
                 "a better fit");
    }
  }
  check(united > 400 && joined_given > 100, "groups, and shapes of given directions", double(united),
        double(joined_given));
}

struct Naive_plane {
  std::vector<int> members;
  double offset, weight, largest;
};

// The same of planes with normal z and these offsets.
std::vector<Naive_plane> naive_planes(const Shape_fits& shapes, const Regular_planes& plane,
                                      const Regularity_parameters& o)
{
  std::vector<Naive_plane> groups;
  for(int i : all_of(shapes)) {
    const double count = shapes[std::size_t(i)].scatter.count;
    groups.push_back({{i}, plane[std::size_t(i)].offset, count, count});
  }
  std::sort(groups.begin(), groups.end(),
            [](const Naive_plane& a, const Naive_plane& b) { return a.offset < b.offset; });
  const auto gain = [&](std::size_t g) { // of g and the one after
    if(g + 1 >= groups.size() || !(groups[g + 1].offset - groups[g].offset <= o.maximum_offset_steps))
      return 0.;
    const double a = groups[g].weight, b = groups[g + 1].weight, d = groups[g + 1].offset - groups[g].offset;
    return o.price((std::min)(groups[g].largest, groups[g + 1].largest)) - a * b / (a + b) * d * d;
  };
  for(std::vector<std::size_t> chosen = {0}; !chosen.empty();) {
    chosen.clear(); // all pairs of a step are independent
    for(std::size_t g = 0; g + 1 < groups.size(); ++g)
      if(gain(g) > 0 && (g == 0 || gain(g) > gain(g - 1)) && gain(g) >= gain(g + 1))
        chosen.push_back(g);
    for(std::size_t k = chosen.size(); k > 0; --k) {
      Naive_plane &a = groups[chosen[k - 1]], &b = groups[chosen[k - 1] + 1];
      a.offset = (a.offset * a.weight + b.offset * b.weight) / (a.weight + b.weight);
      a.weight += b.weight;
      a.largest = (std::max)(a.largest, b.largest);
      a.members.insert(a.members.end(), b.members.begin(), b.members.end());
      groups.erase(groups.begin() + std::ptrdiff_t(chosen[k - 1]) + 1);
    }
  }
  return groups;
}

// Shapes that are too far from the plane of their group, or for which it costs too much, keep their own.
BOOST_AUTO_TEST_CASE(coplanar_groups)
{
  std::size_t united = 0, released = 0;
  for(int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    Shape_fits shapes;
    Regular_planes plane;
    const double range = (1 + random.below(60)) * epsilon;
    for(int i = 0; i < 100; ++i) {
      const double z = range * random.uniform(), count = double(100 + random.below(20) * random.below(100));
      shapes.push_back(make_shape({{0, 0, 1}, {0, 0, z}, 9 * epsilon, 9 * epsilon, .2 * epsilon, count}));
      plane.push_back(through_centroid(shapes.back(), {0, 0, 1}));
    }
    const Regularity_parameters o = random_options(random);
    std::vector<int> group_of(shapes.size(), -1);
    Regular_planes moved = plane;
    Coplanar_groups(shapes, std::vector<int>(shapes.size(), 0), o).fit(moved, group_of);
    for(const Naive_plane& group : naive_planes(shapes, plane, o)) {
      std::vector<int> kept;
      for(int i : group.members) {
        const double count = shapes[std::size_t(i)].scatter.count, d = group.offset - plane[std::size_t(i)].offset;
        if(std::fabs(d) <= o.maximum_offset_steps && count * d * d <= o.price(count))
          kept.push_back(i);
      }
      const bool is_any = kept.size() > 1;
      for(int i : group.members) {
        const bool is_kept = is_any && std::count(kept.begin(), kept.end(), i) > 0;
        const double offset = is_kept ? group.offset : plane[std::size_t(i)].offset;
        check_close(moved[std::size_t(i)].offset, offset, 1e-9 * epsilon, "offset");
        CHECK_AT(is_kept ? group_of[std::size_t(i)] == group_of[std::size_t(kept[0])] : group_of[std::size_t(i)] < 0,
                 "group, seed " + std::to_string(seed));
      }
      CHECK_AT(!is_any || std::count(group_of.begin(), group_of.end(), group_of[std::size_t(kept[0])]) ==
                            std::ptrdiff_t(kept.size()),
               "others are in the group");
      united += is_any;
      released += is_any ? group.members.size() - kept.size() : 0;
    }
  }
  check(united > 300 && released > 0 && released < united / 10, "planes, and shapes released", double(united),
        double(released));
}

// More given directions than shapes, of which most have none: numbers are those of directions of shapes, below n.
BOOST_AUTO_TEST_CASE(numbers)
{
  Random random(3);
  std::vector<Direction_group> groups;
  for(const Vector& d : random_directions(random, 50))
    groups.push_back(given_direction_group(d, .1));
  groups[7].members = {2};
  groups[30].members = {0, 3};
  groups.push_back(direction_group({1}, .1));
  groups.back().direction = groups[7].direction;
  const std::vector<int> number = shared_directions(groups, 5);
  CHECK(number[0] == 1 - number[1] && number[1] >= 0 && number[1] <= 1);
  CHECK(number[2] == number[1] && number[3] == number[0] && number[4] == -1);
}

// A plate and one that is turned from the right angle to it.
BOOST_AUTO_TEST_CASE(right_angle)
{
  for(double degrees : {.5, 2., 7.}) {
    const Shape_fits shapes =
      make_shapes({{{0, 0, 1}, {0, 0, 0}}, {polar(0, degrees), {200 * epsilon, 0, 0}, 9000, 9000, 200, 500}});
    const double price = cost_of_right_angle(eigen_system(shapes[1].scatter.matrix), {0, 0, 1}) / (epsilon * epsilon);
    for(double factor : {.9, 1.1}) {
      const Relations r = run(shapes, all_on(factor * price));
      check_equal(orthogonal_pairs(r.directions).size(), factor > 1 ? 1u : 0u, "right angles");
      for(std::size_t i = 0; i < 2; ++i)
        CHECK_AT(loss(shapes[i], r.directions[i]) <= factor * price * epsilon * epsilon, "the loss of a right angle");
    }
  }
}

// No group pays more than the price of a degree of freedom by right angles, and no shape more than that of a direction
// by all. Nor is one turned by more than the tolerance. Those that keep their own direction beside another one are
// known.
BOOST_AUTO_TEST_CASE(losses)
{
  std::size_t released = 0, right_angles = 0;
  for(int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Shape_fits shapes = random_plates(random, 200, 1 + random.below(20), 4 * random.uniform());
    Regularity_parameters o = random_options(random);
    if(seed % 4 == 0)
      o.fixed_directions = o.symmetry_axis = {{0, 0, 1}};
    std::vector<Direction_group> groups = Parallel_groups(shapes, o)(all_of(shapes));
    set_directions(groups, o);
    for(const Direction_group& g : groups)
      CHECK_AT(g.is_given || g.cost(g.direction) <= o.price(g.largest) * (1 + 1e-6), "loss of a group");
    const std::size_t before = groups.size();
    release_shapes(shapes, o, groups);
    released += groups.size() - before;
    const Relations r = run(shapes, o);
    check_tables(r, shapes.size(), "losses");
    const double sine = sine_deg(o.angle_tolerance_deg);
    std::vector<char> is_rejected(shapes.size(), 0);
    for(const Direction_group& g : groups)
      if(g.members.size() == 1 && g.direction == g.fitted)
        is_rejected[std::size_t(g.members[0])] = std::any_of(groups.begin(), groups.end(), [&](const auto& other) {
          return !(other.direction == g.direction) && squared_sine(other.direction, g.direction) <= sine * sine;
        });
    CHECK_AT(std::equal(is_rejected.begin(), is_rejected.end(), r.is_rolled_back.begin()), "own directions");
    for(std::size_t i = 0; i < shapes.size(); ++i) {
      const Vector& n = r.directions[std::size_t(r.direction_of[i])];
      const double most = o.direction_price(shapes[i].scatter.count);
      check(loss(shapes[i], n) <= most, "loss of a shape", loss(shapes[i], n), most);
      CHECK_AT(squared_sine(n, canonical(shapes[i].fit.normal)) <= sine * sine, "turn of a shape");
    }
    right_angles += orthogonal_pairs(r.directions).size();
  }
  check(released > 0 && right_angles > 300, "shapes that left their groups", double(released), double(right_angles));
}

BOOST_AUTO_TEST_SUITE_END()
