// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// shape_facts() of shapes whose size and place are known: in two kernels, in small, large and far clouds, and of points
// that determine little.

#include "api_support.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

BOOST_AUTO_TEST_SUITE(test_shape_facts)

using CGAL::Tandem::Shape_facts;
using scenes::Vec;
using Points = std::vector<Kernel::Point_3>;

double radians(double degrees) { return degrees * CGAL_PI / 180; }

// The normal of a plane that falls in the direction `azimuth`.
Vec normal_of(double dip, double azimuth)
{
  const double s = std::sin(radians(dip));
  return {s * std::sin(radians(azimuth)), s * std::cos(radians(azimuth)), std::cos(radians(dip))};
}

// Points, and one shape of all of them, as a detection has it.
struct Shape {
  Points points;
  Shapes::Data data;

  Shape(const Points& p, const Vec& n, double d) : points(p)
  {
    data.coefficients = {{n.x, n.y, n.z, d}};
    data.size = {points.size()};
    data.parallel_group = data.coplanar_group = {0};
    data.is_flipped = {0};
    data.uncertainty.resize(1);
    data.shape_of = std::vector<std::int32_t>(points.size(), 0);
    data.parameters.maximum_distance = .2;
  }

  Shape_facts facts(bool is_flipped = false)
  {
    data.is_flipped = {is_flipped};
    return CGAL::Tandem::shape_facts(Shapes(data), points).at(0);
  }
};

// A grid of 41 x 21 points that are `step` apart, turned by 25 degrees in a plane through `center`; every other
// one is `noise` above the plane, the others are below it.
Shape rectangle(const Vec& n, const Vec& center = {3, -2, 5}, double step = .1, double noise = 0)
{
  constexpr int columns = 41, rows = 21;
  const double level = std::hypot(n.x, n.y), c = std::cos(radians(25)), s = std::sin(radians(25));
  const Vec u = level > 0 ? Vec{n.y / level, -n.x / level, 0} : Vec{1, 0, 0}, v = cross(n, u);
  Points points;
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j < rows; ++j) {
      const double x = step * (i - (columns - 1) / 2.), y = step * (j - (rows - 1) / 2.);
      const Vec p = center + (c * x - s * y) * u + (s * x + c * y) * v + ((i + j) % 2 == 0 ? noise : -noise) * n;
      points.emplace_back(p.x, p.y, p.z);
    }
  Shape shape(points, n, -dot(n, center));
  shape.data.parameters.maximum_distance = 2 * step;
  return shape;
}

void check_slope(const Shape_facts& f, double tilt, double dip, double azimuth)
{
  check_close(f.tilt_deg, tilt, 1e-9, "tilt");
  check_close(f.dip_deg, dip, 1e-9, "dip");
  check_close(f.azimuth_deg, azimuth, 1e-9, "azimuth");
}

// `tolerance` is relative to `size`, the unit of all lengths.
void check_rectangle(const Shape_facts& f, const Vec& center, double size, double tolerance)
{
  const double half = std::sin(radians(30)) * (2 * std::sin(radians(25)) + std::cos(radians(25)));
  CHECK(f.number_of_points == 41 * 21);
  check_close(f.centroid[0] / size, center.x / size, tolerance, "x");
  check_close(f.centroid[1] / size, center.y / size, tolerance, "y");
  check_close(f.centroid[2] / size, center.z / size, tolerance, "z");
  check_close(f.area / size / size, 8, 8 * tolerance, "area");
  check_close(f.length / size, 4, tolerance, "length");
  check_close(f.width / size, 2, tolerance, "width");
  check_close((f.highest - center.z) / size, half, tolerance, "highest");
  check_close((f.lowest - center.z) / size, -half, tolerance, "lowest");
  check_slope(f, 30, 30, 120);
  CHECK(f.rms_distance <= tolerance * size && f.mean_distance <= f.rms_distance && f.shifted <= tolerance * size);
  check_close(f.turned_deg, 0, 60 * tolerance, "turned");
}

BOOST_AUTO_TEST_CASE(test_known_rectangle)
{
  const Vec n = normal_of(30, 120), center = {3, -2, 5}, far = {600000, 5400000, 300};
  check_rectangle(rectangle(n).facts(), center, 1, 1e-12);
  check_rectangle(rectangle(n, far).facts(), far, 1, 1e-7);
  for(const double size : {0x1p-300, 0x1p300})
    check_rectangle(rectangle(n, size * center, .1 * size).facts(), size * center, size, 1e-12);
  using Float = CGAL::Simple_cartesian<float>;
  std::vector<Float::Point_3> floats;
  const Shape shape = rectangle(n);
  for(const auto& p : shape.points)
    floats.emplace_back(float(p.x()), float(p.y()), float(p.z()));
  const CGAL::Tandem::Planar_shapes_3<Float> of_floats(shape.data);
  check_rectangle(CGAL::Tandem::shape_facts(of_floats, floats).at(0), center, 1, 1e-5);
}

