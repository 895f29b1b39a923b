// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measuring itself, on cases counted by hand: a criterion that is wrong would make every comparison with other
// detectors wrong.

#include "testing/checks.h"

#include "scenes/scenes.h"
#include "testing/evaluate_truth.h"
#include "testing/fit_plane.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(test_criteria)

namespace scenes = CGAL::Tandem::scenes;
using namespace CGAL::Tandem::benchmark;

const auto within = boost::test_tools::tolerance(1e-12);
const double degrees = 57.29577951308232;

BOOST_AUTO_TEST_CASE(nearly_equal_planes_are_one)
{
  const auto check = [](const std::vector<Plane>& planes, const Vec& center, std::size_t directions, std::size_t size) {
    const Plane_relations relations(planes, 1, center);
    BOOST_TEST(relations.directions() == directions);
    BOOST_TEST(relations.planes() == size);
  };
  check({{{0, 0, 1}, 5}, {{0, 0, 1}, 5 + 1e-9}, {scenes::unit({1e-8, 0, 1}), 5}}, {0, 0, -5}, 1, 1);
  check({{{0, 0, 1}, 5}, {{0, 0, 1}, 5 + 1e-3}, {scenes::unit({1e-5, 0, 1}), 5}}, {0, 0, 0}, 2, 3);
  // The sign of a plane means nothing; that of the offset alone does.
  check({{{0, 0, 1}, 5}, {{0, 0, -1}, -5}, {{0, 0, -1}, 5}}, {0, 0, 0}, 1, 2);
  // Nor where the coordinate that gives the sign is nearly zero.
  check({{{1e-9, 0, 1}, 5}, {{-1e-9, 0, 1}, 5}}, {0, 0, 0}, 1, 1);
}

BOOST_AUTO_TEST_CASE(distances_and_angles)
{
  const std::vector<Vec> points = {{0, 0, 0.25}, {1, 0, -0.5}, {0, 1, 0.125}, {9, 9, 9}, {0, 0, 1}};
  const std::vector<Vec> normals = {{0, 0, 1}, {0, 0, -2}, {0, 3, 3}, {1, 0, 0}, {1, 0, 0}};
  Detection detection{{0, 0, 0, -1, 0}, {{{0, 0, 1}, 0}}};
  Criteria c = evaluate(points, normals, detection, {0.25, 44});
  BOOST_TEST(c.coverage() == 0.8, within);
  BOOST_TEST(c.mean_distance_in_epsilons == 7.5 / 4, within);
  BOOST_TEST(c.max_distance_in_epsilons == 4.0, within);
  BOOST_TEST(c.beyond_epsilon == 2u); // epsilon itself is allowed
  BOOST_TEST(c.beyond_alpha == 2u);
  BOOST_TEST(c.beyond_either == 3u); // a point counts once
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 45}).beyond_alpha == 1u);
  BOOST_TEST(evaluate(points, {}, detection, {0.25, 1}).beyond_alpha == 0u);
  // NaN is never within a tolerance.
  detection.planes[0].offset = std::nan("");
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 44}).beyond_epsilon == 4u);
  // Georeferenced points are not beyond epsilon by rounding.
  const Vec n = scenes::unit({1, 2, 2.5}), far{588295.1, 3781800.3, 42.7};
  for(const double epsilon : {.1, .0999999})
    BOOST_TEST(evaluate({far}, {}, {{0}, {{n, .1 - dot(n, far)}}}, {epsilon, 25}).beyond_epsilon == (epsilon < .1));
}

BOOST_AUTO_TEST_CASE(tables_that_do_not_fit_are_refused)
{
  const std::vector<Vec> points = {{0, 0, 0}, {1, 0, 0}};
  const std::vector<Plane> planes = {{{0, 0, 1}, 0}};
  const Detection right = {{0, 0}, planes};
  for(const std::vector<std::int32_t>& label : {std::vector<std::int32_t>{0}, {0, 1}, {0, -2}})
    BOOST_CHECK_THROW(evaluate(points, {}, {label, planes}, {1, 25}), std::runtime_error);
  BOOST_CHECK_THROW(evaluate_truth({{0}, planes}, right, {1, {0, 0, 0}}, 1), std::runtime_error);
  BOOST_TEST(evaluate({}, {}, {{}, {}}, {1, 25}).relations.complexity == 0);
}

// Points at given heights, upright, with a label each.
struct Case {
  std::vector<Vec> points, normals;
  Detection detection;

  void add(int n, double height, std::int32_t label, const Vec& normal = {0, 0, 1})
  {
    for(int i = 0; i < n; ++i) {
      points.push_back({double(points.size()), 0, height});
      normals.push_back(normal);
      detection.label.push_back(label);
    }
  }

  Curves curves() const { return evaluate_curves(points, normals, detection, {.25, 30}); }
};

