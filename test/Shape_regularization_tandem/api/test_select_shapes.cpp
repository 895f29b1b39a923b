// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results with some of the shapes: valid, with the same planes, points and relations, and the shapes that the criteria say.
// And one shape for each plane.

#include "testing/measured_violation.h"
#include "testing/same_result.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

#include <numeric>

BOOST_AUTO_TEST_SUITE(test_select_shapes)

using CGAL::Tandem::join_coplanar_shapes;
using CGAL::Tandem::select_shapes;
using CGAL::Tandem::to_text;
using Indices = std::vector<std::size_t>;

const auto maps = CGAL::Tandem::parameters::point_map(First<Kernel>());

struct Case {
  std::string name;
  Cloud cloud;
  Shapes shapes;
  Given given;
};

Case make_case(const std::string& name, Given given)
{
  const scenes::Scene scene = make_scene(name, scene_options(20000, .0005, .1));
  Cloud cloud = to_cloud(scene);
  cloud.emplace_back(Kernel::Point_3(std::nan(""), 0, 0), Kernel::Vector_3(0, 0, 1));
  Parameters parameters = make_parameters(.002 * scene.diagonal, 50);
  parameters.fixed_directions = {{0, 0, 1}};
  parameters.regularize_axis_symmetry = true;
  return {name, cloud, detect_valid(name, cloud, parameters, given), given};
}

// The first, the last, every other, all the other way round, none.
std::vector<Indices> selections(std::size_t n)
{
  Indices every_other, reversed(n);
  for(std::size_t s = 1; s < n; s += 2)
    every_other.push_back(s);
  std::iota(reversed.rbegin(), reversed.rend(), 0);
  return {{0}, {n - 1}, every_other, reversed, {}};
}

void check_shapes(const Case& c, const Indices& indices, const Shapes& selected)
{
  const Shapes& all = c.shapes;
  check_equal(selected.number_of_shapes(), indices.size(), c.name + ": number of shapes");
  std::vector<std::int32_t> labels(all.number_of_points(), -1);
  for(std::size_t i = 0; i < indices.size(); ++i) {
    const std::size_t s = indices[i];
    CHECK(selected.coefficients(i) == all.coefficients(s) && selected.plane(i) == all.plane(s));
    CHECK(selected.is_flipped(i) == all.is_flipped(s) && selected.size(i) == all.size(s));
    CHECK(selected.uncertainty(i).noise == all.uncertainty(s).noise);
    for(std::size_t p : all.points(s))
      labels[p] = std::int32_t(i);
    for(std::size_t j = 0; j < indices.size(); ++j) {
      CHECK(selected.are_parallel(i, j) == all.are_parallel(s, indices[j]));
      CHECK(selected.are_coplanar(i, j) == all.are_coplanar(s, indices[j]));
      CHECK(selected.are_orthogonal(i, j) == all.are_orthogonal(s, indices[j]));
    }
    CHECK(selected.fixed_direction(selected.parallel_group(i)) == all.fixed_direction(all.parallel_group(s)));
  }
  CHECK(std::equal(labels.begin(), labels.end(), selected.shape_indices().begin()));
}

void check_selection(const Case& c, const Indices& indices)
{
  const Shapes selected = select_shapes(c.shapes, indices);
  check_shapes(c, indices, selected);
  check_valid(c.cloud, selected, c.name + ", " + std::to_string(indices.size()), c.given);
  std::size_t points = 0;
  for(std::size_t s : indices)
    points += c.shapes.size(s);
  const auto &now = selected.statistics(), &before = c.shapes.statistics();
  check_equal(now.number_of_assigned_points, points, c.name + ": points");
  check_equal(now.free_points.unselected, before.number_of_assigned_points - points, c.name + ": unselected");
  check_equal(now.free_points.clutter, before.free_points.clutter, c.name + ": clutter");
  check_equal(polygons(selected, c.cloud, maps).number_of_entries(), indices.size(), c.name + ": entries");
}

