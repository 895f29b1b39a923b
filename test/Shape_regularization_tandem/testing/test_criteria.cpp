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

std::vector<Plane> planes_with_normals(const std::vector<Vec>& normals)
{
  std::vector<Plane> planes;
  planes.reserve(normals.size());
  for(const Vec& n : normals)
    planes.push_back({scenes::unit(n), double(planes.size())});
  return planes;
}

std::size_t degrees_of_freedom(const std::vector<Vec>& normals)
{
  return Plane_relations(planes_with_normals(normals), relaxed_relations(1, {0, 0, 0})).degrees_of_freedom();
}

scenes::Scene sample(const std::string& name, std::size_t points = 6000)
{
  scenes::Options options;
  options.points = points;
  return scenes::make_scene(name, options);
}

Detection perfect(const scenes::Scene& scene)
{
  Detection detection{scene.label, {}};
  for(const scenes::Truth_face& f : scene.faces)
    detection.planes.push_back({f.normal, f.offset});
  return detection;
}

BOOST_AUTO_TEST_CASE(cube_has_complexity_9_of_18)
{
  const scenes::Scene scene = sample("cube");
  Criteria c = evaluate(scene.points, scene.normals, perfect(scene), {0.01, 25});
  BOOST_TEST(c.shapes == 6u);
  BOOST_TEST(c.relations.directions == 3u);
  BOOST_TEST(c.relations.planes == 6u);
  BOOST_TEST(c.relations.degrees_of_freedom == 3u);
  BOOST_TEST(c.relations.complexity == 9.0 / 18, within);
  BOOST_TEST(c.coverage() == 1.0, within);
  BOOST_TEST(c.beyond_epsilon == 0u);
  BOOST_TEST(c.beyond_alpha == 0u);
}

// Two shapes a face, in one plane or in two: complexity falls where nothing was gained, so it is read with shapes.
BOOST_AUTO_TEST_CASE(cube_of_twelve_halves)
{
  std::vector<Plane> planes;
  for(int half = 0; half < 2; ++half)
    for(double side : {-0.5, 0.5})
      for(const Vec& n : {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}})
        planes.push_back({n, side});
  Plane_relations halves(planes, relaxed_relations(1, {0, 0, 0}));
  BOOST_TEST(halves.directions() == 3u);
  BOOST_TEST(halves.planes() == 6u);
  BOOST_TEST(halves.complexity() == 9.0 / 36, within);
  for(std::size_t s = 6; s < 12; ++s)
    planes[s].offset += 1e-3;
  BOOST_TEST(Plane_relations(planes, relaxed_relations(1, {0, 0, 0})).complexity() == 15.0 / 36, within);
}

BOOST_AUTO_TEST_CASE(degrees_of_freedom_of_directions)
{
  BOOST_TEST(degrees_of_freedom({}) == 0u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}}) == 2u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {0, 0, -1}}) == 2u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {0, 1, 1}}) == 4u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {1, 0, 0}}) == 3u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}) == 3u);
  // A master with two followers that are not orthogonal; the master need not come first.
  BOOST_TEST(degrees_of_freedom({{1, 0, 0}, {3, 4, 0}, {0, 0, 1}}) == 4u);
  // The paper's two frames that share the vertical: 2 + 1 + 1.
  BOOST_TEST(degrees_of_freedom({{1, 0, 0}, {0, 1, 0}, {3, 4, 0}, {-4, 3, 0}, {0, 0, 1}}) == 4u);
  // The vertical, which comes after three masters, has nothing left to lose: 2 + 1 + 2 + 0, 1 + 0, 1 + 0, 1 + 1 + 1.
  BOOST_TEST(degrees_of_freedom({{1, 0, 0},
                                 {0, 1, 0},
                                 {3, 4, 0},
                                 {0, 0, 1},
                                 {0, 3, 4},
                                 {0, -4, 3},
                                 {3, 0, 4},
                                 {-4, 0, 3},
                                 {-4, 3, 5},
                                 {-4, 3, -2},
                                 {-4, 3, 1}}) == 10u);
}