// 100 points: 50 and 20 in one plane across a gap, 20 in a parallel one, 10 free. Then as many as these are beyond
// epsilon or alpha, and count for no detector.
BOOST_AUTO_TEST_CASE(curves_of_the_largest)
{
  Case c;
  c.add(20, 0, 0);
  c.add(50, 0, 1);
  c.add(20, 2, 2);
  c.add(10, 9, -1);
  c.detection.planes = {{{0, 0, 1}, 0}, {{0, 0, -1}, 0}, {{0, 0, 1}, -2}, {{1, 0, 0}, 0}}; // the last has no points
  const Curves curves = c.curves();
  BOOST_TEST(curves.shapes.size() == 3u);
  const double top[] = {0, .5, .7, .9, .9};
  for(std::size_t n = 0; n < 5; ++n)
    BOOST_TEST(curves.shapes.top(n) == top[n], within);
  BOOST_TEST(curves.planes.size() == 2u);
  BOOST_TEST(curves.planes.top(1) == .7, within);
  for(const auto& [i, freedom] : {std::make_pair(0, 3u), {1, 3u}, {3, 4u}})
    BOOST_TEST(curves.needed[i].degrees_of_freedom == freedom);
  c.add(60, .26, 1);
  c.add(40, 2, 2, {0, 1, 1});
  const Curves half = c.curves();
  BOOST_TEST(half.shapes.top(1) == .25, within);
  BOOST_TEST(half.shapes.top(3) == .45, within);
  BOOST_TEST(half.needed[0].degrees_of_freedom == 0u); // 45 % are not 50 %
  c.normals.clear();
  BOOST_TEST(c.curves().shapes.top(1) == .3, within);
}

// Planes that nearly agree are one, if nine tenths of the points of the smaller shape fit the plane of the larger one.
BOOST_AUTO_TEST_CASE(planes_are_distinct_by_their_points)
{
  for(int misfits : {1, 2}) {
    Case c;
    c.add(30, 0, 0);
    c.add(10 - misfits, .2, 1);
    c.add(misfits, .3, 1);
    c.detection.planes = {{{0, 0, 1}, 0}, {{0, 0, 1}, -.25}};
    BOOST_TEST(c.curves().planes.size() == std::size_t(misfits));
  }
}

BOOST_AUTO_TEST_CASE(pairs_of_a_cube)
{
  const scenes::Scene scene = scenes::make_scene("cube", {6000});
  Detection truth{scene.label, {}};
  for(const scenes::Truth_face& f : scene.faces)
    truth.planes.push_back({f.normal, f.offset});
  Detection detection = truth;
  // Where the normal of the first plane is this one.
  const auto check = [&](const Vec& normal, std::size_t false_parallels, double angle) {
    detection.planes[0].normal = normal;
    const Truth_criteria t = evaluate_truth({truth.label, truth.planes}, detection, extent_of(scene.points), 100);
    BOOST_TEST(t.point_precision == 1.0, within);
    BOOST_TEST(t.face_f1 == 1.0, within);
    BOOST_TEST(t.pairs == 15u);
    BOOST_TEST(t.false_parallels == false_parallels);
    BOOST_TEST(std::abs(t.angle_error_deg - angle) < 1e-6);
  };
  check(truth.planes[0].normal, 0, 0);
  check(scenes::unit({1, 0.01, 0}), 0, std::atan(0.01) * degrees / 6);
  check(truth.planes[2].normal, 2, 15);
}

// Halves have an intersection over union of one half, and none is a face. Outliers, and faces that are too small.
BOOST_AUTO_TEST_CASE(halves_outliers_and_small_faces)
{
  const std::vector<Plane> faces = {{{0, 0, 1}, 0}, {{1, 0, 0}, 0}};
  const auto compare = [&](const std::vector<std::int32_t>& truth, const Detection& detection, std::size_t smallest) {
    return evaluate_truth({truth, faces}, detection, {1, {0, 0, 0}}, smallest);
  };
  Truth_criteria t =
    compare({0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 2, 2, 1, 1, 3, 3}, {faces[0], faces[1], faces[0], faces[1]}}, 1);
  BOOST_TEST(t.shapes_matched == 0u);
  BOOST_TEST(t.face_f1 == 0.0);
  BOOST_TEST(t.point_precision == 1.0, within);
  t = compare({0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 0, 0, 1, 1, 2, 2}, {faces[0], faces[1], faces[1]}}, 1);
  BOOST_TEST(t.face_f1 == .4, within); // precision 1 of 3, recall 1 of 2
  t = compare({0, 0, 0, 0, 1, 1, -1, -1}, {{0, 0, 0, -1, 1, 1, 0, -1}, faces}, 3);
  BOOST_TEST(t.faces == 1u);
  BOOST_TEST(t.top_10_faces == .75, within);
  BOOST_TEST(t.point_precision == 5.0 / 6, within);
  BOOST_TEST(t.shapes_matched == 2u);
  BOOST_TEST(t.face_f1 == 1.0, within);
}

// Distances to z = 2 x + 1 of +-d in turn: the fit is that plane, and the third label has too few points.
BOOST_AUTO_TEST_CASE(planes_are_fitted_to_labels)
{
  std::vector<Vec> points = {{0, 0, 0}, {7, 7, 7}, {9, 9, 9}};
  std::vector<std::int32_t> label = {2, 2, -1};
  for(int i = 0; i < 4; ++i)
    for(int j = 0; j < 4; ++j)
      for(double d : {-0.01, 0.01}) {
        points.insert(points.end(), {{double(i), double(j), 2.0 * i + 1 + d}, {5 + d, double(i), double(j)}});
        label.insert(label.end(), {1, 0});
      }
  const std::vector<Plane> planes = fit_planes(points, label, 3);
  const auto check = [&](std::size_t s, const Vec& normal, const Vec& at, double sine) {
    BOOST_TEST(length(cross(planes[s].normal, scenes::unit(normal))) < sine);
    BOOST_TEST(std::abs(dot(planes[s].normal, at) + planes[s].offset) < 1e-12);
  };
  check(0, {1, 0, 0}, {5, 0, 0}, 1e-12);
  check(1, {2, 0, -1}, {1.5, 1.5, 4}, 1e-5);
  check(2, {0, 0, 1}, {0, 0, 0}, 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
