// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The volumes of closed_surface(): a house, and houses of airborne scans, whose walls have no points.

#include "scenes/scenes.h"
#include "testing/check_closed_surface.h"

#include <algorithm>
#include <random>
#include <set>

BOOST_AUTO_TEST_SUITE(test_surface_volumes)

namespace scenes = CGAL::Tandem::scenes;

// Points every .2 on a parallelogram, with some noise upward.
void add_area(std::vector<Epick::Point_3>& points, const Epick::Point_3& corner, const Epick::Vector_3& u,
              const Epick::Vector_3& v)
{
  static std::mt19937 random(1);
  const int m = int(std::sqrt(u.squared_length()) / .2), n = int(std::sqrt(v.squared_length()) / .2);
  for(int i = 0; i < m; ++i)
    for(int j = 0; j < n; ++j) {
      const Epick::Vector_3 noise(0, 0, .04 * (double(random()) / 4294967296. - .5));
      points.push_back(corner + (i + .5) / m * u + (j + .5) / n * v + noise);
    }
}

// Of roofs and the ground around them, as an airborne scanner sees them: walls and floors have no points.
void add_gable(std::vector<Epick::Point_3>& points, double x, double eaves, double ridge)
{
  add_area(points, Epick::Point_3(x, 0, eaves), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 4, ridge - eaves));
  add_area(points, Epick::Point_3(x, 4, ridge), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 4, eaves - ridge));
}

std::vector<Epick::Point_3> airborne_scan(double angle, bool has_flat_roof)
{
  std::vector<Epick::Point_3> points, result;
  const Epick::Point_3 ground(-10, -10, 0);
  add_area(points, ground, Epick::Vector_3(70, 0, 0), Epick::Vector_3(0, 10, 0));
  add_area(points, ground + Epick::Vector_3(0, 18, 0), Epick::Vector_3(70, 0, 0), Epick::Vector_3(0, 10, 0));
  for(double x : {-10, 10, 30, 50})
    add_area(points, Epick::Point_3(x, 0, 0), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 8, 0));
  add_gable(points, 0, 6, 9);
  add_gable(points, 20, 5, 8.5);
  if(has_flat_roof)
    add_area(points, Epick::Point_3(40, 0, 12), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 8, 0));
  const double c = std::cos(angle), s = std::sin(angle);
  for(const Epick::Point_3& p : points)
    result.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
  return result;
}

void check_airborne_volume(const std::vector<Epick::Point_3>& points, const Epick::Vector_3& up, double truth)
{
  const Found_shapes shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.08).minimum_region_size(100));
  const Surface surface = CGAL::Tandem::closed_surface(shapes, points, np::symmetry_direction(up));
  CHECK(surface.number_of_points > 1000 && surface.number_of_points < points.size());
  const double volume = checked_volume(surface, "airborne scan");
  CHECK_AT(std::fabs(volume - truth) < .05 * truth,
           "the houses have " + std::to_string(volume) + " of " + std::to_string(truth));
}

// Two houses of 600 and 540, and one of 960, in any direction.
BOOST_AUTO_TEST_CASE(airborne_scans)
{
  const Epick::Vector_3 up(0, 0, 1);
  for(const double angle : {0., .1, .5, 1.})
    for(const bool has_flat_roof : {false, true})
      check_airborne_volume(airborne_scan(angle, has_flat_roof), up, has_flat_roof ? 2100 : 1140);
  std::vector<Epick::Point_3> turned, gable; // about the x axis; two planes and the ground
  for(const Epick::Point_3& p : airborne_scan(.5, true))
    turned.emplace_back(p.x(), p.z(), -p.y());
  check_airborne_volume(turned, Epick::Vector_3(0, 2, 0), 2100);
  add_gable(gable, 0, 6, 9);
  for(double y : {-10., 8.})
    add_area(gable, Epick::Point_3(-10, y, 0), Epick::Vector_3(30, 0, 0), Epick::Vector_3(0, 10, 0));
  for(double x : {-10., 10.})
    add_area(gable, Epick::Point_3(x, 0, 0), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 8, 0));
  check_airborne_volume(gable, up, 600);
}

// Above the ground.
double true_volume_of_house()
{
  const scenes::Model model = scenes::make_house();
  std::mt19937 random(1);
  const auto between = [&](double a, double b) { return a + (b - a) * double(random()) / 4294967296.; };
  constexpr int n = 200000;
  int inside = 0;
  for(int i = 0; i < n; ++i) {
    const double x = between(-8, 21), y = between(-6.5, 18.5);
    const scenes::Vec p{x, y, between(0, 11)};
    const auto has = [&](const scenes::Convex& c) { return scenes::Model::is_inside(c, p, 0); };
    inside += std::any_of(model.solids.begin(), model.solids.end(), has) &&
              std::none_of(model.voids.begin(), model.voids.end(), has);
  }
  return 29. * 25 * 11 * inside / n;
}

// No floor, and the ground around it is not a part of it.
void check_house(std::size_t number_of_points, double maximum_distance)
{
  scenes::Options options;
  options.points = number_of_points;
  const scenes::Scene scene = scenes::make_scene("house", options);
  std::vector<Epick::Point_3> points;
  for(const scenes::Vec& p : scene.points)
    points.emplace_back(p.x, p.y, p.z);
  const Found_shapes shapes =
    CGAL::Tandem::detect_planes(points, np::maximum_distance(maximum_distance).minimum_region_size(100));
  const Surface surface = CGAL::Tandem::closed_surface(shapes, points);
  const double volume = checked_volume(surface, "house"), truth = true_volume_of_house();
  CHECK_AT(std::fabs(volume - truth) < .03 * truth,
           "the house has " + std::to_string(volume) + ", the truth is " + std::to_string(truth));
  const std::set<int> planes(surface.plane_of_face.begin(), surface.plane_of_face.end());
  CHECK_AT(double(planes.size()) > .8 * double(shapes.number_of_coplanar_groups()), std::to_string(planes.size()));
}

BOOST_AUTO_TEST_CASE(houses)
{
  check_house(50000, .04);
  check_house(100000, .03);
  check_house(100000, .04);
}

BOOST_AUTO_TEST_SUITE_END()