BOOST_AUTO_TEST_CASE(nearly_equal_planes_are_one)
{
  const auto relations = [](const std::vector<Plane>& planes, const Vec& center) {
    return Plane_relations(planes, relaxed_relations(1, center));
  };
  const std::vector<Plane> planes = {{{0, 0, 1}, 5}, {{0, 0, 1}, 5 + 1e-9}, {scenes::unit({1e-8, 0, 1}), 5}};
  BOOST_TEST(relations(planes, {0, 0, -5}).directions() == 1u);
  BOOST_TEST(relations(planes, {0, 0, -5}).planes() == 1u);
  // The sign of a plane means nothing; that of the offset alone does.
  const std::vector<Plane> signs = {{{0, 0, 1}, 5}, {{0, 0, -1}, -5}, {{0, 0, -1}, 5}};
  BOOST_TEST(relations(signs, {0, 0, 0}).directions() == 1u);
  BOOST_TEST(relations(signs, {0, 0, 0}).planes() == 2u);
  // Nor where the coordinate that gives the sign is nearly zero.
  BOOST_TEST(relations({{{1e-9, 0, 1}, 5}, {{-1e-9, 0, 1}, 5}}, {0, 0, 0}).planes() == 1u);
  BOOST_TEST(relations({{{0, 0, 1}, 0}, {scenes::unit({1e-5, 0, 1}), 0}}, {0, 0, 0}).directions() == 2u);
}

BOOST_AUTO_TEST_CASE(distances_and_angles)
{
  std::vector<Vec> points = {{0, 0, 0.25}, {1, 0, -0.5}, {0, 1, 0.125}, {9, 9, 9}};
  std::vector<Vec> normals = {{0, 0, 1}, {0, 0, -2}, {0, 3, 3}, {1, 0, 0}};
  Detection detection{{0, 0, 0, -1}, {{{0, 0, 1}, 0}}};
  Criteria c = evaluate(points, normals, detection, {0.25, 44});
  BOOST_TEST(c.assigned == 3u);
  BOOST_TEST(c.coverage() == 0.75, within);
  BOOST_TEST(c.mean_distance_in_epsilons == 3.5 / 3, within);
  BOOST_TEST(c.max_distance_in_epsilons == 2.0, within);
  BOOST_TEST(c.beyond_epsilon == 1u); // epsilon itself is allowed
  BOOST_TEST(c.beyond_alpha == 1u);
  BOOST_TEST(c.beyond_either == 2u);
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 45}).beyond_alpha == 0u);
  BOOST_TEST(evaluate(points, {}, detection, {0.25, 1}).beyond_alpha == 0u);
  Criteria far_and_turned = evaluate({{0, 0, 1}}, {{1, 0, 0}}, {{0}, detection.planes}, {0.25, 44});
  BOOST_TEST(far_and_turned.beyond_epsilon == 1u);
  BOOST_TEST(far_and_turned.beyond_alpha == 1u);
  BOOST_TEST(far_and_turned.beyond_either == 1u); // a point counts once
  // NaN is never within a tolerance.
  detection.planes[0].offset = std::nan("");
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 44}).beyond_epsilon == 3u);
}

BOOST_AUTO_TEST_CASE(georeferenced_points_are_not_beyond_epsilon_by_rounding)
{
  Vec n = scenes::unit({1, 2, 2.5}), far{588295.1, 3781800.3, 42.7};
  Plane plane{n, 0.1 - dot(n, far)};
  Criteria c = evaluate({far}, {}, {{0}, {plane}}, {0.1, 25});
  BOOST_TEST(c.beyond_epsilon == 0u);
  c = evaluate({far}, {}, {{0}, {plane}}, {0.0999999, 25});
  BOOST_TEST(c.beyond_epsilon == 1u);
}

BOOST_AUTO_TEST_CASE(files_that_do_not_fit_are_refused)
{
  std::vector<Vec> points = {{0, 0, 0}, {1, 0, 0}};
  std::vector<Plane> planes = {{{0, 0, 1}, 0}};
  BOOST_CHECK_THROW(evaluate(points, {}, {{0}, planes}, {1, 25}), std::runtime_error);
  BOOST_CHECK_THROW(evaluate(points, {}, {{0, 1}, planes}, {1, 25}), std::runtime_error);
  BOOST_CHECK_THROW(evaluate(points, {}, {{0, -2}, planes}, {1, 25}), std::runtime_error);
  BOOST_TEST(evaluate({}, {}, {{}, {}}, {1, 25}).relations.complexity == 0);
}

