// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// closed_surface(): closed two-manifolds, the same in every unit, and what it refuses. The volumes of houses of
// airborne scans, whose walls have no points.

#include "testing/check_closed_surface.h"

#include <CGAL/Simple_cartesian.h>

#include <random>

BOOST_AUTO_TEST_SUITE(test_closed_surface)

// Six faces in every kernel and in every unit.
BOOST_AUTO_TEST_CASE(six_faces)
{
  const Surface box = surface_of_box<Epick>(1, np::point_map(First<Epick>()));
  CHECK(box.points.size() == 8 && box.faces.size() == 6 && box.number_of_planes == 6);
  checked_volume(box, "box");
  for(const double scale : {std::ldexp(1, -300), std::ldexp(1, 300)}) {
    const Surface other = surface_of_box<Epick>(scale, np::point_map(First<Epick>()));
    CHECK(other.faces == box.faces);
    for(std::size_t i = 0; i < box.points.size() && i < other.points.size(); ++i)
      CHECK(other.points[i].x() == scale * box.points[i].x() && other.points[i].z() == scale * box.points[i].z());
  }
  CHECK((surface_of_box<CGAL::Simple_cartesian<float>>(1, np::point_map(First<CGAL::Simple_cartesian<float>>()))
           .faces.size() == 6));
}

BOOST_AUTO_TEST_CASE(refusals)
{
  const Pairs<Epick> cloud = make_pairs<Epick>(make_box_cloud(100));
  const auto list = np::point_map(First<Epick>());
  const Found_shapes shapes =
    CGAL::Tandem::detect_planes(cloud, list.normal_map(Second<Epick>()).maximum_distance(.02).minimum_region_size(50));
  const auto check_refused = [](auto f, const char* why) { check_throws<std::invalid_argument>(f, {why}, __LINE__); };
  check_refused([&] { CGAL::Tandem::closed_surface(shapes, Pairs<Epick>(), list); }, "0 points");
  check_refused([&] { CGAL::Tandem::closed_surface(shapes, cloud, list.maximum_number_of_planes(3)); }, "at least 4");
  check_refused([&] { CGAL::Tandem::closed_surface(shapes, cloud, list.symmetry_direction(Epick::Vector_3(0, 0, 0))); },
                "symmetry_direction");
  const Surface part = CGAL::Tandem::closed_surface(shapes, cloud, list.maximum_number_of_planes(4));
  CHECK(part.number_of_planes == 4);
  checked_volume(part, "four planes");
  CHECK(CGAL::Tandem::closed_surface(Found_shapes(), std::vector<Epick::Point_3>()).is_empty());
}

BOOST_AUTO_TEST_CASE(random_scenes) { check_random_scenes(20, np::maximum_number_of_planes(40)); }

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

std::vector<Epick::Point_3> airborne_scan(double angle, int houses)
{
  std::vector<Epick::Point_3> points, result;
  for(double y : {-10., 8.})
    add_area(points, Epick::Point_3(-10, y, 0), Epick::Vector_3(10 + 20. * houses, 0, 0), Epick::Vector_3(0, 10, 0));
  for(int i = 0; i <= houses; ++i)
    add_area(points, Epick::Point_3(20. * i - 10, 0, 0), Epick::Vector_3(10, 0, 0), Epick::Vector_3(0, 8, 0));
  add_gable(points, 0, 6, 9);
  if(houses > 1)
    add_gable(points, 20, 5, 8.5);
  if(houses > 2)
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
  check_close(checked_volume(surface, "airborne scan") / truth, 1, .05, "volume of the houses");
}

// Houses of 600, 540 and 960, in any direction.
BOOST_AUTO_TEST_CASE(airborne_scans)
{
  const double volumes[] = {600, 1140, 2100};
  for(const double angle : {0., .1, .5, 1.})
    for(int houses = angle == 0 ? 1 : 2; houses <= 3; ++houses)
      check_airborne_volume(airborne_scan(angle, houses), Epick::Vector_3(0, 0, 1), volumes[houses - 1]);
  std::vector<Epick::Point_3> turned; // about the x axis
  for(const Epick::Point_3& p : airborne_scan(.5, 3))
    turned.emplace_back(p.x(), p.z(), -p.y());
  check_airborne_volume(turned, Epick::Vector_3(0, 2, 0), volumes[2]);
}

BOOST_AUTO_TEST_SUITE_END()
