// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The estimate follows the noise, the spacing and the unit of a cloud, and not the
// order of its points. What is given is kept.

#include "testing/box_cloud.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <algorithm>

BOOST_AUTO_TEST_SUITE(test_estimate_parameters)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::estimate_parameters;
using Points = std::vector<Epick::Point_3>;

Points make_points(int points_a_face, float noise)
{
  Points points;
  for(const auto& p : make_pairs<Epick>(make_box_cloud(points_a_face, noise)))
    points.push_back(p.first);
  return points;
}

Points transformed(const Points& points, double scale, const Epick::Vector_3& shift)
{
  Points out;
  for(const auto& p : points)
    out.push_back(CGAL::ORIGIN + (scale * (p - CGAL::ORIGIN) + shift));
  return out;
}

double distance_of(const Points& points) { return estimate_parameters(points).maximum_distance; }

bool is_near(double a, double b, double tolerance) { return std::fabs(a - b) <= tolerance * b; }

BOOST_AUTO_TEST_CASE(test_rule)
{
  // Uniform on a triangle-shaped distribution of +-noise: sigma = noise / sqrt(6).
  for(float noise : {.004f, .008f, .016f, .04f})
    CHECK_AT(is_near(distance_of(make_points(20000, noise)), 3 * noise / std::sqrt(6.), .25), std::to_string(noise));
  // Without noise it is a share of the spacing that grows with the number of points.
  for(int n : {1500, 6000, 24000}) {
    const double share = .017 * std::pow(6.6 * n, 5. / 16);
    CHECK_AT(is_near(distance_of(make_points(n, 0)), share * std::sqrt(.63 / n), .3), std::to_string(n));
  }
  const Points points = make_points(1500, .002f);
  CHECK(estimate_parameters(points).minimum_region_size == std::size_t(.3 * std::sqrt(double(points.size())) + .5));
  CHECK(estimate_parameters(points).maximum_offset == distance_of(points));
}

BOOST_AUTO_TEST_CASE(test_motions)
{
  Points points = make_points(1500, .002f);
  const double distance = distance_of(points);
  std::mt19937 random(3);
  std::shuffle(points.begin(), points.end(), random);
  CHECK(distance_of(points) == distance);
  CHECK(estimate_parameters<CGAL::Sequential_tag>(points).maximum_distance == distance);
  CHECK(distance_of(transformed(points, 1024, {0, 0, 0})) == 1024 * distance);
  CHECK(distance_of(transformed(points, .0078125, {0, 0, 0})) == .0078125 * distance);
  CHECK(is_near(distance_of(transformed(points, .3048, {0, 0, 0})), .3048 * distance, .05));
  CHECK(is_near(distance_of(transformed(points, 1, {500000, 4500000, 100})), distance, .05));
}

BOOST_AUTO_TEST_CASE(test_given)
{
  const Points points = make_points(300, .002f);
  const auto p = estimate_parameters(points, np::maximum_distance(.5).k_neighbors(20).cell_size(100));
  CHECK(p.maximum_distance == .5 && p.maximum_offset == .5 && p.k_neighbors == 20 && p.cell_size == 100);
  const auto q = estimate_parameters(points, np::maximum_offset(0.).minimum_region_size(77).maximum_angle(30));
  CHECK(q.maximum_offset == 0 && q.minimum_region_size == 77 && q.maximum_angle == 30 && q.maximum_distance > 0);
  CGAL::Tandem::Parameters settings;
  settings.maximum_offset = .25;
  settings.angle_tolerance = 3;
  const auto r = estimate_parameters(points, np::settings(settings).angle_tolerance(4));
  CHECK(r.maximum_offset == .25 && r.angle_tolerance == 4);
}

// Names that some versions of CGAL have, and that this package adds to the others.
BOOST_AUTO_TEST_CASE(test_names_of_cgal)
{
  const Points points = make_points(300, .002f);
  const CGAL::Identity_property_map<Epick::Point_3> map;
  const auto p = estimate_parameters(points, CGAL::parameters::maximum_distance(.5).point_map(map));
  CHECK(p.maximum_distance == .5);
  CHECK(estimate_parameters(points, CGAL::parameters::minimum_region_size(77)).minimum_region_size == 77);
  CHECK(estimate_parameters(points, CGAL::parameters::k_neighbors(20)).k_neighbors == 20);
  CHECK(estimate_parameters(points, CGAL::parameters::angle_tolerance(4)).angle_tolerance == 4);
  CHECK(estimate_parameters(points, CGAL::parameters::all_default()).angle_tolerance == 8);
}

BOOST_AUTO_TEST_CASE(test_degenerate)
{
  CHECK(distance_of({}) > 0);
  CHECK(distance_of({{1, 2, 3}}) > 0);
  CHECK(distance_of(Points(50, {0, 0, 0})) > 0);
  CHECK(distance_of(Points(50, {1e200, 0, 0})) > 0);
  CHECK(distance_of(Points(50, {1e300, 0, 0})) == 1e270); // the largest that is allowed
  CHECK(distance_of({{0, 0, 0}, {1, 0, 0}}) > 0);
  const Points points = make_points(300, .002f);
  for(double unit : {1e-322, 1e-318, 1e-310, 1e-300, 1e-280})
    CHECK_AT(distance_of(transformed(points, unit, {0, 0, 0})) == 1e-270, std::to_string(std::log10(unit)));
  CHECK(distance_of(transformed(points, 1e276, {0, 0, 0})) == 1e270);
  for(double x : {1e290, 1e308, 1.7e308})
    check_throws<std::range_error>(
      [&] {
        distance_of({{x, 0, 0}, {-x, 0, 0}, {0, x, 0}});
      },
      {"extent", "2^24 times the largest maximum_distance"}, __LINE__);
  CHECK(estimate_parameters(Points()).minimum_region_size >= 3);
}

BOOST_AUTO_TEST_SUITE_END()