// The curves of the largest shapes and planes.
const Tolerances tolerances = {.25, 30};

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

  Curves curves() const { return evaluate_curves(points, normals, detection, tolerances); }
};

// 100 points: 50 and 20 in one plane across a gap, 20 in a parallel one, 10 free.
Case floors()
{
  Case c;
  c.add(20, 0, 0);
  c.add(50, 0, 1);
  c.add(20, 2, 2);
  c.add(10, 9, -1);
  c.detection.planes = {{{0, 0, 1}, 0}, {{0, 0, -1}, 0}, {{0, 0, 1}, -2}};
  return c;
}

BOOST_AUTO_TEST_CASE(largest_first)
{
  const Curves curves = floors().curves();
  BOOST_TEST(curves.shapes.size() == 3u);
  BOOST_TEST(curves.shapes.top(0) == 0., within);
  BOOST_TEST(curves.shapes.top(1) == .5, within);
  BOOST_TEST(curves.shapes.top(2) == .7, within);
  BOOST_TEST(curves.shapes.top(99) == .9, within);
  BOOST_TEST(curves.planes.size() == 2u);
  BOOST_TEST(curves.planes.top(1) == .7, within);
}

BOOST_AUTO_TEST_CASE(freedom_for_a_coverage)
{
  const Curves curves = floors().curves();
  BOOST_TEST(curves.needed[0].degrees_of_freedom == 3u);
  BOOST_TEST(curves.needed[1].degrees_of_freedom == 3u);
  BOOST_TEST(curves.needed[3].degrees_of_freedom == 4u);
  Case few = floors();
  few.add(100, 9, -1);
  BOOST_TEST(few.curves().needed[0].degrees_of_freedom == 0u); // 45 % are not 50 %
}

