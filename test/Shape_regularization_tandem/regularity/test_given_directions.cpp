// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directions that are known beforehand, and symmetry about an axis: a house with a gable roof of unequal slopes, which
// leans by a given angle. Exact where the points allow it, and nowhere else.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>

#include <cmath>

BOOST_AUTO_TEST_SUITE(test_given_directions)

namespace np = CGAL::Tandem::parameters;
using scenes::Vec;
using Direction = std::array<double, 3>;

constexpr double epsilon = .05;
const Direction vertical = {0, 0, 2}, tilted = {3e200, 4e200, 0}; // of any length

double degrees(double angle) { return angle * 3.14159265358979323846 / 180; }

// The house leans about the x axis.
Vec leaning(const Vec& v, double angle)
{
  const double c = std::cos(degrees(angle)), s = std::sin(degrees(angle));
  return {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
}

// A grid of points that are apart by a tenth of epsilon more or less.
void add_face(Cloud& cloud, const Vec& corner, const Vec& u, const Vec& v, double lean)
{
  const Vec n = leaning(unit(cross(u, v)), lean);
  const int columns = int(10 * length(u)), rows = int(10 * length(v));
  for(int i = 0; i <= columns; ++i)
    for(int j = 0; j <= rows; ++j) {
      const double noise = .1 * epsilon * ((i * 7 + j * 5) % 3 - 1);
      const Vec in_face = add_scaled(add_scaled(corner, double(i) / columns, u), double(j) / rows, v);
      const Vec p = add_scaled(leaning(in_face, lean), noise, n);
      add(cloud, p, n);
    }
}

// Floor, four walls, two sides of the roof with slopes of 30 and 30 + difference degrees. The ridge runs along y.
Cloud make_house(double lean, double difference)
{
  const double left = 3 * std::tan(degrees(30)), right = 3 * std::tan(degrees(30 + difference));
  const Vec depth = {0, 4, 0}, faces[7][3] = {{{0, 0, 0}, {6, 0, 0}, depth},     {{0, 0, 0}, {6, 0, 0}, {0, 0, 3}},
                                              {depth, {6, 0, 0}, {0, 0, 3}},     {{0, 0, 0}, depth, {0, 0, 3}},
                                              {{6, 0, 0}, depth, {0, 0, 3}},     {{0, 0, 3}, {3, 0, left}, depth},
                                              {{6, 0, 3}, {-3, 0, right}, depth}};
  Cloud cloud;
  for(const auto& [corner, u, v] : faces)
    add_face(cloud, corner, u, v, lean);
  return cloud;
}

Parameters make_house_parameters()
{
  Parameters p = make_parameters(epsilon, 100);
  p.fixed_directions = {tilted, vertical};
  return p;
}

Direction normal(const Shapes& shapes, std::size_t group)
{
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    if(shapes.parallel_group(s) == group)
      return {shapes.coefficients(s)[0], shapes.coefficients(s)[1], shapes.coefficients(s)[2]};
  return {};
}

// The number of parallel groups that have the fixed direction k, and that are orthogonal to it.
std::pair<int, int> count_related(const Shapes& shapes, int k)
{
  std::pair<int, int> count = {0, 0};
  for(std::size_t g = 0; g < shapes.number_of_parallel_groups(); ++g)
    if(shapes.fixed_direction(g) == k)
      ++count.first;
    else if(std::fabs(normal(shapes, g)[2]) <= 1e-15)
      ++count.second;
  return count;
}

// A direction that is too far from the shapes, or that costs their points too much, has no effect: a face of 6 x 4
// turned by 7 degrees is far outside of epsilon.
BOOST_AUTO_TEST_CASE(fixed_direction)
{
  for(double lean : {0., .2, 7.}) {
    const Cloud cloud = make_house(lean, 0);
    const Shapes shapes = detect_valid("leaning house", cloud, make_house_parameters());
    check_equal(shapes.number_of_shapes(), std::size_t(7), "shapes");
    CHECK_AT((count_related(shapes, 1) == (lean < 1 ? std::pair<int, int>(1, 2) : std::pair<int, int>(0, 1))),
             "the floor is horizontal, walls of two directions are vertical; or only the walls across the axis");
    for(std::size_t g = 0; g < shapes.number_of_parallel_groups(); ++g)
      CHECK_AT(shapes.symmetry_group(g) == -1 &&
                 (shapes.fixed_direction(g) != 1 || normal(shapes, g) == Direction{0, 0, 1}),
               "no axis is given, and the very direction");
    Parameters free = make_house_parameters();
    free.fixed_directions.clear();
    CHECK_AT(lean == 0 || count_related(detect(cloud, free), 1).first == 0, "without it, the floor leans");
  }
}

// A lean of 1 degree costs the points more than relations are worth by default.
BOOST_AUTO_TEST_CASE(fixed_regularity)
{
  const Cloud cloud = make_house(1, 0);
  Parameters p = make_house_parameters();
  const Shapes free = detect_valid("free", cloud, p);
  p.fixed_regularity = p.regularity;
  check_equal(detect(cloud, p).hash(), free.hash(), "no more than others");
  p.fixed_regularity = 2;
  const Shapes fixed = detect_valid("fixed", cloud, p);
  CHECK(count_related(free, 1) == std::make_pair(0, 1) && count_related(fixed, 1) == std::make_pair(1, 2));
  check_equal(fixed.number_of_shapes(), std::size_t(7), "shapes");
}

// The groups of the roof: neither horizontal nor vertical.
std::vector<std::size_t> roof_groups(const Shapes& shapes)
{
  std::vector<std::size_t> roof;
  for(std::size_t g = 0; g < shapes.number_of_parallel_groups(); ++g)
    if(std::fabs(normal(shapes, g)[2]) > .1 && std::fabs(normal(shapes, g)[2]) < .99)
      roof.push_back(g);
  return roof;
}

// With symmetry the sides of the roof have one slope, which detect_valid() checks, and stay orthogonal to the gable
// walls.
BOOST_AUTO_TEST_CASE(symmetry)
{
  const Cloud cloud = make_house(.2, .5);
  for(const bool is_symmetric : {true, false}) {
    Parameters p = make_house_parameters();
    p.regularize_axis_symmetry = is_symmetric;
    const Shapes shapes = detect_valid("unequal roof", cloud, p);
    const std::vector<std::size_t> roof = roof_groups(shapes);
    check_equal(roof.size(), std::size_t(2), "sides of the roof");
    const double difference = std::fabs(normal(shapes, roof[0])[2]) - std::fabs(normal(shapes, roof[1])[2]);
    CHECK_AT(is_symmetric ? std::fabs(difference) <= 1e-15 : std::fabs(difference) > 1e-3, std::to_string(difference));
    CHECK(!is_symmetric || shapes.symmetry_group(roof[0]) == shapes.symmetry_group(roof[1]));
    const auto has_roof = [&](const auto& pair) {
      return std::count(roof.begin(), roof.end(), pair.first) + std::count(roof.begin(), roof.end(), pair.second) > 0;
    };
    const auto& pairs = shapes.orthogonal_groups();
    CHECK(!is_symmetric || std::count_if(pairs.begin(), pairs.end(), has_roof) == 2);
  }
}

// Directions that differ in their last bits or their signs are one: the first. So is the axis of symmetry.
BOOST_AUTO_TEST_CASE(equal_directions)
{
  using CGAL::Tandem::internal::Vector;
  Parameters p;
  p.fixed_directions = {{1, 2, 3}, {-.1, -.2, -.3}, {1, 2, 3 + 1e-12}, {1, 0, 1e-10}, {-1, 0, 1e-10}, {1, 2, 3 + 1e-7}};
  p.regularize_axis_symmetry = true;
  p.symmetry_direction = {.3, .6, .9 + 1e-10};
  const auto options = CGAL::Tandem::internal::make_regularity_parameters(p, 0, 1, 100);
  const std::vector<Vector>& fixed = options.fixed_directions;
  check_equal(fixed.size(), std::size_t(3), "different directions");
  for(std::size_t kept : {0, 3, 5})
    CHECK_AT(
      std::count(fixed.begin(), fixed.end(), CGAL::Tandem::internal::given_direction(p.fixed_directions[kept])) == 1,
      "the first of equal directions stays, here " + std::to_string(kept));
  check_equal(options.symmetry_axis.size(), std::size_t(1), "axes");
  CHECK_AT(options.symmetry_axis.front() == fixed.front(), "the axis is the fixed direction that it equals");
}

// The same for planes of another detector.
BOOST_AUTO_TEST_CASE(given_planes)
{
  const Cloud cloud = make_house(.3, 1);
  Parameters p = make_house_parameters();
  p.fixed_directions.clear();
  p.regularize_parallelism = p.regularize_orthogonality = p.regularize_coplanarity = false;
  const Shapes found = detect(cloud, p);
  std::vector<Kernel::Plane_3> planes = found.planes();
  const std::vector<Direction> directions = {vertical};
  const auto list = np::point_map(First<Kernel>()).plane_index_map(CGAL::Tandem::shape_index_map(found));
  const auto within = list.maximum_distance(epsilon).maximum_angle(8);
  const CGAL::Tandem::Plane_relations r =
    CGAL::Tandem::regularize_planes(planes, cloud, within.fixed_directions(directions).symmetry_direction(vertical));
  int horizontal = 0, walls = 0;
  for(std::size_t s = 0; s < planes.size(); ++s) {
    const Kernel::Vector_3 n = planes[s].orthogonal_vector();
    const int g = r.parallel_group[s];
    horizontal += r.fixed_direction[g] == 0 && n.x() == 0 && n.y() == 0 && std::fabs(n.z()) == 1;
    walls += std::fabs(n.z()) <= 1e-15;
    for(std::size_t t = 0; t < s; ++t)
      if(r.symmetry_group[g] == r.symmetry_group[r.parallel_group[t]])
        CHECK_AT(std::fabs(std::fabs(n.z()) - std::fabs(planes[t].orthogonal_vector().z())) <= 1e-15, "symmetric");
  }
  check_equal(horizontal, 1, "floor");
  check_equal(walls, 4, "walls");
  check_equal(*std::max_element(r.symmetry_group.begin(), r.symmetry_group.end()), 2, "floor, walls, roof");
}

BOOST_AUTO_TEST_SUITE_END()
