// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results with some of the shapes: valid, with the same planes, points and relations, and the shapes that the criteria
// say. And one shape for each plane.

#include "api_support.h"
#include "testing/same_result.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

#include <numeric>

BOOST_AUTO_TEST_SUITE(test_select_shapes)

using CGAL::Tandem::join_coplanar_shapes;
using CGAL::Tandem::select_shapes;
using Indices = std::vector<std::size_t>;

// All indices below n, in their order.
Indices first_indices(std::size_t n)
{
  Indices all(n);
  std::iota(all.begin(), all.end(), std::size_t(0));
  return all;
}

struct Case {
  std::string name;
  Cloud cloud;
  Shapes shapes;
  Given given;

  std::size_t number() const { return shapes.number_of_shapes(); }
};

Case make_case(const std::string& name, Given given)
{
  const scenes::Scene scene = make_scene(name, scene_options(20000, .0005, .1));
  Cloud cloud = to_cloud(scene);
  add(cloud, {not_a_number, 0, 0}, {0, 0, 1});
  Parameters parameters = make_parameters(.002 * scene.diagonal, 50);
  parameters.fixed_directions = {{0, 0, 1}};
  parameters.regularize_axis_symmetry = true;
  const Case c = {name, cloud, detect_valid(name, cloud, parameters, given), given};
  CHECK_AT(c.number() > 4, name);
  return c;
}

void check_selection(const Case& c, const Indices& indices)
{
  const Shapes &all = c.shapes, selected = select_shapes(all, indices);
  check_valid(c.cloud, selected, c.name + ", " + std::to_string(indices.size()), c.given);
  check_equal(selected.number_of_shapes(), indices.size(), c.name + ": number of shapes");
  std::vector<std::int32_t> labels(all.number_of_points(), -1);
  std::size_t points = 0;
  for(std::size_t i = 0; i < indices.size(); ++i) {
    const std::size_t s = indices[i];
    CHECK(selected.coefficients(i) == all.coefficients(s) && selected.plane(i) == all.plane(s));
    CHECK(selected.is_flipped(i) == all.is_flipped(s) && selected.size(i) == all.size(s));
    CHECK(selected.uncertainty(i).noise == all.uncertainty(s).noise);
    for(std::size_t p : all.points(s))
      labels[p] = std::int32_t(i);
    points += all.size(s);
    for(std::size_t j = 0; j < indices.size(); ++j) {
      CHECK(selected.are_parallel(i, j) == all.are_parallel(s, indices[j]));
      CHECK(selected.are_coplanar(i, j) == all.are_coplanar(s, indices[j]));
      CHECK(selected.are_orthogonal(i, j) == all.are_orthogonal(s, indices[j]));
    }
    CHECK(selected.fixed_direction(selected.parallel_group(i)) == all.fixed_direction(all.parallel_group(s)));
  }
  CHECK(std::equal(labels.begin(), labels.end(), selected.shape_indices().begin()));
  const auto &now = selected.statistics(), &before = all.statistics();
  CHECK(now.number_of_assigned_points == points && now.free_points.clutter == before.free_points.clutter);
  CHECK(now.free_points.unselected == before.number_of_assigned_points - points);
}

// The first, the last, every other, all the other way round, none. What is selected of a selection is what is selected
// at once.
void check_selections(const Case& c)
{
  const Indices all = first_indices(c.number());
  Indices every_other;
  for(std::size_t s = 1; s < all.size(); s += 2)
    every_other.push_back(s);
  for(const Indices& indices : {Indices{0}, {all.back()}, every_other, Indices(all.rbegin(), all.rend()), {}})
    check_selection(c, indices);
  const Shapes twice = select_shapes(select_shapes(c.shapes, Indices{3, 1, 0}), std::vector<int>{2, 0});
  CHECK(shape_bits(twice) == shape_bits(select_shapes(c.shapes, Indices{0, 3})));
  CHECK(shape_bits(select_shapes(c.shapes, all)) == shape_bits(c.shapes));
  CHECK(select_shapes(c.shapes, all).hash() == c.shapes.hash());
}

void check_refusals(const Case& c)
{
  const int n = int(c.number());
  const std::vector<std::pair<std::vector<int>, std::string>> wrong = {
    {{0, n}, "no shape " + to_text(n)}, {{-1}, "no shape -1"}, {{1, 0, 1}, "Shape 1 is selected twice"}};
  for(const auto& [indices, why] : wrong)
    check_throws<std::invalid_argument>([&, &list = indices] { select_shapes(c.shapes, list); }, {why.c_str()},
                                        __LINE__);
  Shapes::Data data = select_shapes(c.shapes, Indices{0}).data();
  --data.statistics.free_points.unselected;
  const std::string why = violation(c.cloud, Shapes(data));
  CHECK_AT(why.find("free_points") != std::string::npos, why);
}

// All criteria; their defaults fit all shapes.
struct Criteria {
  Kernel::Vector_3 near = {0, 0, 1}, orthogonal = {0, 0, 1};
  double near_angle = 90, area = 0, extent = 0;
  int largest = 1000;

  Shapes select(const Shapes& shapes, const Cloud& cloud) const
  {
    const auto list = positions.near_direction(near).orthogonal_direction(orthogonal).near_angle(near_angle);
    return select_shapes(shapes, cloud, list.minimum_area(area).minimum_extent(extent).largest(largest));
  }
};

// Of the shapes with is_kept(s), in their order.
template <class Is_kept>
void check_kept(const Case& c, const Shapes& selected, const std::string& what, Is_kept is_kept)
{
  Indices expected;
  for(std::size_t s = 0; s < c.number(); ++s)
    if(is_kept(s))
      expected.push_back(s);
  CHECK_AT(!expected.empty() && expected.size() < c.number(), what + ": " + to_text(expected.size()));
  CHECK_AT(shape_bits(selected) == shape_bits(select_shapes(c.shapes, expected)), what);
}

