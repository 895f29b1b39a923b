// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// shape_facts() of shapes whose size and place are known: in two kernels, in small, large and far clouds, and of points
// that determine little.

#include "testing/box_cloud.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

#include <CGAL/Simple_cartesian.h>

#include <limits>

BOOST_AUTO_TEST_SUITE(test_shape_facts)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::Shape_facts;
using Place = std::array<double, 3>;
using Coefficients = CGAL::Tandem::Coefficients;

double radians(double degrees) { return degrees * CGAL_PI / 180; }

// The normal of a plane that falls in the direction `azimuth`.
Place normal_of(double dip, double azimuth)
{
  const double s = std::sin(radians(dip));
  return {s * std::sin(radians(azimuth)), s * std::cos(radians(azimuth)), std::cos(radians(dip))};
}

double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Cloud {
  std::vector<Place> points;
  Coefficients plane;
};

// A grid of 41 x 21 points that are `step` apart, turned by 25 degrees in a plane through `center`; every other
// one is `noise` above the plane, the others are below it.
Cloud rectangle(const Place& n, const Place& center, double step, double noise = 0)
{
  constexpr int columns = 41, rows = 21;
  const double level = std::hypot(n[0], n[1]);
  const Place u = level > 0 ? Place{n[1] / level, -n[0] / level, 0} : Place{1, 0, 0};
  const Place v = {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
  const double c = std::cos(radians(25)), s = std::sin(radians(25));
  Cloud cloud = {{}, {n[0], n[1], n[2], -dot(n, center)}};
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j < rows; ++j) {
      const double x = step * (i - (columns - 1) / 2.), y = step * (j - (rows - 1) / 2.);
      const double a = c * x - s * y, b = s * x + c * y, h = (i + j) % 2 == 0 ? noise : -noise;
      Place p;
      for(std::size_t k = 0; k < 3; ++k)
        p[k] = center[k] + a * u[k] + b * v[k] + h * n[k];
      cloud.points.push_back(p);
    }
  return cloud;
}

// One shape of all points, as a detection has them.
template <class Kernel>
CGAL::Tandem::Planar_shapes_3<Kernel> shape_of(const Cloud& cloud, double maximum_distance, bool is_flipped = false)
{
  CGAL::Tandem::Shapes_data data;
  data.coefficients = {cloud.plane};
  data.size = {cloud.points.size()};
  data.parallel_group = data.coplanar_group = {0};
  data.is_flipped = {char(is_flipped)};
  data.uncertainty.resize(1);
  data.shape_of = std::vector<std::int32_t>(cloud.points.size(), 0);
  data.parameters.maximum_distance = maximum_distance;
  return CGAL::Tandem::Planar_shapes_3<Kernel>(data);
}

template <class Kernel>
std::vector<typename Kernel::Point_3> points_of(const Cloud& cloud)
{
  using FT = typename Kernel::FT;
  std::vector<typename Kernel::Point_3> points;
  for(const Place& p : cloud.points)
    points.emplace_back(FT(p[0]), FT(p[1]), FT(p[2]));
  return points;
}

template <class Kernel = Epick>
Shape_facts facts_of(const Cloud& cloud, double maximum_distance, bool is_flipped = false)
{
  return CGAL::Tandem::shape_facts(shape_of<Kernel>(cloud, maximum_distance, is_flipped), points_of<Kernel>(cloud))[0];
}

// `tolerance` is relative to `size`, the unit of all lengths.
void check_rectangle(const Shape_facts& f, const Place& center, double size, double tolerance)
{
  CHECK(f.number_of_points == 41 * 21);
  for(std::size_t k = 0; k < 3; ++k)
    CHECK_AT(std::fabs(f.centroid[k] - center[k]) <= tolerance * size, std::to_string(f.centroid[k]));
  CHECK_AT(std::fabs(f.area / size / size - 8) <= 8 * tolerance, std::to_string(f.area));
  CHECK_AT(std::fabs(f.length / size - 4) <= tolerance, std::to_string(f.length));
  CHECK_AT(std::fabs(f.width / size - 2) <= tolerance, std::to_string(f.width));
  const double half = std::sin(radians(30)) * (2 * std::sin(radians(25)) + std::cos(radians(25)));
  CHECK_AT(std::fabs((f.highest - center[2]) / size - half) <= tolerance, std::to_string(f.highest));
  CHECK_AT(std::fabs((f.lowest - center[2]) / size + half) <= tolerance, std::to_string(f.lowest));
  CHECK_AT(std::fabs(f.tilt_deg - 30) <= 1e-9 && std::fabs(f.dip_deg - 30) <= 1e-9, std::to_string(f.tilt_deg));
  CHECK_AT(std::fabs(f.azimuth_deg - 120) <= 1e-9, std::to_string(f.azimuth_deg));
  CHECK(f.rms_distance <= tolerance * size && f.mean_distance <= f.rms_distance && f.shifted <= tolerance * size);
  CHECK_AT(f.turned_deg <= 60 * tolerance, std::to_string(f.turned_deg));
}

