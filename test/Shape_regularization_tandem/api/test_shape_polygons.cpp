// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// polygons() as a user calls it: kernels, entries of planes, frames, and what it refuses.

#include "api_support.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

BOOST_AUTO_TEST_SUITE(test_shape_polygons)

using CGAL::Tandem::polygons;

struct Result {
  Cloud cloud;
  Shapes shapes = detect(cloud, make_parameters(.02, 50));

  auto areas(bool is_by_plane = false) const
  {
    return polygons(shapes, cloud, positions.one_for_each_plane(is_by_plane));
  }
};

// Outer boundaries and triangles are counterclockwise about the normals of plane(), whatever the normals of the points
// are. Areas are those of the triangles, and, by their frames, those of the flat polygons.
BOOST_AUTO_TEST_CASE(test_frames)
{
  for(const double sign : {1, -1}) {
    Result r = {make_box(400)};
    for(auto& item : r.cloud)
      item.second = sign * item.second;
    r.shapes = detect(r.cloud, make_parameters(.02, 50));
    const auto areas = r.areas();
    const auto& p = areas.points();
    CHECK(areas.number_of_entries() == 6 && areas.number_of_empty_entries() == 0 && p.size() == 8);
    std::size_t flipped = 0;
    for(std::size_t i = 0; i < areas.number_of_entries(); ++i) {
      flipped += r.shapes.is_flipped(i);
      const auto frame = areas.frame(i);
      const auto polygon = areas.polygons_2(i).at(0).outer_boundary();
      CHECK(areas.polygons_2(i).size() == 1 && areas.polygons(i).size() == 1);
      CHECK(polygon.is_simple() && polygon.is_counterclockwise_oriented());
      for(std::size_t k = 0; k < polygon.size(); ++k) {
        const Kernel::Point_3& vertex = p[areas.polygons(i)[0].outer[k]];
        CHECK(frame.to_2d(vertex) == polygon[k] && CGAL::squared_distance(frame.to_3d(polygon[k]), vertex) < 1e-28);
      }
      const Kernel::Vector_3 normal = r.shapes.plane(i).orthogonal_vector();
      double area = 0;
      for(const auto& t : areas.triangles(i)) {
        const double twice = CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]) * normal;
        CHECK(twice > 0);
        area += twice / 2;
      }
      const double shrinkage = (std::max)({std::fabs(normal.x()), std::fabs(normal.y()), std::fabs(normal.z())});
      check_close(areas.area(i), area, 1e-12, "area");
      check_close(areas.area(i) * shrinkage, polygon.area(), 1e-12, "flat area");
    }
    CHECK_AT(flipped == 3, std::to_string(flipped));
  }
}

// Two squares of one plane, as one entry or as two. Entries are counted that have no polygon: one of eight points.
BOOST_AUTO_TEST_CASE(test_entries)
{
  Cloud cloud;
  scenes::Random random(3);
  for(int i = 0; i < 2000; ++i)
    add(cloud, {random.uniform() + (i % 2 ? 3 : 0), random.uniform(), 0}, {0, 0, 1});
  const Result r = {cloud};
  const auto by_shape = r.areas(), by_plane = r.areas(true);
  CHECK(by_shape.number_of_entries() == 2 && by_plane.number_of_entries() == 1 && by_plane.polygons(0).size() == 2);
  const double sum = by_shape.area(0) + by_shape.area(1);
  check_close(by_plane.area(0), sum, .02 * sum, "area of both");
  auto data = r.shapes.data();
  std::vector<std::int32_t> labels(data.shape_of.begin(), data.shape_of.end());
  for(std::size_t i = 8; i < r.shapes.points(0).size(); ++i)
    labels[r.shapes.points(0)[i]] = -1;
  data.shape_of = std::move(labels);
  data.size[0] = 8;
  const auto areas = polygons(Shapes(data), cloud, positions);
  CHECK(areas.number_of_entries() == 2 && areas.number_of_empty_entries() == 1);
  CHECK(areas.is_empty(0) && !areas.is_empty(1));
}

// Projected points are accepted, also in `float`. Points of other coordinates, or others in number, are not.
BOOST_AUTO_TEST_CASE(test_points_of_shapes)
{
  using Float = CGAL::Simple_cartesian<float>;
  const Result r = {make_box(400)};
  const CGAL::Tandem::Planar_shapes_3<Float> shapes(r.shapes.data());
  std::vector<Float::Point_3> floats;
  for(std::size_t i = 0; i < r.cloud.size(); ++i) {
    const auto& p = r.cloud[i].first;
    const Float::Point_3 q(float(p.x()), float(p.y()), float(p.z()));
    const int s = r.shapes.shape_index(i);
    floats.push_back(s < 0 ? q : shapes.plane(std::size_t(s)).projection(q));
  }
  CHECK(polygons(shapes, floats).number_of_entries() == 6 && polygons(shapes, floats).number_of_empty_entries() == 0);
  const auto refuses = [&](const Shapes& of, const Cloud& cloud) {
    return throws<std::invalid_argument>([&] { polygons(of, cloud, positions); });
  };
  CHECK(!refuses(r.shapes, r.cloud) && refuses(r.shapes, Cloud(r.cloud.begin(), r.cloud.end() - 1)));
  const Cloud reversed(r.cloud.rbegin(), r.cloud.rend());
  CHECK(refuses(r.shapes, reversed));
  CHECK_REFUSED(CGAL::Tandem::closed_surface(r.shapes, reversed, positions), "");
  for(const double wrong : {not_a_number, infinity}) {
    Cloud other = r.cloud;
    other[r.shapes.points(2)[0]].first = {0, wrong, 0};
    CHECK(refuses(r.shapes, other));
  }
  auto data = r.shapes.data();
  ++data.size[0]; // a point of another process
  CHECK(throws<std::logic_error>([&] { polygons(Shapes(data), r.cloud, positions); }));
  CHECK(polygons(Shapes(), Cloud(), positions).number_of_entries() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
