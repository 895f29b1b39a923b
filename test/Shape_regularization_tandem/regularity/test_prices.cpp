// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relations by price: shapes are related exactly where that is worth more than what their points lose, and none loses
// more than its relations are worth.

#include "testing/plates.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

BOOST_AUTO_TEST_SUITE(test_prices)

using namespace CGAL::Tandem::internal;

namespace {

// Two plates, of which the second is turned about an axis in it, and lies at an offset: what it costs is known.
BOOST_AUTO_TEST_CASE(test_two_shapes)
{
  for(double degrees : {.5, 2., 7.}) {
    const Rectangle first{polar(0, 90), {0, 0, 0}};
    Rectangle second{polar(0, 90 - degrees), {200 * epsilon, 0, 0}};
    second.count = 500;
    const Shape_fits shapes = make_shapes({first, second});
    const double price = loss(shapes[1], {0, 0, 1}) / (2 * epsilon * epsilon);
    for(double share : {.999, 1.001}) {
      const Relations r = run(shapes, all_on(share * price));
      check_equal(r.directions.size(), share > 1 ? 1u : 2u, "directions at " + std::to_string(share) + " of the price");
      check_equal(int(r.is_rolled_back[0]) + r.is_rolled_back[1], share > 1 ? 0 : 2, "shapes with a direction nearby");
    }
  }
  for(double offset : {.1, .5, .9, 1.1}) {
    const Shape_fits shapes =
      make_shapes({{{0, 0, 1}, {0, 0, 0}}, {{0, 0, 1}, {90 * epsilon, 0, offset * epsilon}, 5000, 5000, 200, 500}});
    const double price = 400 * offset * offset; // 2000 * 500 / 2500
    for(double share : {.999, 1.26}) {          // the smaller one is moved by 4/5 of the offset
      const Relations r = run(shapes, all_on(share * price));
      check_equal(r.planes.size(), share > 1 && offset < 1 ? 1u : 2u, "planes at " + std::to_string(offset));
    }
  }
}

// A plate and one that is turned from the right angle to it.
BOOST_AUTO_TEST_CASE(test_right_angle)
{
  for(double degrees : {.5, 2., 7.}) {
    const Shape_fits shapes =
      make_shapes({{{0, 0, 1}, {0, 0, 0}}, {polar(0, degrees), {200 * epsilon, 0, 0}, 9000, 9000, 200, 500}});
    const double price = cost_of_right_angle(eigen_system(shapes[1].scatter.matrix), {0, 0, 1}) / (epsilon * epsilon);
    for(double share : {.9, 1.1}) {
      const Relations r = run(shapes, all_on(share * price));
      check_equal(orthogonal_pairs(r.directions).size(), share > 1 ? 1u : 0u, "right angles");
      for(std::size_t i = 0; i < 2; ++i)
        CHECK_AT(loss(shapes[i], r.directions[i]) <= share * price * epsilon * epsilon, "the loss of a right angle");
    }
  }
}

// No group loses more than the price of a degree of freedom by right angles, and no shape more than that of a direction
// by all. Nor is one turned by more than the tolerance. Pairs that are nearly orthogonal are so, or not worth it.
BOOST_AUTO_TEST_CASE(test_losses)
{
  std::size_t released = 0, right_angles = 0;
  for(int seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const Shape_fits shapes = random_plates(random, 200, 1 + random.below(20), 4 * random.uniform());
    Regularity_options o = all_on(std::exp(8 * random.uniform()));
    o.freedom.per_point = .01;
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
    for(std::size_t i = 0; i < shapes.size(); ++i) {
      const Vector& n = r.directions[std::size_t(r.direction_of[i])];
      const double most = o.direction_price(shapes[i].scatter.count);
      check(loss(shapes[i], n) <= most, "loss of a shape", loss(shapes[i], n), most);
      CHECK_AT(squared_sine(n, canonical(shapes[i].fit.normal)) <= sine * sine, "turn of a shape");
    }
    for(const auto& [a, b] : orthogonal_pairs(r.directions)) {
      const double d = std::fabs(dot(r.directions[std::size_t(a)], r.directions[std::size_t(b)]));
      check(d <= 5e-16, "dot product of orthogonal directions", d, 5e-16);
      ++right_angles;
    }
  }
  std::printf("%zu shapes released of 60000, %zu right angles\n", released, right_angles);
  check(released > 0 && right_angles > 1000, "shapes that left their groups", double(released), double(right_angles));
}

// The order of shapes of different sizes does not matter.
BOOST_AUTO_TEST_CASE(test_order)
{
  for(int seed = 0; seed < 50; ++seed) {
    Random random(seed);
    Shape_fits shapes = random_plates(random, 200, 1 + random.below(20), 2 * random.uniform());
    for(std::size_t i = 0; i < shapes.size(); ++i)
      shapes[i].scatter.count += .001 * double(i);
    const Regularity_options o = all_on(std::exp(6 * random.uniform()));
    const Relations r = run(shapes, o);
    std::vector<int> order = all_of(shapes);
    std::shuffle(order.begin(), order.end(), random.engine);
    Shape_fits shuffled;
    for(int i : order)
      shuffled.push_back(shapes[std::size_t(i)]);
    const Relations s = run(shuffled, o);
    std::set<std::pair<int, int>> directions, planes;
    for(std::size_t k = 0; k < order.size(); ++k) {
      directions.insert({s.direction_of[k], r.direction_of[std::size_t(order[k])]});
      planes.insert({s.plane_of[k], r.plane_of[std::size_t(order[k])]});
    }
    CHECK_AT(r.directions.size() == directions.size() && s.directions.size() == directions.size(),
             "parallel groups of a permutation, seed " + std::to_string(seed));
    CHECK_AT(r.planes.size() == planes.size() && s.planes.size() == planes.size(),
             "coplanar groups of a permutation, seed " + std::to_string(seed));
  }
}

} // namespace

BOOST_AUTO_TEST_SUITE_END()
