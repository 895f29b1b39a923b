// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The criteria that need the truth, on cases counted by hand.

#undef NDEBUG

#define BOOST_TEST_MODULE criteria_truth
#include <boost/test/unit_test.hpp>

#include "evaluate_truth.h"
#include "scenes.h"

#if __has_include(<Eigen/Eigenvalues>)
#include "fit_plane.h"
#define TANDEM_TEST_FITS_PLANES
#endif

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

} // namespace

BOOST_AUTO_TEST_CASE(perfect_detection_scores_one)
{
  for(const char* name : {"cube", "staircase", "squares_gap", "two_followers", "village"}) {
    scenes::Scene scene = sample(name, 100000);
    Truth_criteria t = compare(scene, perfect(scene));
    BOOST_TEST_CONTEXT(name)
    {
      BOOST_TEST(t.point_precision == 1.0, within);
      BOOST_TEST(t.point_recall == 1.0, within);
      BOOST_TEST(t.at_50.f1 == 1.0, within);
      BOOST_TEST(t.at_75.f1 == 1.0, within);
      BOOST_TEST(t.shapes_per_face == 1.0, within);
      BOOST_TEST(t.split_faces == 0u);
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
  BOOST_TEST(t.exact.parallel.kept == 2u);
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
  BOOST_TEST(t.split_faces == 1u);
  BOOST_TEST(t.point_precision == 1.0, within);
  BOOST_TEST(t.swallowed_faces == 0u);
}

// Both halves have an intersection over union of one half, and neither is the face.
BOOST_AUTO_TEST_CASE(two_halves_are_not_a_face)
{
  Truth truth{{0, 0, 0, 0, 1, 1, 1, 1}, {{{0, 0, 1}, 0}, {{0, 0, 1}, -1}}};
  Detection detection{{0, 0, 2, 2, 1, 1, 3, 3}, {}};
  for(std::size_t f : {0, 1, 0, 1})
    detection.planes.push_back(truth.faces[f]);
  Truth_criteria t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 1);
  BOOST_TEST(t.at_50.shapes_found == 0u);
  BOOST_TEST(t.at_50.recall == 0.0);
  BOOST_TEST(t.point_precision == 1.0, within);
  BOOST_TEST(t.shapes_per_face == 2.0, within);
  BOOST_TEST(t.split_faces == 2u);
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
  BOOST_TEST(t.relaxed.parallel.share() == 1.0, within);
  BOOST_TEST(t.relaxed.orthogonal.share() == 1.0, within);
  BOOST_TEST(t.relaxed.parallel.false_pairs == 0u);
}

BOOST_AUTO_TEST_CASE(coplanar_pairs_and_false_ones)
{
  // Two faces of one plane, and a third a step beside it.
  Truth truth{{0, 0, 1, 1, 2, 2}, {{{0, 0, 1}, 0}, {{0, 0, 1}, 0}, {{0, 0, 1}, -1}}};
  Detection detection{truth.label, truth.faces};
  Truth_criteria t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 1);
  BOOST_TEST(t.exact.coplanar.true_pairs == 1u);
  BOOST_TEST(t.exact.coplanar.kept == 1u);
  BOOST_TEST(t.exact.coplanar.false_pairs == 0u);
  detection.planes[1].offset = 1e-12;
  t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 1);
  BOOST_TEST(t.exact.coplanar.kept == 0u);
  BOOST_TEST(t.relaxed.coplanar.kept == 1u);
  detection.planes[2].offset = 0;
  t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 1);
  BOOST_TEST(t.exact.coplanar.false_pairs == 1u);
  detection.planes[0].normal = {1, 0, 0};
  t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 1);
  BOOST_TEST(t.exact.orthogonal.true_pairs == 0u);
  BOOST_TEST(t.exact.orthogonal.false_pairs == 2u);
  BOOST_TEST(t.exact.parallel.kept == 1u);
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
  detection.label[2] = -1;
  t = evaluate_truth(truth, detection, {1, {0, 0, 0}}, 3);
  BOOST_TEST(t.point_precision == 4.0 / 5, within);
  BOOST_TEST(t.point_recall == 4.0 / 6, within);
}

BOOST_AUTO_TEST_CASE(a_truth_of_other_points_is_refused)
{
  std::vector<Plane> planes = {{{0, 0, 1}, 0}};
  BOOST_CHECK_THROW(evaluate_truth({{0}, planes}, {{0, 0}, planes}, {1, {0, 0, 0}}, 1), std::runtime_error);
}

#ifdef TANDEM_TEST_FITS_PLANES
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
#endif
