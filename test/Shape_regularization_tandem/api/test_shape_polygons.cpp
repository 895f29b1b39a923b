// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// polygons() as a user calls it: kernels, entries of planes, frames, and what it refuses.

#include "testing/box_cloud.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <CGAL/Simple_cartesian.h>

#include <limits>

BOOST_AUTO_TEST_SUITE(test_shape_polygons)

namespace np = CGAL::Tandem::parameters;

template <class Kernel>
struct Result {
  Pairs<Kernel> cloud;
  CGAL::Tandem::Planar_shapes_3<Kernel> shapes;
  CGAL::Tandem::Shape_polygons_3<Kernel> areas;
};

template <class Kernel>
Result<Kernel> result_of(const Pairs<Kernel>& cloud, bool is_by_plane = false)
{
  const auto list = np::maximum_distance(.02).minimum_region_size(50).point_map(First<Kernel>());
  Result<Kernel> r = {cloud, CGAL::Tandem::detect_planes(cloud, list.normal_map(Second<Kernel>())),
                      CGAL::Tandem::Shape_polygons_3<Kernel>()};
  r.areas = CGAL::Tandem::polygons(r.shapes, cloud, np::point_map(First<Kernel>()).one_for_each_plane(is_by_plane));
  return r;
}

// The cloud is the same in every kernel, and so are the polygons.
BOOST_AUTO_TEST_CASE(test_kernels)
{
  const auto box = make_box_cloud(400);
  const auto a = result_of<Epick>(make_pairs<Epick>(box));
  const auto b = result_of<CGAL::Simple_cartesian<double>>(make_pairs<CGAL::Simple_cartesian<double>>(box));
  CHECK(a.areas.points().size() == 8 && b.areas.points().size() == 8);
  for(std::size_t i = 0; i < a.areas.points().size(); ++i)
    for(int k = 0; k < 3; ++k)
      CHECK(a.areas.points()[i][k] == b.areas.points().at(i)[k]);
  const auto c = result_of<CGAL::Simple_cartesian<float>>(make_pairs<CGAL::Simple_cartesian<float>>(box));
  CHECK(c.areas.number_of_entries() == 6 && c.areas.points().size() == 8);
}

template <class Polygon>
double area_of(const Polygon& polygon)
{
  double result = CGAL::to_double(polygon.outer_boundary().area());
  for(auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole)
    result += CGAL::to_double(hole->area());
  return result;
}

BOOST_AUTO_TEST_CASE(test_frames)
{
  const auto r = result_of<Epick>(make_pairs<Epick>(make_box_cloud(400)));
  for(std::size_t i = 0; i < r.areas.number_of_entries(); ++i) {
    const auto frame = r.areas.frame(i);
    const auto polygons = r.areas.polygons_2(i);
    CHECK(polygons.size() == r.areas.polygons(i).size() && polygons.size() == 1);
    double flat = 0, in_space = 0;
    for(std::size_t p = 0; p < polygons.size(); ++p) {
      const auto& outer = polygons[p].outer_boundary();
      CHECK(outer.is_simple() && outer.is_counterclockwise_oriented());
      flat += area_of(polygons[p]);
      for(std::size_t k = 0; k < outer.size(); ++k) {
        const Epick::Point_3& corner = r.areas.points()[r.areas.polygons(i)[p].outer[k]];
        CHECK(frame.to_2d(corner) == outer[k]);
        CHECK(CGAL::squared_distance(frame.to_3d(outer[k]), corner) < 1e-28);
      }
    }
    for(const auto& t : r.areas.triangles(i))
      in_space += std::sqrt(CGAL::squared_area(r.areas.points()[t[0]], r.areas.points()[t[1]], r.areas.points()[t[2]]));
    double largest = 0;
    for(int k = 0; k < 3; ++k)
      largest = (std::max)(largest, std::fabs(r.shapes.coefficients(i)[std::size_t(k)]));
    CHECK_AT(std::fabs(r.areas.area(i) - in_space) < 1e-12, std::to_string(in_space));
    CHECK_AT(std::fabs(r.areas.area(i) * largest - flat) < 1e-12, std::to_string(flat));
  }
}

// Outer boundaries and triangles are counterclockwise about the normals of plane(), whatever the normals of the points are.
BOOST_AUTO_TEST_CASE(test_orientation)
{
  for(const double side : {1, -1}) {
    auto cloud = make_pairs<Epick>(make_box_cloud(400));
    for(auto& item : cloud)
      item.second = side * item.second;
    const auto r = result_of<Epick>(cloud);
    std::size_t flipped = 0;
    for(std::size_t i = 0; i < r.areas.number_of_entries(); ++i) {
      flipped += r.shapes.is_flipped(i);
      const auto& p = r.areas.points();
      const Epick::Vector_3 normal = r.shapes.plane(i).orthogonal_vector();
      for(const auto& t : r.areas.triangles(i))
        CHECK(CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]) * normal > 0);
      Epick::Vector_3 area = CGAL::NULL_VECTOR;
      const auto& outer = r.areas.polygons(i).at(0).outer;
      for(std::size_t k = 1; k + 1 < outer.size(); ++k)
        area = area + CGAL::cross_product(p[outer[k]] - p[outer[0]], p[outer[k + 1]] - p[outer[0]]);
      CHECK(area * normal > 0);
    }
    CHECK_AT(flipped == 3, std::to_string(flipped));
  }
}

