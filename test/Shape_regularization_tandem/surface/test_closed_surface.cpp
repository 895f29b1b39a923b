// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// closed_surface(): closed two-manifolds, the same in every unit and with copies of points, and what it refuses.

#include "testing/check_closed_surface.h"

#include <CGAL/Simple_cartesian.h>

BOOST_AUTO_TEST_SUITE(test_closed_surface)

// Copies of points change nothing.
BOOST_AUTO_TEST_CASE(copies_of_points)
{
  std::vector<Epick::Point_3> points;
  for(const Box_point& item : make_box_cloud(400))
    for(int copy = 0; copy < 30; ++copy)
      points.emplace_back(item.position[0], item.position[1], item.position[2]);
  const Found_shapes shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.02).minimum_region_size(50));
  const Surface box = CGAL::Tandem::closed_surface(shapes, points);
  CHECK(box.faces.size() == 6 && box.number_of_points > .95 * double(points.size()));
  checked_volume(box, "copies");
}

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

template <class Exception, class Function>
void check_throws(Function f, const std::string& what)
{
  try {
    f();
    CHECK_AT(false, "no exception of " + what);
  } catch(const Exception& e) {
    CHECK_AT(std::string(e.what()).find(what) != std::string::npos, e.what());
  }
}

BOOST_AUTO_TEST_CASE(refusals)
{
  const Pairs<Epick> cloud = make_pairs<Epick>(make_box_cloud(100));
  const auto list = np::point_map(First<Epick>());
  const Found_shapes shapes =
    CGAL::Tandem::detect_planes(cloud, list.normal_map(Second<Epick>()).maximum_distance(.02).minimum_region_size(50));
  check_throws<std::invalid_argument>([&] { CGAL::Tandem::closed_surface(shapes, Pairs<Epick>(), list); }, "0 points");
  check_throws<std::invalid_argument>(
    [&] { CGAL::Tandem::closed_surface(shapes, cloud, list.maximum_number_of_planes(3)); }, "at least 4");
  check_throws<std::invalid_argument>(
    [&] { CGAL::Tandem::closed_surface(shapes, cloud, list.symmetry_direction(Epick::Vector_3(0, 0, 0))); },
    "symmetry_direction");
  const Surface part = CGAL::Tandem::closed_surface(shapes, cloud, list.maximum_number_of_planes(4));
  CHECK(part.number_of_planes == 4);
  checked_volume(part, "four planes");
  CHECK(CGAL::Tandem::closed_surface(Found_shapes(), std::vector<Epick::Point_3>()).is_empty());
}

BOOST_AUTO_TEST_CASE(random_scenes) { check_random_scenes(20, np::maximum_number_of_planes(40)); }

BOOST_AUTO_TEST_SUITE_END()
