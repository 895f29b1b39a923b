// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The result handed to the parts of CGAL that take planes with their points.

#include "testing/box_cloud.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>
#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <CGAL/Point_set_3.h>
#include <CGAL/Shape_regularization/regularize_planes.h>
#include <CGAL/structure_point_set.h>

#include <iterator>

BOOST_AUTO_TEST_SUITE(test_adapters)

namespace np = CGAL::Tandem::parameters;
using Shapes = CGAL::Tandem::Planar_shapes_3<Epick>;
using Plane = Epick::Plane_3;

void test_index_maps(const Shapes& shapes)
{
  const auto shape_map = CGAL::Tandem::shape_index_map(shapes);
  const auto plane_map = CGAL::Tandem::plane_index_map(shapes);
  const std::vector<Plane> planes = CGAL::Tandem::distinct_planes(shapes);
  CHECK(planes.size() == shapes.number_of_coplanar_groups());
  for(std::size_t i = 0; i < shapes.number_of_points(); ++i) {
    const int s = shapes.shape_index(i);
    CHECK_AT(get(shape_map, i) == s, std::to_string(i));
    CHECK_AT((get(plane_map, i) < 0) == (s < 0), std::to_string(i));
    if(s >= 0)
      CHECK_AT(planes[std::size_t(get(plane_map, i))] == shapes.plane(std::size_t(s)), std::to_string(i));
  }
}

void test_structure_point_set(const Pairs<Epick>& points, const Shapes& shapes)
{
  Pairs<Epick> structured;
  CGAL::structure_point_set(points, CGAL::Tandem::distinct_planes(shapes), std::back_inserter(structured), .02,
                            CGAL::parameters::point_map(First<Epick>())
                              .normal_map(Second<Epick>())
                              .plane_map(CGAL::Identity_property_map<Plane>())
                              .plane_index_map(CGAL::Tandem::plane_index_map(shapes)));
  CHECK(structured.size() > 100 && structured.size() < points.size());
}

// CGAL's regularization finds nothing left to do but for the last bits.
void test_regularize_planes(const Pairs<Epick>& points, const Shapes& shapes)
{
  std::vector<Plane> planes = shapes.planes();
  CGAL::Shape_regularization::Planes::regularize_planes(
    planes, points,
    CGAL::parameters::plane_map(CGAL::Identity_property_map<Plane>())
      .point_map(First<Epick>())
      .plane_index_map(CGAL::Tandem::shape_index_map(shapes))
      .regularize_axis_symmetry(false)
      .maximum_angle(5)
      .maximum_offset(.001));
  for(std::size_t s = 0; s < planes.size(); ++s) {
    const double cosine = planes[s].orthogonal_vector() * shapes.plane(s).orthogonal_vector() /
                          std::sqrt(planes[s].orthogonal_vector().squared_length());
    CHECK_AT(std::fabs(cosine) > 1 - 1e-12, std::to_string(s));
  }
}

// With a hole in the indices: an item is not its position.
void test_point_set(const Pairs<Epick>& pairs)
{
  CGAL::Point_set_3<Epick::Point_3> points;
  points.add_normal_map();
  for(const auto& p : pairs)
    points.insert(p.first, p.second);
  points.remove(points.begin());
  const Shapes shapes = CGAL::Tandem::detect_planes(points, np::maximum_distance(.006));
  const auto map = CGAL::Tandem::add_shape_property(points, shapes);
  CHECK(points.has_property_map<int>("shape"));
  CHECK(shapes.number_of_shapes() == 6);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t i : shapes.points(s)) {
      const auto item = *(points.begin() + std::ptrdiff_t(i));
      CHECK_AT(map[item] == int(s), std::to_string(s));
      CHECK_AT(CGAL::squared_distance(points.point(item), shapes.plane(s)) <= .006 * .006 * 1.000001,
               std::to_string(s));
    }
}

// A fit to them is the plane again. An example shows that the surface of such points keeps the right angles.
void test_projected_points(const Pairs<Epick>& points, const Shapes& shapes)
{
  using Item = CGAL::Tandem::Point_with_plane<Epick>;
  const std::vector<Item> items = CGAL::Tandem::projected_points(points, shapes, np::point_map(First<Epick>()));
  CHECK(items.size() == shapes.statistics().number_of_assigned_points);
  const std::vector<Plane> planes = CGAL::Tandem::distinct_planes(shapes);
  for(const Item& item : items)
    CHECK(CGAL::squared_distance(std::get<0>(item), planes[std::size_t(std::get<2>(item))]) < 1e-28);
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  const Pairs<Epick> points = make_pairs<Epick>(make_box_cloud());
  const Shapes shapes = CGAL::Tandem::detect_planes(
    points, np::point_map(First<Epick>()).normal_map(Second<Epick>()).maximum_distance(.006));
  CHECK(shapes.number_of_shapes() == 6);
  test_index_maps(shapes);
  test_structure_point_set(points, shapes);
  test_regularize_planes(points, shapes);
  test_point_set(points);
  test_projected_points(points, shapes);
}

BOOST_AUTO_TEST_SUITE_END()