// Two squares of one plane, as one entry or as two.
BOOST_AUTO_TEST_CASE(test_planes)
{
  Pairs<Epick> cloud;
  std::mt19937 random(3);
  for(int i = 0; i < 2000; ++i)
    cloud.emplace_back(Epick::Point_3(random_unit(random) + (i % 2 ? 3 : 0), random_unit(random), 0),
                       Epick::Vector_3(0, 0, 1));
  const auto by_shape = result_of<Epick>(cloud), by_plane = result_of<Epick>(cloud, true);
  CHECK(by_shape.areas.number_of_entries() == 2 && by_plane.areas.number_of_entries() == 1);
  CHECK(by_plane.areas.polygons(0).size() == 2);
  const double sum = by_shape.areas.area(0) + by_shape.areas.area(1);
  CHECK_AT(std::fabs(by_plane.areas.area(0) / sum - 1) < .02, std::to_string(sum));
}

// Entries are counted that have no polygon: one of eight points.
BOOST_AUTO_TEST_CASE(test_empty)
{
  const auto r = result_of<Epick>(make_pairs<Epick>(make_box_cloud(400)));
  CHECK(r.areas.number_of_empty_entries() == 0 && !r.areas.is_empty(0));
  auto data = r.shapes.data();
  std::vector<std::int32_t> labels(data.shape_of.begin(), data.shape_of.end());
  for(std::size_t i = 8; i < r.shapes.points(0).size(); ++i)
    labels[r.shapes.points(0)[i]] = -1;
  data.shape_of = std::move(labels);
  data.size[0] = 8;
  const auto areas =
    CGAL::Tandem::polygons(CGAL::Tandem::Planar_shapes_3<Epick>(data), r.cloud, np::point_map(First<Epick>()));
  CHECK(areas.number_of_entries() == 6 && areas.number_of_empty_entries() == 1 && areas.is_empty(0));
}

// Another order of the range, and points that are not finite; projected points are accepted, also in `float`.
template <class Kernel>
void check_points_of()
{
  const auto r = result_of<Kernel>(make_pairs<Kernel>(make_box_cloud(400)));
  const auto map = np::point_map(First<Kernel>());
  auto other = r.cloud;
  std::reverse(other.begin(), other.end());
  CHECK(throws<std::invalid_argument>([&] { CGAL::Tandem::polygons(r.shapes, other, map); }));
  CHECK(throws<std::invalid_argument>([&] { CGAL::Tandem::closed_surface(r.shapes, other, map); }));
  using FT = typename Kernel::FT;
  for(const FT value : {std::numeric_limits<FT>::quiet_NaN(), std::numeric_limits<FT>::infinity()}) {
    other = r.cloud;
    other[r.shapes.points(2)[0]].first = typename Kernel::Point_3(FT(0), value, FT(0));
    CHECK(throws<std::invalid_argument>([&] { CGAL::Tandem::polygons(r.shapes, other, map); }));
  }
  other = r.cloud;
  for(std::size_t s = 0; s < r.shapes.number_of_shapes(); ++s)
    for(std::size_t i : r.shapes.points(s))
      other[i].first = r.shapes.plane(s).projection(other[i].first);
  const auto areas = CGAL::Tandem::polygons(r.shapes, other, map);
  CHECK(areas.number_of_entries() == 6 && areas.number_of_empty_entries() == 0);
}

BOOST_AUTO_TEST_CASE(test_refused)
{
  const auto r = result_of<Epick>(make_pairs<Epick>(make_box_cloud(400)));
  const auto map = np::point_map(First<Epick>());
  const Pairs<Epick> fewer(r.cloud.begin(), r.cloud.end() - 1);
  CHECK(throws<std::invalid_argument>([&] { CGAL::Tandem::polygons(r.shapes, fewer, map); }));
  auto data = r.shapes.data();
  ++data.size[0]; // a point of another process
  const CGAL::Tandem::Planar_shapes_3<Epick> part(data);
  CHECK(throws<std::logic_error>([&] { CGAL::Tandem::polygons(part, r.cloud, map); }));
  check_points_of<Epick>();
  check_points_of<CGAL::Simple_cartesian<float>>();
  const std::vector<Epick::Point_3> none;
  CHECK(CGAL::Tandem::polygons(CGAL::Tandem::Planar_shapes_3<Epick>(), none).number_of_entries() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
