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

namespace adapters {

using Shapes = CGAL::Tandem::Planar_shapes_3<Epick>;
using Plane = Epick::Plane_3;

struct Box {
  Pairs<Epick> points = make_pairs<Epick>(make_box_cloud());
  Shapes shapes = CGAL::Tandem::detect_planes(
    points, CGAL::Tandem::parameters::point_map(First<Epick>()).normal_map(Second<Epick>()).maximum_distance(.006));
  std::vector<Plane> planes = CGAL::Tandem::distinct_planes(shapes);
};

} // namespace adapters

BOOST_FIXTURE_TEST_SUITE(test_adapters, adapters::Box)

BOOST_AUTO_TEST_CASE(test_index_maps)
{
  const auto shape_map = CGAL::Tandem::shape_index_map(shapes);
  const auto plane_map = CGAL::Tandem::plane_index_map(shapes);
  CHECK(shapes.number_of_shapes() == 6 && planes.size() == shapes.number_of_coplanar_groups());
  for(std::size_t i = 0; i < shapes.number_of_points(); ++i) {
    const int s = shapes.shape_index(i);
    CHECK_AT(get(shape_map, i) == s, std::to_string(i));
    CHECK_AT((get(plane_map, i) < 0) == (s < 0), std::to_string(i));
    if(s >= 0)
      CHECK_AT(planes[std::size_t(get(plane_map, i))] == shapes.plane(std::size_t(s)), std::to_string(i));
  }
}

BOOST_AUTO_TEST_CASE(test_structure_point_set)
{
  Pairs<Epick> structured;
  CGAL::structure_point_set(points, planes, std::back_inserter(structured), .02,
                            CGAL::parameters::point_map(First<Epick>())
                              .normal_map(Second<Epick>())
                              .plane_map(CGAL::Identity_property_map<adapters::Plane>())
                              .plane_index_map(CGAL::Tandem::plane_index_map(shapes)));
  CHECK(structured.size() > 100 && structured.size() < points.size());
}

// CGAL's regularization finds nothing left to do but for the last bits.
BOOST_AUTO_TEST_CASE(test_cgal_regularize_planes)
{
  planes = shapes.planes();
  CGAL::Shape_regularization::Planes::regularize_planes(
    planes, points,
    CGAL::parameters::plane_map(CGAL::Identity_property_map<adapters::Plane>())
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
BOOST_AUTO_TEST_CASE(test_point_set)
{
  CGAL::Point_set_3<Epick::Point_3> set;
  set.add_normal_map();
  for(const auto& p : points)
    set.insert(p.first, p.second);
  set.remove(set.begin());
  const auto of_set = CGAL::Tandem::detect_planes(set, CGAL::Tandem::parameters::maximum_distance(.006));
  const auto map = CGAL::Tandem::add_shape_property(set, of_set);
  CHECK(set.has_property_map<int>("shape") && of_set.number_of_shapes() == 6);
  for(std::size_t s = 0; s < of_set.number_of_shapes(); ++s)
    for(std::size_t i : of_set.points(s)) {
      const auto item = *(set.begin() + std::ptrdiff_t(i));
      CHECK_AT(map[item] == int(s), std::to_string(s));
      CHECK_AT(CGAL::squared_distance(set.point(item), of_set.plane(s)) <= .006 * .006 * 1.000001, std::to_string(s));
    }
}

// A fit to them is the plane again, with normals on the side of the points. An example shows that the surface of such
// points keeps the right angles.
BOOST_AUTO_TEST_CASE(test_projected_points)
{
  const auto items =
    CGAL::Tandem::projected_points(points, shapes, CGAL::Tandem::parameters::point_map(First<Epick>()));
  CHECK(items.size() == shapes.statistics().number_of_assigned_points);
  auto item = items.begin();
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t i : shapes.points(s)) {
      const auto& [point, normal, plane] = *item++;
      CHECK(CGAL::squared_distance(point, planes[std::size_t(plane)]) < 1e-28);
      CHECK(CGAL::squared_distance(point, points[i].first) <= .006 * .006 * 1.000001);
      CHECK(normal == shapes.oriented_plane(s).orthogonal_vector());
    }
}

BOOST_AUTO_TEST_SUITE_END()