BOOST_AUTO_TEST_CASE(test_known_rectangle)
{
  const Place n = normal_of(30, 120), center = {3, -2, 5}, far = {600000, 5400000, 300};
  check_rectangle(facts_of(rectangle(n, center, .1), .01), center, 1, 1e-12);
  check_rectangle(facts_of<CGAL::Simple_cartesian<float>>(rectangle(n, center, .1), .01), center, 1, 1e-5);
  check_rectangle(facts_of(rectangle(n, far, .1), .01), far, 1, 1e-7);
  for(const double size : {0x1p-300, 0x1p300}) {
    const Place at = {3 * size, -2 * size, 5 * size};
    check_rectangle(facts_of(rectangle(n, at, .1 * size), .01 * size), at, size, 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(test_slopes)
{
  const Place center = {0, 0, 0};
  for(const double azimuth : {0., 90., 180., 270., 359.}) {
    const Shape_facts upper = facts_of(rectangle(normal_of(20, azimuth), center, .1), .01);
    CHECK_AT(std::fabs(upper.azimuth_deg - azimuth) < 1e-9 && std::fabs(upper.tilt_deg - 20) < 1e-9,
             std::to_string(upper.azimuth_deg));
    // The lower side of the same plane.
    const Shape_facts lower = facts_of(rectangle(normal_of(20, azimuth), center, .1), .01, true);
    CHECK_AT(std::fabs(lower.azimuth_deg - azimuth) < 1e-9 && std::fabs(lower.tilt_deg - 160) < 1e-9,
             std::to_string(lower.tilt_deg));
    CHECK(std::fabs(lower.dip_deg - upper.dip_deg) < 1e-12);
    // Walls, vertical up to rounding: the side of the normal.
    const Shape_facts wall = facts_of(rectangle(normal_of(90, azimuth), center, .1), .01);
    CHECK_AT(std::fabs(wall.azimuth_deg - azimuth) < 1e-9, std::to_string(wall.azimuth_deg));
    CHECK(wall.tilt_deg == 90 && wall.dip_deg == 90);
    const Shape_facts back = facts_of(rectangle(normal_of(90, azimuth), center, .1), .01, true);
    CHECK_AT(std::fabs(std::fabs(back.azimuth_deg - azimuth) - 180) < 1e-9, std::to_string(back.azimuth_deg));
  }
  const Shape_facts floor = facts_of(rectangle({0, 0, 1}, center, .1), .01);
  CHECK(floor.tilt_deg == 0 && floor.dip_deg == 0 && floor.azimuth_deg == 0);
  const Shape_facts ceiling = facts_of(rectangle({0, 0, 1}, center, .1), .01, true);
  CHECK(ceiling.tilt_deg == 180 && ceiling.dip_deg == 0 && ceiling.azimuth_deg == 0);
}

// The axis y is upward: north is -z.
BOOST_AUTO_TEST_CASE(test_upward)
{
  const Cloud cloud = rectangle({0, std::cos(radians(10)), -std::sin(radians(10))}, {0, 7, 0}, .1);
  auto shapes = shape_of<Epick>(cloud, .01);
  const auto points = points_of<Epick>(cloud);
  const auto check = [](const Shape_facts& f) {
    CHECK_AT(std::fabs(f.tilt_deg - 10) < 1e-9 && std::fabs(f.azimuth_deg) < 1e-9, std::to_string(f.tilt_deg));
    CHECK(std::fabs(f.lowest + f.highest - 14) < 1e-12);
  };
  check(CGAL::Tandem::shape_facts(shapes, points, np::symmetry_direction(Epick::Vector_3(0, 1e-200, 0)))[0]);
  auto data = shapes.data();
  data.parameters.symmetry_direction = {0, 3, 0};
  check(CGAL::Tandem::shape_facts(CGAL::Tandem::Planar_shapes_3<Epick>(data), points)[0]);
}

// A plane that regularization has turned by a degree about the centroid, and shifted.
BOOST_AUTO_TEST_CASE(test_moved)
{
  Cloud cloud = rectangle(normal_of(30, 120), {3, -2, 5}, .1, .004);
  const Shape_facts before = facts_of(cloud, .2);
  CHECK_AT(std::fabs(before.rms_distance - .004) < 1e-12, std::to_string(before.rms_distance));
  CHECK_AT(std::fabs(before.mean_distance - .004) < 1e-12, std::to_string(before.mean_distance));
  CHECK_AT(before.turned_deg < .01 && before.shifted < 1e-5, std::to_string(before.turned_deg));
  const Place n = normal_of(31, 120);
  cloud.plane = {n[0], n[1], n[2], -dot(n, {3, -2, 5}) - .05};
  const Shape_facts after = facts_of(cloud, .2);
  CHECK_AT(std::fabs(after.turned_deg - 1) < .01, std::to_string(after.turned_deg));
  CHECK_AT(std::fabs(after.shifted - .05) < 1e-5, std::to_string(after.shifted));
  CHECK(after.rms_distance > after.mean_distance && after.mean_distance > .04);
}

BOOST_AUTO_TEST_CASE(test_few_points)
{
  const Cloud triangle = {{{1, 1, 0}, {2, 1, 0}, {1, 3, 0}}, {0, 0, 1, 0}};
  const Shape_facts three = facts_of(triangle, .01);
  CHECK(three.length == 2 && three.width == 1 && three.area == 0 && three.turned_deg == 0 && three.shifted == 0);
  Cloud line = {{}, {0, 0, 1, 0}};
  for(int i = 0; i < 30; ++i)
    line.points.push_back({.3 * i, .1 * i, 0});
  const Shape_facts thin = facts_of(line, .01);
  CHECK_AT(std::fabs(thin.length - 8.7 * std::sqrt(1 + 1 / 9.)) < 1e-12, std::to_string(thin.length));
  CHECK_AT(thin.width < 1e-15 && thin.turned_deg < 1e-12, std::to_string(thin.turned_deg));
  const Cloud copies = {std::vector<Place>(50, Place{4, 5, 6}), {0, 0, 1, -6}};
  const Shape_facts one = facts_of(copies, .01);
  CHECK(one.length == 0 && one.width == 0 && one.area == 0 && one.centroid == (Place{4, 5, 6}));
  CHECK(one.turned_deg == 0 && one.shifted == 0 && one.lowest == 6 && one.highest == 6);
  for(const Shape_facts& f : {three, thin, one})
    for(const double x : {f.centroid[0], f.area, f.length, f.width, f.lowest, f.highest, f.tilt_deg, f.dip_deg,
                          f.azimuth_deg, f.rms_distance, f.mean_distance, f.turned_deg, f.shifted})
      CHECK(std::isfinite(x));
}

// A known plane that no point is on.
BOOST_AUTO_TEST_CASE(test_no_points)
{
  const Cloud cloud = rectangle(normal_of(30, 120), {3, -2, 5}, .1);
  auto data = shape_of<Epick>(cloud, .01).data();
  data.shape_of = std::vector<std::int32_t>(cloud.points.size(), -1);
  data.size = {0};
  const auto f = CGAL::Tandem::shape_facts(CGAL::Tandem::Planar_shapes_3<Epick>(data), points_of<Epick>(cloud)).at(0);
  CHECK(f.number_of_points == 0 && f.area == 0 && f.length == 0 && f.rms_distance == 0 && f.centroid == Place());
  CHECK(std::fabs(f.tilt_deg - 30) < 1e-9 && std::fabs(f.dip_deg - 30) < 1e-9 && std::fabs(f.azimuth_deg - 120) < 1e-9);
}

// Copies of points change nothing but what counts points.
BOOST_AUTO_TEST_CASE(test_copies)
{
  Cloud cloud = rectangle(normal_of(30, 120), {3, -2, 5}, .1);
  const Shape_facts before = facts_of(cloud, .01);
  const std::vector<Place> points = cloud.points;
  cloud.points.insert(cloud.points.end(), points.begin(), points.end());
  const Shape_facts after = facts_of(cloud, .01);
  CHECK(after.number_of_points == 2 * before.number_of_points);
  CHECK(after.length == before.length && after.width == before.width && after.tilt_deg == before.tilt_deg);
  CHECK_AT(std::fabs(after.area - before.area) < 1e-12, std::to_string(after.area));
}

BOOST_AUTO_TEST_CASE(test_arguments)
{
  const Cloud cloud = rectangle(normal_of(30, 120), {3, -2, 5}, .1);
  const auto shapes = shape_of<Epick>(cloud, .01);
  auto points = points_of<Epick>(cloud);
  const auto areas = CGAL::Tandem::polygons(shapes, points);
  CHECK(CGAL::Tandem::shape_facts(shapes, points, areas)[0].area == areas.area(0));
  const auto refuses = [&](auto... more) {
    return throws<std::invalid_argument>([&] { CGAL::Tandem::shape_facts(shapes, points, more...); });
  };
  CHECK(!refuses() && refuses(CGAL::Tandem::Shape_polygons_3<Epick>()));
  CHECK(refuses(np::symmetry_direction(Epick::Vector_3(0, 0, 0))));
  CHECK(refuses(np::symmetry_direction(Epick::Vector_3(0, std::numeric_limits<double>::quiet_NaN(), 1))));
  points[5] = Epick::Point_3(3, -2, 9);
  CHECK(refuses() && refuses(areas));
  points.pop_back();
  CHECK(refuses() && refuses(areas));
  const std::vector<Epick::Point_3> none;
  CHECK(CGAL::Tandem::shape_facts(CGAL::Tandem::Planar_shapes_3<Epick>(), none).empty());
}

BOOST_AUTO_TEST_SUITE_END()