void check_criteria(const Case& c)
{
  const auto cosine = [&](std::size_t s, std::size_t axis) { return std::fabs(c.shapes.coefficients(s)[axis]); };
  const auto sine_of = [](double degrees) { return std::sin(degrees * CGAL_PI / 180); };
  const Kernel::Vector_3 upward(0, 0, -7);
  check_kept(c, select_shapes(c.shapes, c.cloud, positions.near_direction(upward)), "level",
             [&](std::size_t s) { return cosine(s, 2) >= sine_of(80); });
  check_kept(c, select_shapes(c.shapes, c.cloud, positions.orthogonal_direction(upward)), "walls",
             [&](std::size_t s) { return cosine(s, 2) <= sine_of(10); });
  // Of either sign, within an angle of one direction and of a right angle to another one.
  const Criteria facing = {{-1, 0, 0}, {0, 0, 1}, 40};
  check_kept(c, facing.select(c.shapes, c.cloud), "facing x",
             [&](std::size_t s) { return cosine(s, 0) >= sine_of(50) && cosine(s, 2) <= sine_of(40); });
  const std::vector<CGAL::Tandem::Shape_facts> facts = CGAL::Tandem::shape_facts(c.shapes, c.cloud, positions);
  const double area = facts[2].area, length = facts[1].length;
  for(const auto& [a, e] : std::vector<std::pair<double, double>>{{area, 0}, {0, length}, {area, length}})
    check_kept(c, Criteria{{0, 0, 1}, {0, 0, 1}, 90, a, e}.select(c.shapes, c.cloud), "large",
               [&, a = a, e = e](std::size_t s) { return facts[s].area >= a && facts[s].length >= e; });
}

// The largest of those that fit the others; shapes are sorted by their size.
void check_largest(const Case& c)
{
  const Indices all = first_indices(c.number());
  const Shapes turned = select_shapes(c.shapes, Indices(all.rbegin(), all.rend()));
  Criteria criteria;
  for(std::size_t n : {std::size_t(1), std::size_t(3), c.number() + 9}) {
    const Indices last(all.end() - std::ptrdiff_t((std::min)(n, all.size())), all.end());
    criteria.largest = int(n);
    CHECK(shape_bits(criteria.select(turned, c.cloud)) == shape_bits(select_shapes(turned, last)));
  }
  const Shapes facing = Criteria{{1, 0, 0}, {0, 0, 1}, 40}.select(c.shapes, c.cloud);
  const Shapes largest = Criteria{{1, 0, 0}, {0, 0, 1}, 40, 0, 0, 1}.select(c.shapes, c.cloud);
  CHECK(shape_bits(largest) == shape_bits(select_shapes(facing, Indices{0})));
}

void check_wrong_criteria(const Case& c)
{
  const Kernel::Vector_3 up(0, 0, 1), null(0, 0, 0);
  struct Wrong {
    Criteria criteria;
    const char *name, *value;
  };
  for(const Wrong& w :
      {Wrong{{up, up, 90, 0, 0, 0}, "largest", "0"}, Wrong{{up, up, 90, 0, 0, -2}, "largest", "-2"},
       Wrong{{up, up, 90, -1}, "minimum_area", "-1"}, Wrong{{up, up, 90, 0, not_a_number}, "minimum_extent", "nan"},
       Wrong{{null}, "near_direction", "not null"}, Wrong{{up, null}, "orthogonal_direction", "not null"},
       Wrong{{up, up, 91}, "near_angle", "91"}})
    CHECK_REFUSED(w.criteria.select(c.shapes, c.cloud), w.name, w.value);
}

// One shape for each plane. Where no shapes are coplanar, all that is measured again is as it was.
void check_joined(const Case& c)
{
  const Shapes joined = join_coplanar_shapes(c.shapes, c.cloud, positions);
  const std::size_t planes = c.shapes.number_of_coplanar_groups();
  check_counts(c.name, joined, planes, c.shapes.number_of_parallel_groups(), planes);
  CHECK(joined.orthogonal_groups() == c.shapes.orthogonal_groups());
  for(std::size_t i = 0; i < c.cloud.size(); ++i) {
    const int s = c.shapes.shape_index(i);
    CHECK(joined.shape_index(i) == (s < 0 ? -1 : int(c.shapes.coplanar_group(std::size_t(s)))));
  }
  for(std::size_t s = 0; s < planes; ++s) {
    double squares = 0;
    for(std::size_t i : joined.points(s))
      squares += CGAL::squared_distance(c.cloud[i].first, joined.plane(s));
    const double noise = std::sqrt(squares / double(joined.size(s) - 3));
    check_close(joined.uncertainty(s).noise, noise, 1e-9 * noise, c.name + ": noise");
  }
  if(c.name == "indoor") {
    CHECK_AT(planes < c.number(), c.name);
    const std::string why = violation(c.cloud, joined);
    CHECK_AT(why.find("not connected") != std::string::npos, why);
  }
  const Shapes alone = select_shapes(c.shapes, c.shapes.distinct_planes());
  check_valid(c.cloud, join_coplanar_shapes(alone, c.cloud, positions), c.name + ": joined alone");
  CHECK_REFUSED(join_coplanar_shapes(alone, Cloud(), positions), "0 points");
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  for(const char* name : {"village", "indoor"}) {
    check_selections(make_case(name, Given::nothing));
    const Case c = make_case(name, Given::normals);
    check_selections(c);
    check_refusals(c);
    check_criteria(c);
    check_largest(c);
    check_wrong_criteria(c);
    check_joined(c);
  }
}

BOOST_AUTO_TEST_SUITE_END()
