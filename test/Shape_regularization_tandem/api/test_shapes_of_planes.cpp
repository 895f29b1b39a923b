// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A result of known planes: those of a detection, and planes with all relations.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_shapes_of_planes)

using CGAL::Tandem::Coefficients;
using CGAL::Tandem::join_coplanar_shapes;
using CGAL::Tandem::label_points;
using CGAL::Tandem::select_shapes;
using CGAL::Tandem::shapes_of_planes;

namespace np = CGAL::Tandem::parameters;
const auto maps = np::point_map(First<Kernel>()).normal_map(Second<Kernel>());

// The planes of a detection give the same planes, relations and numbers, and the labels of label_points().
BOOST_AUTO_TEST_CASE(check_planes_of_detection)
{
  const scenes::Scene scene = make_scene("indoor", scene_options(8000, .0005, .1));
  const Cloud cloud = to_cloud(scene);
  const Shapes detected = detect_valid("indoor", cloud, make_parameters(.002 * scene.diagonal, 50));
  const auto list = maps.settings(detected.parameters());
  const Shapes known = shapes_of_planes(detected.data().coefficients, cloud, list);
  check_same_planes(detected, known, "indoor");
  const std::vector<std::int32_t> labels = label_points(detected, cloud, maps);
  CHECK(std::equal(labels.begin(), labels.end(), known.shape_indices().begin()));
  const CGAL::Tandem::Statistics &t = known.statistics(), &d = detected.statistics();
  std::size_t assigned = 0;
  double distances = 0;
  for(std::size_t s = 0; s < known.number_of_shapes(); ++s) {
    CHECK_AT(known.points(s).size() == known.size(s), std::to_string(s));
    assigned += known.size(s);
    for(std::size_t i : known.points(s)) {
      const Coefficients& c = known.coefficients(s);
      const Kernel::Point_3& p = cloud[i].first;
      distances += std::fabs(c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3]);
    }
  }
  check_equal(t.number_of_assigned_points, assigned, "assigned");
  check_equal(t.free_points.total(), cloud.size() - assigned, "free");
  check_equal(t.degrees_of_freedom, d.degrees_of_freedom, "degrees of freedom");
  check_close(t.mean_distance, distances / double(assigned), 1e-12, "mean distance");
  CHECK(t.coverage >= d.coverage); // planes have no end
}

// Points on the planes x = 0, z = 0 and z = 1, with their normals.
Cloud make_corner()
{
  Cloud cloud;
  for(int i = 1; i < 20; ++i)
    for(int j = 1; j < 20; ++j) {
      add(cloud, {0, i / 20., j / 20.}, {-1, 0, 0});
      add(cloud, {i / 20., j / 20., 0}, {0, 0, 1});
      add(cloud, {i / 20., j / 20., 1}, {0, 0, 1});
    }
  return cloud;
}

BOOST_AUTO_TEST_CASE(check_relations)
{
  const Cloud cloud = make_corner();
  const std::vector<Coefficients> planes = {{0, 0, 2, 0}, {-3, 0, 0, 0}, {0, 0, -1, 1},
                                            {0, 0, 1, 0}, {0, 0, 1, -5}, {1, 0, 0, -0.}};
  const Shapes shapes = shapes_of_planes(planes, cloud, maps.maximum_distance(.01));
  const std::vector<Coefficients> expected = {{0, 0, 1, 0}, {-1, 0, 0, 0}, {0, 0, 1, -1},
                                              {0, 0, 1, 0}, {0, 0, 1, -5}, {-1, 0, 0, 0}};
  CHECK(shapes.data().coefficients == expected);
  CHECK(shapes.data().parallel_group == std::vector<int>({0, 1, 0, 0, 0, 1}));
  CHECK(shapes.data().coplanar_group == std::vector<int>({0, 1, 2, 0, 3, 1}));
  CHECK(shapes.are_orthogonal(0, 1) && shapes.orthogonal_groups().size() == 1);
  CHECK(shapes.data().size == std::vector<std::size_t>({361, 361, 361, 0, 0, 0}));
  CHECK(!shapes.is_flipped(0) && !shapes.is_flipped(1) && !shapes.is_flipped(2));
  check_close(shapes.uncertainty(2).centroid[2], 1, 1e-12, "centroid");
  const auto areas = polygons(shapes, cloud, maps);
  CHECK(areas.number_of_entries() == 6 && areas.number_of_empty_entries() == 3);
  check_close(areas.area(2), .95 * .9, .03, "area"); // it is straight at the plane of the wall
}

