// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The measuring itself, on cases counted by hand: a criterion that is wrong
// would make every comparison with other detectors wrong.

#undef NDEBUG

#define BOOST_TEST_MODULE criteria
#include <boost/test/unit_test.hpp>

#include "evaluate.h"
#include "scenes.h"

namespace scenes = CGAL::Tandem::scenes;
using namespace CGAL::Tandem::benchmark;

namespace {

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
  return Plane_relations(planes_with_normals(normals), exact_relations()).degrees_of_freedom();
}

} // namespace

BOOST_AUTO_TEST_CASE(cube_has_complexity_9_of_18)
{
  scenes::Options options;
  options.points = 6000;
  scenes::Scene scene = scenes::make_scene("cube", options);
  Detection perfect{scene.label, {}};
  for(const scenes::Truth_face& f : scene.faces)
    perfect.planes.push_back({f.normal, f.offset});
  Criteria c = evaluate(scene.points, scene.normals, perfect, {0.01, 25});
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

// Two shapes a face, in one plane or in two: complexity falls where nothing was gained, so it is read with shapes.
BOOST_AUTO_TEST_CASE(cube_of_twelve_halves)
{
  std::vector<Plane> planes;
  for(int half = 0; half < 2; ++half)
    for(double side : {-0.5, 0.5})
      for(const Vec& n : {Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}})
        planes.push_back({n, side});
  Plane_relations halves(planes, exact_relations());
  BOOST_TEST(halves.directions() == 3u);
  BOOST_TEST(halves.planes() == 6u);
  BOOST_TEST(halves.complexity() == 9.0 / 36, within);
  for(std::size_t s = 6; s < 12; ++s)
    planes[s].offset += 1e-3;
  BOOST_TEST(Plane_relations(planes, exact_relations()).complexity() == 15.0 / 36, within);
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
  // Nor where the coordinate that gives the sign is nearly zero.
  std::vector<Plane> vertical = {{{1e-9, 0, 1}, 5}, {{-1e-9, 0, 1}, 5}};
  BOOST_TEST(Plane_relations(vertical, relaxed_relations(1, {0, 0, 0})).planes() == 1u);
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
  BOOST_TEST(c.mean_distance_in_epsilons == 3.5 / 3, within);
  BOOST_TEST(c.max_distance_in_epsilons == 2.0, within);
  BOOST_TEST(c.beyond_epsilon == 1u); // epsilon itself is allowed
  BOOST_TEST(c.beyond_alpha == 1u);
  BOOST_TEST(c.beyond_either == 2u);
  BOOST_TEST(c.mean_normal_angle_deg == 15.0, within);
  BOOST_TEST(c.smallest_shape == 3u);
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 45}).beyond_alpha == 0u);
  BOOST_TEST(evaluate(points, {}, detection, {0.25, 1}).beyond_alpha == 0u);
  detection.planes[0].normal.z = 1.001;
  BOOST_TEST(evaluate(points, normals, detection, {0.25, 44}).not_unit == 1u);
  detection.planes[0].normal.z = 1;
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
  BOOST_TEST(evaluate({}, {}, {{}, {}}, {1, 25}).exact.complexity == 0);
}
