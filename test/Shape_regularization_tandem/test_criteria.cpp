// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measuring itself, on cases counted by hand: a criterion that is wrong
// would make every comparison with other detectors wrong.

#undef NDEBUG

#define BOOST_TEST_MODULE criteria
#include <boost/test/included/unit_test.hpp>

#include "../../benchmark/Shape_regularization_tandem/evaluate_truth.h"
#include "scenes.h"

namespace scenes = CGAL::Tandem::scenes;
using namespace CGAL::Tandem::benchmark;

namespace {

const auto within = boost::test_tools::tolerance(1e-12);

scenes::Scene sample(const std::string& name, std::size_t points = 6000)
{
  scenes::Options options;
  options.points = points;
  return scenes::make_scene(name, options);
}

Truth truth_of(const scenes::Scene& scene)
{
  Truth truth{scene.label, {}};
  for(const scenes::Truth_face& f : scene.faces)
    truth.faces.push_back({f.normal, f.offset});
  return truth;
}

Detection perfect(const scenes::Scene& scene)
{
  Truth truth = truth_of(scene);
  return {truth.label, truth.faces};
}

Truth_criteria compare(const scenes::Scene& scene, const Detection& detection)
{
  return evaluate_truth(truth_of(scene), detection, extent_of(scene.points), 100);
}

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
  return Plane_relations(planes_with_normals(normals), exact_relations()).degrees_of_freedom();
}

} // namespace

BOOST_AUTO_TEST_CASE(cube_has_complexity_9_of_18)
{
  scenes::Scene scene = sample("cube");
  Criteria c = evaluate(scene.points, scene.normals, perfect(scene), {0.01, 25});
  BOOST_TEST(c.shapes == 6u);
  BOOST_TEST(c.exact.directions == 3u);
  BOOST_TEST(c.exact.planes == 6u);
  BOOST_TEST(c.exact.degrees_of_freedom == 3u);
  BOOST_TEST(c.exact.complexity == 9.0 / 18, within);
  BOOST_TEST(c.relaxed.complexity == 9.0 / 18, within);
  BOOST_TEST(c.coverage() == 1.0, within);
  BOOST_TEST(c.beyond_epsilon == 0u);
  BOOST_TEST(c.beyond_alpha == 0u);
  BOOST_TEST(c.not_unit == 0u);
}

BOOST_AUTO_TEST_CASE(degrees_of_freedom_of_directions)
{
  BOOST_TEST(degrees_of_freedom({}) == 0u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}}) == 2u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {0, 0, -1}}) == 2u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {0, 1, 1}}) == 4u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {1, 0, 0}}) == 3u);
  BOOST_TEST(degrees_of_freedom({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}) == 3u);
  // A master with two leaves that are not orthogonal; the master need not come first.
  BOOST_TEST(degrees_of_freedom({{1, 0, 0}, {3, 4, 0}, {0, 0, 1}}) == 4u);
  // The paper's two frames that share the vertical: 2 + 1 + 1.
  BOOST_TEST(degrees_of_freedom({{1, 0, 0}, {0, 1, 0}, {3, 4, 0}, {-4, 3, 0}, {0, 0, 1}}) == 4u);
}

BOOST_AUTO_TEST_CASE(nearly_equal_is_relaxed_but_not_exact)
{
  std::vector<Plane> planes = {{{0, 0, 1}, 5}, {{0, 0, 1}, 5 + 1e-9}, {scenes::unit({1e-8, 0, 1}), 5}};
  Plane_relations exact(planes, exact_relations());
  BOOST_TEST(exact.directions() == 2u);
  BOOST_TEST(exact.planes() == 3u);
  Plane_relations relaxed(planes, relaxed_relations(1, {0, 0, -5}));
  BOOST_TEST(relaxed.directions() == 1u);
  BOOST_TEST(relaxed.planes() == 1u);
  // The sign of a plane means nothing; that of the offset alone does.
  std::vector<Plane> signs = {{{0, 0, 1}, 5}, {{0, 0, -1}, -5}, {{0, 0, -1}, 5}};
  BOOST_TEST(Plane_relations(signs, exact_relations()).directions() == 1u);
  BOOST_TEST(Plane_relations(signs, exact_relations()).planes() == 2u);
  BOOST_TEST(Plane_relations(signs, relaxed_relations(1, {0, 0, 0})).planes() == 2u);
}

BOOST_AUTO_TEST_CASE(orthogonal_means_orthogonal)
{
  std::vector<Plane> planes = planes_with_normals({{0, 0, 1}, {1, 0, 1e-14}, {1, 0, 1e-16}});
  Plane_relations exact(planes, exact_relations());
  BOOST_TEST(!exact.are_orthogonal(0, 1));
  BOOST_TEST(exact.are_orthogonal(0, 2));
  BOOST_TEST(Plane_relations(planes, relaxed_relations(1, {0, 0, 0})).are_orthogonal(0, 1));
}