// Known planes have no score, and get none where they are selected or joined.
BOOST_AUTO_TEST_CASE(check_score)
{
  const Cloud cloud = make_corner();
  const Shapes shapes = shapes_of_planes({{0, 0, 1, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}}, cloud, maps.maximum_distance(.01));
  for(const Shapes& s :
      {shapes, join_coplanar_shapes(shapes, cloud, maps), select_shapes(shapes, std::vector<int>{2, 1, 0}),
       select_shapes(shapes, std::vector<int>{0})}) {
    const CGAL::Tandem::Result_score& score = s.statistics().score;
    CHECK(score.fit == 0 && score.links == 0 && score.size == 0 && score.price == 0 && score.freedom == 0);
  }
}

// Lengths of normals whose squares overflow or vanish change no plane.
BOOST_AUTO_TEST_CASE(check_extreme_planes)
{
  const Cloud cloud = make_corner();
  const Shapes shapes =
    shapes_of_planes({{1e308, 1e308, 0, 0}, {0, 0, 1e-310, 0}, {0, 1e-310, 0, 1e-310}}, cloud, maps);
  check_close(shapes.coefficients(0)[0], std::sqrt(.5), 1e-15, "of a large normal");
  CHECK(shapes.coefficients(1) == Coefficients({0, 0, 1, 0}) && shapes.coefficients(2) == Coefficients({0, 1, 0, 1}));
}

BOOST_AUTO_TEST_CASE(check_notes)
{
  const Shapes shapes = shapes_of_planes({{0, 0, 1, 0}}, make_corner(), maps.maximum_angle(.9));
  CHECK(shapes.statistics().angle_note == CGAL::Tandem::angle_note(shapes.parameters()));
  CHECK(!shapes.statistics().angle_note.empty());
}

// Without normals only distances count, and there are none to be asked for.
BOOST_AUTO_TEST_CASE(check_without_normals)
{
  const Cloud cloud = make_corner();
  const auto positions = np::point_map(First<Kernel>());
  const Shapes shapes = shapes_of_planes({{0, 1, 0, -.5}}, cloud, positions.maximum_distance(.01));
  check_equal(shapes.size(0), std::size_t(57), "points of a section");
  CHECK(!shapes.has_estimated_normals());
  CHECK(shapes.hash() == Shapes::hash(shapes.shape_indices(), shapes.data().coefficients)); // of no normals
  check_equal(shapes_of_planes({{0, 1, 0, -.5}}, cloud, maps.maximum_distance(.01)).size(0), std::size_t(0),
              "points with other normals");
  CHECK(shapes_of_planes({{0, 1, 0, 0}}, Cloud(), positions).number_of_points() == 0);
  CHECK(shapes_of_planes({}, cloud, positions).number_of_shapes() == 0);
}

BOOST_AUTO_TEST_CASE(check_refusals)
{
  const Cloud cloud = make_corner();
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for(const Coefficients& c : {Coefficients{0, 0, 0, 1},
                               {0, nan, 1, 0},
                               {0, 0, infinity, 0},
                               {0, 0, 1, nan},
                               {0, 0, 1, infinity},
                               {0, 0, 1e-310, 5}})
    check_throws<std::invalid_argument>(
      [&] {
        shapes_of_planes({{0, 0, 1, 0}, c}, cloud, maps);
      },
      {"Plane 1", "not null"}, __LINE__);
  check_throws<std::invalid_argument>([&] { shapes_of_planes({}, cloud, maps.maximum_distance(-1)); },
                                      {"maximum_distance"}, __LINE__);
}

BOOST_AUTO_TEST_SUITE_END()
