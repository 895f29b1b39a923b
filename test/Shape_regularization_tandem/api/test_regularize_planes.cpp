// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// regularize_planes() on planes that were found elsewhere: a noisy, turned box,
// with the interface of CGAL's function of the same name.

#include "testing/checks.h"
#include "testing/plane_scene.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>
#include <CGAL/Simple_cartesian.h>

#include <numeric>

BOOST_AUTO_TEST_SUITE(test_regularize_planes)

namespace np = CGAL::parameters;
using CGAL::Tandem::regularize_planes;

template <class Kernel>
void check_box(const std::string& kernel, double exactness, double far)
{
  const double noise = .01;
  for(int seed = 0; seed < 10; ++seed) {
    Scene<Kernel> s = make_box<Kernel>(seed, noise, far);
    const auto old = s.planes;
    const std::string what = kernel + ", box " + std::to_string(seed);
    const CGAL::Tandem::Plane_relations r =
      regularize_planes(s.planes, s.points, np::plane_index_map(s.index_map()).maximum_angle(8).maximum_offset(0.05));
    CHECK_AT(r.number_of_parallel_groups() == 3 && r.number_of_coplanar_groups() == 7, what);
    CHECK_AT(r.orthogonal_groups.size() == 3 && r.coplanar_group[6] == r.coplanar_group[7], what);
    CHECK_AT(s.planes[6] == s.planes[7] || s.planes[6] == s.planes[7].opposite(), what);
    for(int i = 0; i < 8; ++i) {
      const std::string plane = what + ", plane " + std::to_string(i);
      const V a = normal_of(s.planes[i]);
      CHECK_AT(std::fabs(dot(a, a) - 1) <= exactness, plane);
      CHECK_AT(dot(a, normal_of(old[i])) > 0, plane + ": keeps its orientation");
      CHECK_AT(r.angle[i] < 3 && r.largest_distance[i] < 6 * noise + 0.02, plane + ": motion");
      CHECK_AT(r.is_changed[i] && !r.is_rolled_back[i], plane);
      for(int j = 0; j < i; ++j) {
        const V b = normal_of(s.planes[j]), minus = {-b[0], -b[1], -b[2]};
        const bool is_parallel = r.parallel_group[i] == r.parallel_group[j];
        CHECK_AT(is_parallel ? a == b || a == minus : std::fabs(dot(a, b)) <= exactness,
                 plane + " and " + std::to_string(j));
      }
    }
  }
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

BOOST_AUTO_TEST_CASE(test_kernels)
{
  check_box<Kernel>("EPICK", 1e-15, 0);
  check_box<Kernel>("EPICK far away", 1e-15, 4.5e5);
  check_box<CGAL::Exact_predicates_exact_constructions_kernel>("EPECK", 1e-15, 0);
  check_box<CGAL::Simple_cartesian<float>>("float", 2e-7, 0);
}

enum Switches { parallelism = 1, orthogonality = 2, coplanarity = 4 };

BOOST_AUTO_TEST_CASE(test_switches)
{
  const Scene<Kernel> box = make_box<Kernel>(1, 0.005);
  auto run = [&](int off) {
    Scene<Kernel> s = box;
    return regularize_planes(s.planes, s.points,
                             np::plane_index_map(s.index_map())
                               .maximum_angle(8)
                               .maximum_offset(0.05)
                               .regularize_parallelism((off & parallelism) == 0)
                               .regularize_orthogonality((off & orthogonality) == 0)
                               .regularize_coplanarity((off & coplanarity) == 0));
  };
  check_equal(run(orthogonality).orthogonal_groups.size(), 0u, "right angles, orthogonality off");
  check_equal(run(coplanarity).number_of_coplanar_groups(), 8u, "planes, coplanarity off");
  check_equal(run(parallelism | orthogonality).number_of_parallel_groups(), 8u, "directions, parallelism off");
  for(bool changed : run(parallelism | orthogonality | coplanarity).is_changed)
    check(!changed, "nothing changes with all switches off");
}

// Two walls at five degrees with little noise: one direction would cost their points too much.
BOOST_AUTO_TEST_CASE(test_refusal)
{
  Scene<Kernel> s;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for(int f = 0; f < 2; ++f) {
    const double slope = f == 0 ? 0 : 0.0875;
    for(int i = 0; i < 400; ++i) {
      const double a = uniform(random), b = uniform(random);
      s.points.push_back({a, b, slope * a + 3 * f + 0.001 * uniform(random)});
      s.index.push_back(f);
    }
    s.planes.push_back({-slope, 0, 1, -3.0 * f});
  }
  const auto old = s.planes;
  const auto r = regularize_planes(s.planes, s.points, np::plane_index_map(s.index_map()));
  check_equal(r.number_of_parallel_groups(), 2u, "directions of two walls at five degrees");
  check(s.planes[0] == old[0] && s.planes[1] == old[1], "unrelated planes stay as they are");
  check(r.maximum_distance < 0.02, "estimated maximum_distance", r.maximum_distance);
  // five degrees of two walls of length 2 are 0.044 at most at their ends
  const auto tolerant = regularize_planes(
    s.planes, s.points, CGAL::Tandem::parameters::plane_index_map(s.index_map()).maximum_distance(0.2));
  check_equal(tolerant.number_of_parallel_groups(), 1u, "directions with a large maximum_distance");
  check_equal(tolerant.maximum_distance, 0.2, "given maximum_distance");
}

BOOST_AUTO_TEST_CASE(test_order_of_points)
{
  Scene<Kernel> s = make_box<Kernel>(4, 0.01), t = s;
  std::vector<std::size_t> order(s.points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  for(std::size_t i = 0; i < order.size(); ++i) {
    t.points[i] = s.points[order[i]];
    t.index[i] = s.index[order[i]];
  }
  regularize_planes(s.planes, s.points, np::plane_index_map(s.index_map()));
  regularize_planes(t.planes, t.points, np::plane_index_map(t.index_map()));
  for(std::size_t i = 0; i < s.planes.size(); ++i)
    check(s.planes[i] == t.planes[i], "same plane for points in another order", double(i));
}

BOOST_AUTO_TEST_CASE(test_bad_input)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scene<Kernel> s = make_box<Kernel>(3, 0.01);
  s.planes.push_back({0, 0, 1, -20}); // no points
  s.planes.push_back({0, 0, 0, 1});   // no normal
  s.planes.push_back({0, 1, 0, 0});   // collinear points
  for(int i = 0; i < 9; ++i) {
    s.points.push_back({double(i), 0, 0});
    s.index.push_back(10);
  }
  s.points.push_back({nan, 0, 0});
  s.index.push_back(0);
  const auto old = s.planes;
  const auto r = regularize_planes(s.planes, s.points, np::plane_index_map(s.index_map()).maximum_offset(0.05));
  for(int i = 8; i < 11; ++i)
    check(s.planes[i].a() == old[i].a() && s.planes[i].d() == old[i].d() && !r.is_changed[i], "stays as it is, plane",
          i);
  check_equal(r.number_of_parallel_groups(), 6u, "directions with bad planes");

  const std::vector<Kernel::Point_3> no_points;
  const std::vector<int> none;
  const Index_map map = {&none};
  std::vector<Kernel::Plane_3> no_planes;
  check_equal(double(regularize_planes(no_planes, no_points, np::plane_index_map(map)).parallel_group.size()), 0,
              "nothing at all");
  check_equal(double(regularize_planes(s.planes, no_points, np::plane_index_map(map)).parallel_group.size()), 11,
              "planes without points");

  auto run = [&](const auto& p) { regularize_planes(s.planes, s.points, p); };
  check_throws<std::invalid_argument>([&] { run(np::plane_index_map(s.index_map()).maximum_angle(45)); },
                                      {"maximum_angle"}, __LINE__);
  check_throws<std::invalid_argument>([&] { run(np::plane_index_map(s.index_map()).maximum_offset(-1)); },
                                      {"maximum_offset"}, __LINE__);
  for(const double wrong : {-1., nan, 1e9})
    check_throws<std::invalid_argument>(
      [&] { run(CGAL::Tandem::parameters::regularity(wrong).plane_index_map(s.index_map())); },
      {"regularity is ", "[0, 10]"}, __LINE__);
  check_throws<std::invalid_argument>(
    [&] { run(CGAL::Tandem::parameters::maximum_distance(nan).plane_index_map(s.index_map())); }, {"maximum_distance"},
    __LINE__);
  s.index[7] = 11;
  check_throws<std::invalid_argument>([&] { run(np::plane_index_map(s.index_map())); }, {"plane_index_map"}, __LINE__);
}

// A tolerance beyond the extent of the points is as good as one of that extent.
BOOST_AUTO_TEST_CASE(test_large_tolerances)
{
  const Scene<Kernel> s = make_box<Kernel>(3, 0.01);
  namespace tandem = CGAL::Tandem::parameters;
  const auto all = tandem::plane_index_map(s.index_map()).maximum_angle(8);
  const auto run = [&](const auto& list) {
    Scene<Kernel> t = s;
    const CGAL::Tandem::Plane_relations r = regularize_planes(t.planes, s.points, list);
    return std::make_pair(t.planes, r);
  };
  const auto expected = run(all.maximum_offset(100)); // the box has a diameter of 20
  check_equal(expected.second.number_of_parallel_groups(), 3, "directions, offset 100");
  check_equal(expected.second.number_of_coplanar_groups(), 3, "planes, offset 100");
  for(double large : {1e3, 1e6, 1e100, 1e270}) {
    const auto offset = run(all.maximum_offset(large)), distance = run(all.maximum_offset(100).maximum_distance(large));
    check(offset.first == expected.first, "the same planes, maximum_offset", large);
    check(distance.first == expected.first, "the same planes, maximum_distance", large);
    check(offset.second.coplanar_group == expected.second.coplanar_group, "the same groups, maximum_offset", large);
    // Opposite faces stay apart where their points are to be close to their planes.
    const auto near = run(all.maximum_offset(large).maximum_distance(0.05));
    check_equal(near.second.number_of_parallel_groups(), 3, "directions, points nearby");
    check_equal(near.second.number_of_coplanar_groups(), 7, "planes, points nearby");
  }
}

// The points of a plane decide, wherever the plane was said to be.
BOOST_AUTO_TEST_CASE(test_far_planes)
{
  for(double far : {1e8, 1e12, 1e30, 1e200, 1e308}) {
    Scene<Kernel> s = make_box<Kernel>(3, 0.01);
    const Kernel::Plane_3 p = s.planes[7];
    s.planes[7] = Kernel::Plane_3(p.a(), p.b(), p.c(), far);
    const auto r =
      regularize_planes(s.planes, s.points, CGAL::Tandem::parameters::plane_index_map(s.index_map()).maximum_angle(8));
    check_equal(r.number_of_parallel_groups(), 3, "directions with a plane at " + std::to_string(far));
  }
}

// Planes and points inside of other types.
BOOST_AUTO_TEST_CASE(test_maps)
{
  Scene<Kernel> s = make_box<Kernel>(6, 0.01);
  std::vector<std::pair<int, Kernel::Plane_3>> planes;
  std::vector<std::pair<Kernel::Point_3, Kernel::Vector_3>> points;
  for(const auto& p : s.planes)
    planes.push_back({0, p});
  for(const auto& p : s.points)
    points.push_back({p, Kernel::Vector_3(0, 0, 0)});
  regularize_planes(planes, points,
                    np::plane_map(CGAL::Second_of_pair_property_map<std::pair<int, Kernel::Plane_3>>())
                      .point_map(CGAL::First_of_pair_property_map<std::pair<Kernel::Point_3, Kernel::Vector_3>>())
                      .plane_index_map(s.index_map()));
  regularize_planes(s.planes, s.points, np::plane_index_map(s.index_map()));
  for(std::size_t i = 0; i < planes.size(); ++i)
    check(planes[i].second == s.planes[i], "same plane through maps", double(i));
}

// Planes that are orthogonal before get unit normals, too, of any length; one that is related to nothing stays.
BOOST_AUTO_TEST_CASE(test_unit_normals)
{
  Scene<Kernel> s;
  s.planes = {{0, 0, 2, 0}, {-3e-200, 0, 0, 0}, {1, 2, 4, 0}};
  for(int i = 0; i < 300; ++i) {
    const double u = i % 10, v = i / 10 % 10;
    const Kernel::Point_3 points[3] = {{u, v, 0}, {0, u, v}, {2 * u, v, -u / 2 - v / 2}};
    s.points.push_back(points[i / 100]);
    s.index.push_back(i / 100);
  }
  const auto r = regularize_planes(s.planes, s.points, np::plane_index_map(s.index_map()).maximum_angle(1));
  const Kernel::Plane_3 expected[3] = {{0, 0, 1, 0}, {-1, 0, 0, 0}, {1, 2, 4, 0}};
  check_equal(r.orthogonal_groups.size(), 1u, "orthogonal pairs before");
  for(std::size_t i = 0; i < 3; ++i) {
    const bool has_bits = normal_of(s.planes[i]) == normal_of(expected[i]) && s.planes[i].d() == expected[i].d();
    check(has_bits && r.is_changed[i] == (i < 2), "normal of unit length where related, plane", double(i));
  }
}

BOOST_AUTO_TEST_SUITE_END()