BOOST_AUTO_TEST_CASE(test_slopes)
{
  for(const double azimuth : {0., 90., 180., 270., 359.}) {
    Shape roof = rectangle(normal_of(20, azimuth)), wall = rectangle(normal_of(90, azimuth));
    check_slope(roof.facts(), 20, 20, azimuth);
    check_slope(roof.facts(true), 160, 20, azimuth); // the lower side
    // Walls, vertical up to rounding: the side of the normal.
    check_slope(wall.facts(), 90, 90, azimuth);
    check_slope(wall.facts(true), 90, 90, azimuth < 180 ? azimuth + 180 : azimuth - 180);
  }
  check_slope(rectangle({0, 0, 1}).facts(), 0, 0, 0);
  check_slope(rectangle({0, 0, 1}).facts(true), 180, 0, 0);
}

// The axis y is upward: north is -z.
BOOST_AUTO_TEST_CASE(test_upward)
{
  Shape shape = rectangle({0, std::cos(radians(10)), -std::sin(radians(10))}, {0, 7, 0});
  const Shapes shapes(shape.data);
  const auto facts_of = [&](const Kernel::Vector_3& up) {
    return CGAL::Tandem::shape_facts(shapes, shape.points, np::symmetry_direction(up)).at(0);
  };
  shape.data.parameters.symmetry_direction = {0, 3, 0};
  for(const Shape_facts& f : {facts_of({0, 1e-200, 0}), shape.facts()}) {
    check_slope(f, 10, 10, 0);
    check_close(f.lowest + f.highest, 14, 1e-12, "heights");
  }
  for(const Kernel::Vector_3& wrong : {Kernel::Vector_3(0, 0, 0), Kernel::Vector_3(0, not_a_number, 1)})
    CHECK_REFUSED(facts_of(wrong), "");
}

// A plane that regularization has turned by a degree about the centroid, and shifted.
BOOST_AUTO_TEST_CASE(test_moved)
{
  const Vec center = {3, -2, 5}, n = normal_of(31, 120);
  Shape shape = rectangle(normal_of(30, 120), center, .1, .004);
  const Shape_facts before = shape.facts(), after = Shape(shape.points, n, -dot(n, center) - .05).facts();
  check_close(before.rms_distance, .004, 1e-12, "rms");
  check_close(before.mean_distance, .004, 1e-12, "mean");
  CHECK_AT(before.turned_deg < .01 && before.shifted < 1e-5, std::to_string(before.turned_deg));
  check_close(after.turned_deg, 1, .01, "turned");
  check_close(after.shifted, .05, 1e-5, "shifted");
  CHECK(after.rms_distance > after.mean_distance && after.mean_distance > .04);
}

BOOST_AUTO_TEST_CASE(test_few_points)
{
  const Shape_facts three = Shape({{1, 1, 0}, {2, 1, 0}, {1, 3, 0}}, {0, 0, 1}, 0).facts();
  CHECK(three.length == 2 && three.width == 1 && three.area == 0 && three.turned_deg == 0 && three.shifted == 0);
  Points line;
  for(int i = 0; i < 30; ++i)
    line.emplace_back(.3 * i, .1 * i, 0);
  const Shape_facts thin = Shape(line, {0, 0, 1}, 0).facts();
  check_close(thin.length, 8.7 * std::sqrt(1 + 1 / 9.), 1e-12, "length of a line");
  CHECK_AT(thin.width < 1e-15 && thin.turned_deg < 1e-12, std::to_string(thin.turned_deg));
  const Shape_facts one = Shape(Points(50, {4, 5, 6}), {0, 0, 1}, -6).facts();
  CHECK(one.length == 0 && one.width == 0 && one.area == 0 && one.centroid == (std::array<double, 3>{4, 5, 6}));
  CHECK(one.turned_deg == 0 && one.shifted == 0 && one.lowest == 6 && one.highest == 6);
  CHECK(std::isfinite(one.rms_distance + one.mean_distance + thin.rms_distance + thin.shifted + three.mean_distance));
  // A known plane that no point is on.
  Shape empty = rectangle(normal_of(30, 120));
  empty.data.shape_of = std::vector<std::int32_t>(empty.points.size(), -1);
  empty.data.size = {0};
  const Shape_facts f = empty.facts();
  CHECK(f.number_of_points == 0 && f.area == 0 && f.length == 0 && f.rms_distance == 0);
  check_slope(f, 30, 30, 120);
}

BOOST_AUTO_TEST_CASE(test_arguments)
{
  Shape shape = rectangle(normal_of(30, 120));
  const Shapes shapes(shape.data);
  Points& points = shape.points;
  const auto areas = CGAL::Tandem::polygons(shapes, points);
  CHECK(CGAL::Tandem::shape_facts(shapes, points, areas)[0].area == areas.area(0));
  const auto refuses = [&](const CGAL::Tandem::Shape_polygons_3<Kernel>& of) {
    return throws<std::invalid_argument>([&] { CGAL::Tandem::shape_facts(shapes, points, of); });
  };
  CHECK(!refuses(areas) && refuses(CGAL::Tandem::Shape_polygons_3<Kernel>()));
  points[5] = {3, -2, 9};
  CHECK(refuses(areas) && throws<std::invalid_argument>([&] { shape.facts(); }));
  points.pop_back();
  CHECK(refuses(areas) && throws<std::invalid_argument>([&] { shape.facts(); }));
  CHECK(CGAL::Tandem::shape_facts(Shapes(), Points()).empty());
}

BOOST_AUTO_TEST_SUITE_END()