// What is selected of a selection is what is selected at once.
void check_twice(const Case& c)
{
  const Shapes twice = select_shapes(select_shapes(c.shapes, Indices{3, 1, 0}), std::vector<int>{2, 0});
  CHECK(shape_bits(twice) == shape_bits(select_shapes(c.shapes, Indices{0, 3})));
  Indices all(c.shapes.number_of_shapes());
  std::iota(all.begin(), all.end(), 0);
  CHECK(shape_bits(select_shapes(c.shapes, all)) == shape_bits(c.shapes));
  CHECK(select_shapes(c.shapes, all).hash() == c.shapes.hash());
}

void check_refusals(const Case& c)
{
  const int n = int(c.shapes.number_of_shapes());
  const auto refuse = [&](const std::vector<int>& indices, const std::string& what, const std::string& why) {
    check_throws<std::invalid_argument>([&] { select_shapes(c.shapes, indices); }, {what.c_str(), why.c_str()},
                                        __LINE__);
  };
  for(int wrong : {n, -1})
    refuse({0, wrong}, "no shape", std::to_string(wrong));
  refuse({n}, "no shape", std::to_string(n));
  refuse({1, 0, 1}, "Shape 1", "twice");
  Shapes::Data data = select_shapes(c.shapes, Indices{0}).data();
  --data.statistics.free_points.unselected;
  const std::string why = violation_of(c.cloud, Shapes(data), maps.normal_map(Second<Kernel>()));
  CHECK_AT(why.find("free_points") != std::string::npos, why);
}

// Of the shapes with is_kept(s), in their order.
template <class List, class Is_kept>
void check_criteria(const Case& c, const List& list, Is_kept is_kept, const std::string& what)
{
  Indices expected;
  for(std::size_t s = 0; s < c.shapes.number_of_shapes(); ++s)
    if(is_kept(s))
      expected.push_back(s);
  CHECK_AT(!expected.empty() && expected.size() < c.shapes.number_of_shapes(), what + ": " + to_text(expected.size()));
  CHECK_AT(shape_bits(select_shapes(c.shapes, c.cloud, list)) == shape_bits(select_shapes(c.shapes, expected)), what);
}

void check_all_criteria(const Case& c)
{
  const auto cosine = [&](std::size_t s) { return std::fabs(c.shapes.coefficients(s)[2]); };
  const auto sine_of = [](double degrees) { return std::sin(degrees * CGAL_PI / 180); };
  const Kernel::Vector_3 upward(0, 0, -7);
  const auto walls = maps.orthogonal_direction(upward);
  check_criteria(
    c, maps.near_direction(upward), [&](std::size_t s) { return cosine(s) >= sine_of(80); }, "level");
  check_criteria(
    c, walls, [&](std::size_t s) { return cosine(s) <= sine_of(10); }, "walls");
  check_criteria(
    c, walls.near_angle(40), [&](std::size_t s) { return cosine(s) <= sine_of(40); }, "nearly walls");
  const std::vector<CGAL::Tandem::Shape_facts> facts = CGAL::Tandem::shape_facts(c.shapes, c.cloud, maps);
  const double area = facts[2].area, length = facts[1].length;
  const auto is_large = [&](std::size_t s) { return facts[s].area >= area; };
  const auto is_long = [&](std::size_t s) { return facts[s].length >= length; };
  check_criteria(c, maps.minimum_area(area), is_large, "area");
  check_criteria(c, maps.minimum_extent(length), is_long, "extent");
  check_criteria(
    c, maps.minimum_extent(length).minimum_area(area), [&](std::size_t s) { return is_long(s) && is_large(s); },
    "both");
}

// The largest of those that fit the others; shapes are sorted by their size.
void check_largest(const Case& c)
{
  Shapes::Data data = c.shapes.data();
  std::swap(data.size[0], data.size[2]); // not true, but for the order
  data.size[3] = data.size[1];
  const Shapes turned(data);
  for(std::size_t n : {std::size_t(1), std::size_t(3), c.shapes.number_of_shapes() + 9}) {
    Indices order(c.shapes.number_of_shapes());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t s, std::size_t t) { return turned.size(s) > turned.size(t); });
    order.resize((std::min)(n, order.size()));
    std::sort(order.begin(), order.end());
    CHECK(shape_bits(select_shapes(turned, c.cloud, maps.largest(n))) == shape_bits(select_shapes(turned, order)));
  }
  const Kernel::Vector_3 upward(0, 0, 1);
  const Shapes walls = select_shapes(c.shapes, c.cloud, maps.orthogonal_direction(upward));
  CHECK(shape_bits(select_shapes(c.shapes, c.cloud, maps.orthogonal_direction(upward).largest(1))) ==
        shape_bits(select_shapes(walls, Indices{0})));
}