BOOST_AUTO_TEST_CASE(distances_and_angles)
{
  std::vector<Vec> points = {{0, 0, 0.25}, {1, 0, -0.5}, {0, 1, 0.125}, {9, 9, 9}};
  std::vector<Vec> normals = {{0, 0, 1}, {0, 0, -2}, {0, 3, 3}, {1, 0, 0}};
  Detection detection{{0, 0, 0, -1}, {{{0, 0, 1}, 0}}};
  Criteria c = evaluate(points, normals, detection, {0.25, 44});
  BOOST_TEST(c.assigned == 3u);
  BOOST_TEST(c.coverage() == 0.75, within);
  BOOST_TEST(c.mean_distance == 0.875 / 3, within);
  BOOST_TEST(c.max_distance == 0.5, within);
  BOOST_TEST(c.beyond_epsilon == 1u); // epsilon itself is allowed
  BOOST_TEST(c.beyond_alpha == 1u);
  BOOST_TEST(c.mean_normal_angle_deg == 15.0, within);
  BOOST_TEST(c.smallest_shape == 3u);
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 45}).beyond_alpha == 0u);
  BOOST_TEST(evaluate(points, {}, detection, {0.25, 1}).beyond_alpha == 0u);
  detection.planes[0].normal.z = 1.001;
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 44}).not_unit == 1u);
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
  BOOST_CHECK_THROW(evaluate_truth({{0}, planes}, {{0, 0}, planes}, {1, {0, 0, 0}}, 1), std::runtime_error);
  BOOST_TEST(evaluate({}, {}, {{}, {}}, {1, 25}).exact.complexity == 0);
}

BOOST_AUTO_TEST_CASE(perfect_detection_scores_one)
{
  for(const char* name : {"cube", "staircase", "squares_gap", "two_leaves", "village"}) {
    scenes::Scene scene = sample(name, 100000);
    Truth_criteria t = compare(scene, perfect(scene));
    BOOST_TEST_CONTEXT(name)
    {
      BOOST_TEST(t.point_precision == 1.0, within);
      BOOST_TEST(t.point_recall == 1.0, within);
      BOOST_TEST(t.at_50.f1 == 1.0, within);
      BOOST_TEST(t.at_75.f1 == 1.0, within);
      BOOST_TEST(t.shapes_per_face == 1.0, within);
      BOOST_TEST(t.swallowed_faces == 0u);
      BOOST_TEST(t.angle_error_deg < 1e-6);
      for(const Pair_score* pairs : {&t.relaxed.parallel, &t.relaxed.orthogonal, &t.relaxed.coplanar}) {
        BOOST_TEST(pairs->share() == 1.0, within);
        BOOST_TEST(pairs->false_pairs == 0u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(pairs_of_a_cube)
{
  scenes::Scene scene = sample("cube");
  Detection detection = perfect(scene);
  Truth_criteria t = compare(scene, detection);
  BOOST_TEST(t.exact.parallel.true_pairs == 3u);
  BOOST_TEST(t.exact.orthogonal.true_pairs == 12u);
  BOOST_TEST(t.exact.coplanar.true_pairs == 0u);
  detection.planes[0].normal = scenes::unit({1, 0.01, 0});
  t = compare(scene, detection);
  BOOST_TEST(t.exact.parallel.kept == 2u);
  BOOST_TEST(t.exact.orthogonal.kept == 10u);
  BOOST_TEST(t.angle_error_deg == std::atan(0.01) * 57.29577951308232 / 6, boost::test_tools::tolerance(1e-9));
  detection.planes[0].normal = detection.planes[2].normal;
  t = compare(scene, detection);
  BOOST_TEST(t.exact.parallel.false_pairs == 2u);
}

BOOST_AUTO_TEST_CASE(split_face_is_over_segmented)
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
  BOOST_TEST(t.at_50.precision == 5.0 / 8, within);
  BOOST_TEST(t.at_50.recall == 5.0 / 6, within);
  BOOST_TEST(t.shapes_per_face == 8.0 / 6, within);
  BOOST_TEST(t.point_precision == 1.0, within);
  BOOST_TEST(t.swallowed_faces == 0u);
}

BOOST_AUTO_TEST_CASE(joined_faces_are_swallowed)
{
  scenes::Scene scene = sample("squares_gap");
  Detection detection = perfect(scene);
  std::size_t of_first = std::size_t(std::count(scene.label.begin(), scene.label.end(), 0));
  for(std::int32_t& label : detection.label)
    label = 0;
  detection.planes.resize(1);
  Truth_criteria t = compare(scene, detection);
  double larger = double((std::max)(of_first, 6000 - of_first));
  BOOST_TEST(t.swallowed_faces == 1u);
  BOOST_TEST(t.point_precision == larger / 6000, within);
  BOOST_TEST(t.at_50.f1 == 2.0 * 1 * 0.5 / 1.5, within);
  BOOST_TEST(t.at_75.f1 == 0.0);
}

BOOST_AUTO_TEST_CASE(outliers_and_small_faces)
{
  Truth truth{{0, 0, 0, 0, 1, 1, -1, -1}, {{{0, 0, 1}, 0}, {{1, 0, 0}, 0}}};
  Detection detection{{0, 0, 0, -1, 1, 1, 0, -1}, truth.faces};
  Truth_criteria t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 3);
  BOOST_TEST(t.faces == 1u);
  BOOST_TEST(t.point_precision == 5.0 / 6, within);
  BOOST_TEST(t.point_recall == 5.0 / 6, within);
  BOOST_TEST(t.false_points == 1.0 / 6, within);
  BOOST_TEST(t.at_50.shapes_found == 2u);
  BOOST_TEST(t.at_50.f1 == 1.0, within);
  BOOST_TEST(t.at_75.f1 == 0.0); // 3 of 5 points; the small face alone does not count for recall
  BOOST_TEST(t.at_75.precision == 0.5, within);
}
