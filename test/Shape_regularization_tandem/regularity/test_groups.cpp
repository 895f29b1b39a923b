// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coplanar groups are the same as by a look at all pairs, in the definition. Shapes are related where that is worth
// more than what it costs their points, and none pays more than its relations are worth. True relations are found, no
// others are made up, and the order of the shapes does not matter.

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

// With a price that grows with the points.
Regularity_parameters random_options(Random& random)
{
  Regularity_parameters o = all_on(std::exp(8 * random.uniform()));
  o.freedom.per_point = .01;
  return o;
}

// The order of the shapes changes no bit of their planes.
BOOST_AUTO_TEST_CASE(permutations)
{
  for(int seed = 0; seed < 40; ++seed) {
    Random random(seed);
    Shape_fits shapes = random_plates(random, 100, 1 + random.below(12), 4 * random.uniform());
    for(std::size_t i = 0; i < shapes.size(); ++i) // all different: equal ones are in the order of the input
      shapes[i].scatter.count += double(i) / 128;
    Regularity_parameters o = random_options(random);
    if(seed % 4 == 0)
      o.fixed_directions = o.symmetry_axis = {{0, 0, 1}};
    std::vector<int> place = all_of(shapes);
    std::shuffle(place.begin(), place.end(), random.engine);
    Shape_fits permuted;
    for(int i : place)
      permuted.push_back(shapes[std::size_t(i)]);
    const Relations r = run(shapes, o), s = run(permuted, o);
    for(std::size_t k = 0; k < place.size(); ++k) {
      const Regular_plane &a = r.planes[std::size_t(r.plane_of[std::size_t(place[k])])],
                          &b = s.planes[std::size_t(s.plane_of[k])];
      CHECK_AT(is_same(a.normal, b.normal) && a.offset == b.offset, "seed " + std::to_string(seed));
    }
  }
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
      plane.push_back(plane_through({0, 0, 1}, shapes.back().scatter.centroid));
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
    groups.push_back(given_direction_group(d));
  groups[7].members = {2};
  groups[30].members = {0, 3};
  groups.push_back(single_group(1));
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
    const double price = Stiffness(eigen_system(shapes[1].scatter.matrix)).cost({0, 0, 1}) / (epsilon * epsilon);
    for(double factor : {.9, 1.1}) {
      const Relations r = run(shapes, all_on(factor * price));
      check_equal(orthogonal_pairs(r.directions).size(), factor > 1 ? 1u : 0u, "right angles");
      for(std::size_t i = 0; i < 2; ++i)
        CHECK_AT(loss(shapes[i], r.directions[i]) <= factor * price * epsilon * epsilon, "the loss of a right angle");
    }
  }
}