void check_wrong_criteria(const Case& c)
{
  using Refusal = std::invalid_argument;
  const auto refuse = [&](const auto& list, const char* name, const char* value) {
    check_throws<Refusal>([&] { select_shapes(c.shapes, c.cloud, list); }, {name, value}, __LINE__);
  };
  refuse(maps.largest(0), "largest", "0");
  refuse(maps.largest(-2), "largest", "-2");
  refuse(maps.minimum_area(-1.), "minimum_area", "-1");
  refuse(maps.minimum_extent(std::nan("")), "minimum_extent", "nan");
  refuse(maps.near_direction(Kernel::Vector_3(0, 0, 0)), "near_direction", "not null");
  refuse(maps.orthogonal_direction(Kernel::Vector_3(std::nan(""), 0, 0)), "orthogonal_direction", "nan");
  refuse(maps.near_direction(Kernel::Vector_3(0, 0, 1)).near_angle(91), "near_angle", "91");
  check_throws<Refusal>([&] { select_shapes(c.shapes, Cloud(), maps.minimum_area(1)); }, {"0 points"}, __LINE__);
}

// Of a shape, from its points and plane alone.
double noise_of(const Case& c, const Shapes& shapes, std::size_t s)
{
  const CGAL::Tandem::Coefficients& p = shapes.coefficients(s);
  double squares = 0;
  for(std::size_t i : shapes.points(s)) {
    const Kernel::Point_3& q = c.cloud[i].first;
    const double distance = p[0] * q.x() + p[1] * q.y() + p[2] * q.z() + p[3];
    squares += distance * distance;
  }
  return std::sqrt(squares / double(shapes.size(s) - 3));
}

void check_joined(const Case& c)
{
  const Shapes joined = join_coplanar_shapes(c.shapes, c.cloud, maps);
  const std::size_t planes = c.shapes.number_of_coplanar_groups();
  CHECK_AT(planes < c.shapes.number_of_shapes(), c.name);
  check_counts(c.name, joined, planes, c.shapes.number_of_parallel_groups(), planes);
  CHECK(joined.orthogonal_groups() == c.shapes.orthogonal_groups());
  for(std::size_t i = 0; i < c.cloud.size(); ++i) {
    const int s = c.shapes.shape_index(i);
    CHECK(joined.shape_index(i) == (s < 0 ? -1 : int(c.shapes.coplanar_group(std::size_t(s)))));
  }
  for(std::size_t s = 0; s < planes; ++s) {
    const double noise = noise_of(c, joined, s);
    check_close(joined.uncertainty(s).noise, noise, 1e-9 * noise, c.name + ": noise");
  }
  const std::string why = violation_of(c.cloud, joined, maps.normal_map(Second<Kernel>()));
  CHECK_AT(why.find("not connected") != std::string::npos, why);
}

// Where no shapes are coplanar, all that is measured again is as it was.
void check_joined_alone(const Case& c)
{
  const Shapes alone = select_shapes(c.shapes, c.shapes.distinct_planes());
  check_valid(c.cloud, join_coplanar_shapes(alone, c.cloud, maps), c.name + ": joined alone");
  check_throws<std::invalid_argument>([&] { join_coplanar_shapes(alone, Cloud(), maps); }, {"0 points"}, __LINE__);
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  for(const char* name : {"village", "indoor"})
    for(Given given : {Given::normals, Given::nothing}) {
      const Case c = make_case(name, given);
      CHECK_AT(c.shapes.number_of_shapes() > 4, c.name);
      for(const Indices& indices : selections(c.shapes.number_of_shapes()))
        check_selection(c, indices);
      check_twice(c);
      if(given == Given::normals) {
        check_refusals(c);
        check_all_criteria(c);
        check_largest(c);
        check_wrong_criteria(c);
        check_joined_alone(c);
      }
      if(given == Given::normals && c.name == "indoor")
        check_joined(c);
    }
}

BOOST_AUTO_TEST_SUITE_END()
