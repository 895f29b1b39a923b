// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same points and parameters give the same bits: for every run, back end,
// number of threads and order of the points, with normals that are given or estimated.

#include "testing/test_support.h"

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

BOOST_AUTO_TEST_SUITE(test_determinism)

struct Subject {
  std::string name;
  Cloud cloud;
  Parameters parameters;
  Given given;
};

void test_runs(const Subject& s, const Shapes& expected)
{
  check_same(detect(s.cloud, s.parameters, s.given), expected, s.name + ", second run");
}

#ifdef CGAL_LINKED_WITH_TBB
void test_threads(const Subject& s, const Shapes& expected)
{
  for(int threads : {1, 2, 3, 8}) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
      check_same(detect<CGAL::Parallel_tag>(s.cloud, s.parameters, s.given), expected,
                 s.name + ", " + std::to_string(threads) + " threads");
    });
  }
}
#else
void test_threads(const Subject& s, const Shapes&)
{
  std::cout << s.name << ": threads are not tested, there is no TBB" << std::endl;
}
#endif

void test_permutations(const Subject& s, const Shapes& expected)
{
  Subject permuted = s;
  for(std::uint64_t seed : {1, 2}) {
    if(seed == 1)
      std::reverse(permuted.cloud.begin(), permuted.cloud.end());
    else
      shuffle(permuted.cloud, seed);
    const Shapes shapes = detect<CGAL::Parallel_if_available_tag>(permuted.cloud, s.parameters, s.given);
    const std::string name = s.name + ", permutation " + std::to_string(seed);
    check_same_planes(shapes, expected, name);
    const auto a = labeled_points(permuted.cloud, shapes), b = labeled_points(s.cloud, expected);
    const long at = first_difference(a, b);
    CHECK_AT(at < 0, name + ": the labels differ, first of point " + std::to_string(at) + " in lexicographic order");
  }
}

void test(const Subject& s)
{
  const Shapes expected = detect(s.cloud, s.parameters, s.given);
  check_valid(s.cloud, expected, s.name, s.given);
  std::cout << s.name << ": " << s.cloud.size() << " points, " << expected.number_of_shapes() << " shapes, "
            << expected.statistics().number_of_rounds << " rounds, hash " << std::hex << expected.hash() << std::dec
            << std::endl;
  CHECK_AT(expected.number_of_shapes() >= 3, s.name);
  test_runs(s, expected);
  test_threads(s, expected);
  test_permutations(s, expected);
}

Subject make_subject(const std::string& name, const scenes::Options& options, std::size_t minimum, Given given)
{
  const scenes::Scene scene = scenes::make_scene(name, options);
  const double epsilon = (std::max)(3 * options.noise, .002) * scene.diagonal;
  return {name + (given == Given::normals ? "" : " without normals"), to_cloud(scene),
          make_parameters(epsilon, minimum), given};
}

// Each point comes two or three times: equal in all bits, which no order can tell
// apart, or nearer to its twin than the grid resolves, with another normal.
Subject with_copies(Subject s, double distance)
{
  s.name += distance > 0 ? " with close twins" : " with duplicates";
  scenes::Random random(5);
  const std::size_t n = s.cloud.size();
  for(std::size_t i = 0; i < n; ++i)
    for(std::uint64_t copies = 1 + random.bits() % 2; copies > 0; --copies) {
      const scenes::Vec d = distance * random.direction(), m = (distance > 0 ? .4 : 0.) * random.direction();
      s.cloud.emplace_back(s.cloud[i].first + Kernel::Vector_3(d.x, d.y, d.z),
                           s.cloud[i].second + Kernel::Vector_3(m.x, m.y, m.z));
    }
  return s;
}

// So large that many points share a code of the curve.
Subject with_far_points(Subject s, double distance)
{
  s.name += " with far points";
  scenes::Random random(6);
  for(int i = 0; i < 50; ++i) {
    const scenes::Vec p = distance * random.direction();
    s.cloud.emplace_back(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(0, 0, 1));
  }
  return s;
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  scenes::Options city = scene_options(100000, .0005, .05);
  city.varies_density = true;
  city.normals = scenes::Normals::perturbed;
  scenes::Options house = scene_options(20000, .001, .1);
  for(Given given : {Given::normals, Given::nothing}) {
    test(make_subject("indoor", city, 100, given));
    test(make_subject("house", house, 60, given));
    test(make_subject("staircase", scene_options(10000, 0, .02), 50, given));
    test(with_copies(make_subject("house", house, 100, given), 0));
    test(with_copies(make_subject("house", house, 100, given), 1e-9));
    test(with_far_points(make_subject("house", house, 60, given), 9000));
  }
}

BOOST_AUTO_TEST_SUITE_END()