// No group pays more for right angles than they are worth, and no shape more than a direction is worth. Nor is one
// turned by more than the tolerance. Those that keep their own direction beside another one are known.
BOOST_AUTO_TEST_CASE(losses)
{
  std::size_t released = 0, right_angles = 0;
  for(int seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const Shape_fits shapes = random_plates(random, 200, 1 + random.below(20), 4 * random.uniform());
    Regularity_parameters o = random_options(random);
    if(seed % 4 == 0)
      o.fixed_directions = o.symmetry_axis = {{0, 0, 1}};
    std::vector<Direction_group> groups = Greedy_directions(shapes, o)(all_of(shapes));
    for(const Direction_group& g : groups) {
      double worth = g.partners[0] < 0 ? o.price(g.largest) : 0;
      for(int p : g.partners)
        worth += p < 0
                   ? 0
                   : o.price(groups[std::size_t(p)].is_given ? g.largest
                                                             : (std::min)(g.largest, groups[std::size_t(p)].largest));
      CHECK_AT(g.is_given || g.cost(g.direction) <= worth * (1 + 1e-6), "loss of a group");
      for(int p : g.partners)
        CHECK_AT(p < 0 || are_orthogonal(g.direction, groups[std::size_t(p)].direction), "a right angle");
    }
    for(const Vector& axis : o.symmetry_axis)
      Axis_symmetry(groups, axis, o).make_symmetric();
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

// A vertical, blocks of walls and roofs about it, and directions of no relation: none is nearer than 3 degrees to a
// relation that is not true.
Directions true_directions(Random& random)
{
  const Vector z = random.direction();
  Directions d = {z};
  const auto is_apart = [&](const Vector& n) {
    return std::all_of(d.begin(), d.end(), [&](const Vector& other) {
      const double cosine = std::fabs(dot(n, other));
      return cosine < cosine_deg(3) && (cosine < 1e-12 || cosine > sine_deg(3));
    });
  };
  for(int block = 1 + random.below(4); block > 0; --block) {
    const Vector x = made_orthogonal(random.direction(), z), y = orthogonal_to_both(z, x);
    const double slope = 20 + 30 * random.uniform();
    const Vector left = unit(add_scaled(cosine_deg(slope) * z, sine_deg(slope), x)),
                 right = unit(add_scaled(cosine_deg(slope) * z, -sine_deg(slope), x));
    if(std::fabs(slope - 45) > 3 && is_apart(x) && is_apart(y) && is_apart(left) && is_apart(right))
      d.insert(d.end(), {x, y, left, right});
  }
  for(int other = random.below(6); other > 0; --other)
    if(const Vector n = random.direction(); is_apart(n))
      d.push_back(n);
  return d;
}

BOOST_AUTO_TEST_CASE(true_relations)
{
  int parallel = 0, orthogonal = 0, missed_parallel = 0, missed_orthogonal = 0, made_up = 0;
  double error = 0, points = 0;
  for(int seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Directions d = true_directions(random);
    Shape_fits shapes;
    std::vector<std::size_t> of;
    for(std::size_t k = 0; k < d.size(); ++k)
      for(int i = 1 + random.below(4); i > 0; --i) {
        const double count = std::exp(8 + 2 * random.uniform()),
                     width = std::sqrt(count) * epsilon * (.25 + .2 * random.uniform());
        const Vector n = unit(add_scaled(d[k], .001, random.vector()));
        shapes.push_back(make_shape({n, 200 * epsilon * random.vector(), width, width * (.5 + .5 * random.uniform()),
                                     epsilon * (.05 + .3 * random.uniform()), count}));
        of.push_back(k);
      }
    Regularity_parameters o = all_on(15);
    o.freedom.per_point = .01;
    const Relations r = run(shapes, o);
    for(std::size_t i = 0; i < shapes.size(); ++i) {
      const Vector& n = r.directions[std::size_t(r.direction_of[i])];
      error += shapes[i].scatter.count * std::sqrt(squared_sine(n, d[of[i]])) / sine_deg(1);
      points += shapes[i].scatter.count;
      for(std::size_t j = 0; j < i; ++j) {
        const bool is_parallel = of[i] == of[j], is_orthogonal = std::fabs(dot(d[of[i]], d[of[j]])) < 1e-12;
        const bool are_parallel = r.direction_of[i] == r.direction_of[j];
        const bool are_right = are_orthogonal(n, r.directions[std::size_t(r.direction_of[j])]);
        parallel += is_parallel;
        orthogonal += is_orthogonal;
        missed_parallel += is_parallel && !are_parallel;
        missed_orthogonal += is_orthogonal && !are_right;
        made_up += (are_parallel && !is_parallel) + (are_right && !is_orthogonal);
      }
    }
  }
  check_equal(made_up, 0, "relations that are not true");
  check(missed_parallel * 100 < parallel, "parallel pairs missed, of", missed_parallel, parallel);
  check(missed_orthogonal * 100 < orthogonal, "orthogonal pairs missed, of", missed_orthogonal, orthogonal);
  check(error < .05 * points, "mean error of the directions, in degrees", error / points);
}

BOOST_AUTO_TEST_SUITE_END()