// Points beyond epsilon or alpha count for no detector.
BOOST_AUTO_TEST_CASE(misfits_do_not_count)
{
  Case c = floors();
  c.add(60, .26, 1);
  c.add(30, 2, 2, {0, 1, 1});
  c.add(10, 2.25, 2);
  const Curves curves = c.curves();
  BOOST_TEST(curves.shapes.top(1) == 50. / 200, within);
  BOOST_TEST(curves.shapes.top(2) == 80. / 200, within);
  BOOST_TEST(curves.shapes.top(3) == 100. / 200, within);
  Case without_normals = c;
  without_normals.normals.clear();
  BOOST_TEST(without_normals.curves().shapes.top(1) == 60. / 200, within);
  c.detection.planes.push_back({{1, 0, 0}, 0}); // without points
  BOOST_TEST(c.curves().shapes.size() == 3u);
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

// How far runs differ.
const std::vector<Plane> two_planes = {{{0, 0, 1}, 0}, {{1, 0, 0}, -1}};
const Detection first{{0, 0, 0, 0, 1, 1, 1, 1, -1, -1}, two_planes};

// Of the partition, and of the bits of the planes.
BOOST_AUTO_TEST_CASE(what_runs_have_in_common)
{
  Detection moved = first, tilted = first;
  moved.planes[1].offset = std::nextafter(-1.0, 0.0);
  tilted.planes[0].normal.y = 1e-300;
  const Detection renumbered{{1, 1, 1, 1, 0, 0, 0, 0, -1, -1}, {two_planes[1], two_planes[0]}};
  for(const auto& runs : std::vector<std::vector<Detection>>{
        {}, {first}, {first, first, first}, {first, moved}, {first, tilted}, {first, renumbered}}) {
    const Spread spread = evaluate_spread(runs);
    BOOST_TEST(spread.is_same == (runs.size() != 2));
    BOOST_TEST(spread.relabeled == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(moved_lost_and_gained_points_are_counted)
{
  Detection other = first;
  other.label[3] = 1;
  BOOST_TEST(share_relabeled(first, other) == 0.1, within);
  other.label[8] = 0;
  BOOST_TEST(share_relabeled(first, other) == 0.2, within);
  other.label[7] = -1;
  BOOST_TEST(share_relabeled(first, other) == 0.3, within);
}

BOOST_AUTO_TEST_CASE(a_split_shape_keeps_its_larger_part)
{
  Detection split{{2, 0, 0, 0, 1, 1, 1, 1, -1, -1}, {two_planes[0], two_planes[1], two_planes[0]}};
  Spread spread = evaluate_spread({first, split});
  BOOST_TEST(spread.relabeled == 0.1, within);
  // And a new shape of points that had none.
  Detection more{{0, 0, 0, 0, 1, 1, 1, 1, 2, 2}, {two_planes[0], two_planes[1], two_planes[0]}};
  spread = evaluate_spread({first, more, split});
  BOOST_TEST(spread.relabeled == 0.2, within);
}

BOOST_AUTO_TEST_CASE(runs_that_do_not_fit_are_refused)
{
  Detection shorter{{0, 1}, two_planes}, unknown = first;
  unknown.label[0] = 2;
  BOOST_CHECK_THROW(evaluate_spread({first, shorter}), std::runtime_error);
  BOOST_CHECK_THROW(evaluate_spread({first, unknown}), std::runtime_error);
}

// What needs the truth.
Truth_criteria compare(const scenes::Scene& scene, const Detection& detection)
{
  const Detection truth = perfect(scene);
  return evaluate_truth({truth.label, truth.planes}, detection, extent_of(scene.points), 100);
}

BOOST_AUTO_TEST_CASE(perfect_detection_scores_one)
{
  for(const char* name : {"cube", "staircase", "squares_gap", "two_followers", "village"}) {
    scenes::Scene scene = sample(name, 100000);
    Truth_criteria t = compare(scene, perfect(scene));
    BOOST_TEST_CONTEXT(name)
    {
      BOOST_TEST(t.point_precision == 1.0, within);
      BOOST_TEST(t.face_f1 == 1.0, within);
      BOOST_TEST(t.angle_error_deg < 1e-6);
      BOOST_TEST(t.false_parallels == 0u);
    }
  }
}

BOOST_AUTO_TEST_CASE(pairs_of_a_cube)
{
  const scenes::Scene scene = sample("cube");
  Detection detection = perfect(scene);
  BOOST_TEST(compare(scene, detection).pairs == 15u);
  detection.planes[0].normal = scenes::unit({1, 0.01, 0});
  Truth_criteria t = compare(scene, detection);
  BOOST_TEST(t.false_parallels == 0u);
  BOOST_TEST(t.angle_error_deg == std::atan(0.01) * 57.29577951308232 / 6, boost::test_tools::tolerance(1e-9));
  detection.planes[0].normal = detection.planes[2].normal;
  t = compare(scene, detection);
  BOOST_TEST(t.false_parallels == 2u);
}

BOOST_AUTO_TEST_CASE(a_face_in_thirds_is_not_found)
{
  scenes::Scene scene = sample("cube");
  Detection detection = perfect(scene);
  // One face in thirds: no part has half of it.
  for(std::size_t i = 0, n = 0; i < detection.label.size(); ++i)
    if(detection.label[i] == 0 && ++n % 3 != 0)
      detection.label[i] = n % 3 == 1 ? 6 : 7;
  detection.planes.push_back(detection.planes[0]);
  detection.planes.push_back(detection.planes[0]);
  Truth_criteria t = compare(scene, detection);
  BOOST_TEST(t.shapes_matched == 5u);
  BOOST_TEST(t.face_f1 == 10.0 / 14, within); // precision 5 of 8, recall 5 of 6
  BOOST_TEST(t.point_precision == 1.0, within);
}

// Both halves have an intersection over union of one half, and neither is the face.
BOOST_AUTO_TEST_CASE(two_halves_are_not_a_face)
{
  Truth truth{{0, 0, 0, 0, 1, 1, 1, 1}, {{{0, 0, 1}, 0}, {{0, 0, 1}, -1}}};
  Detection detection{{0, 0, 2, 2, 1, 1, 3, 3}, {}};
  for(std::size_t f : {0, 1, 0, 1})
    detection.planes.push_back(truth.faces[f]);
  Truth_criteria t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 1);
  BOOST_TEST(t.shapes_matched == 0u);
  BOOST_TEST(t.face_f1 == 0.0);
  BOOST_TEST(t.point_precision == 1.0, within);
}

BOOST_AUTO_TEST_CASE(turned_by_ten_degrees)
{
  scenes::Scene scene = sample("cube");
  Detection detection = perfect(scene);
  // All faces about the vertical: relations stay, angles to the truth do not. The roof and the floor are right.
  double c = std::cos(10 / 57.29577951308232), s = std::sin(10 / 57.29577951308232);
  for(Plane& p : detection.planes)
    p.normal = {c * p.normal.x - s * p.normal.y, s * p.normal.x + c * p.normal.y, p.normal.z};
  Truth_criteria t = compare(scene, detection);
  BOOST_TEST(t.angle_error_deg == 4 * 10.0 / 6, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(t.false_parallels == 0u);
}

BOOST_AUTO_TEST_CASE(joined_faces_lose_the_smaller_one)
{
  scenes::Scene scene = sample("squares_gap");
  Detection detection = perfect(scene);
  std::size_t of_first = std::size_t(std::count(scene.label.begin(), scene.label.end(), 0));
  for(std::int32_t& label : detection.label)
    label = 0;
  detection.planes.resize(1);
  Truth_criteria t = compare(scene, detection);
  double larger = double((std::max)(of_first, 6000 - of_first));
  BOOST_TEST(t.point_precision == larger / 6000, within);
  BOOST_TEST(t.face_f1 == 2.0 * 1 * 0.5 / 1.5, within);
}

BOOST_AUTO_TEST_CASE(outliers_and_small_faces)
{
  Truth truth{{0, 0, 0, 0, 1, 1, -1, -1}, {{{0, 0, 1}, 0}, {{1, 0, 0}, 0}}};
  Detection detection{{0, 0, 0, -1, 1, 1, 0, -1}, truth.faces};
  Truth_criteria t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 3);
  BOOST_TEST(t.faces == 1u);
  BOOST_TEST(t.point_precision == 5.0 / 6, within);
  BOOST_TEST(t.shapes_matched == 2u);
  BOOST_TEST(t.face_f1 == 1.0, within);
  detection.label[2] = -1;
  t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 3);
  BOOST_TEST(t.point_precision == 4.0 / 5, within);
}

BOOST_AUTO_TEST_CASE(a_truth_of_other_points_is_refused)
{
  std::vector<Plane> planes = {{{0, 0, 1}, 0}};
  BOOST_CHECK_THROW(evaluate_truth({{0}, planes}, {{0, 0}, planes}, {1, {0, 0, 0}}, 1), std::runtime_error);
}

// Distances to z = 2 x + 1 of +-d in turn: the fit is that plane, and the third label has too few points.
BOOST_AUTO_TEST_CASE(planes_are_fitted_to_labels)
{
  std::vector<Vec> points;
  std::vector<std::int32_t> label;
  for(int i = 0; i < 4; ++i)
    for(int j = 0; j < 4; ++j)
      for(double d : {-0.01, 0.01}) {
        points.push_back({double(i), double(j), 2.0 * i + 1 + d});
        label.push_back(1);
        points.push_back({5 + d, double(i), double(j)});
        label.push_back(0);
      }
  points.insert(points.end(), {{0, 0, 0}, {7, 7, 7}, {9, 9, 9}});
  label.insert(label.end(), {2, 2, -1});
  std::vector<Plane> planes = fit_planes(points, label, 3);
  BOOST_TEST(std::abs(std::abs(planes[0].normal.x) - 1) < 1e-12);
  BOOST_TEST(std::abs(planes[0].normal.x * 5 + planes[0].offset) < 1e-12);
  Vec n = scenes::unit({2, 0, -1});
  BOOST_TEST(length(cross(planes[1].normal, n)) < 1e-5);
  BOOST_TEST(std::abs(dot(planes[1].normal, {1.5, 1.5, 4}) + planes[1].offset) < 1e-12);
  BOOST_TEST(planes[2].normal.z == 1.0);
  BOOST_TEST(planes[2].offset == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
