// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same points and parameters give the same bits: for every run, back end,
// number of threads and order of the points, with normals that are given or estimated.

#include "testing/same_result.h"

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

BOOST_AUTO_TEST_SUITE(test_determinism)

// f() with so many threads, which may be more than there are cores.
template <class F>
void with_threads([[maybe_unused]] int threads, F f)
{
#ifdef CGAL_LINKED_WITH_TBB
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  tbb::task_arena(threads).execute(f);
#else
  f();
#endif
}

void check_runs(const std::string& name, const Cloud& cloud, const Parameters& parameters)
{
  using Tag = CGAL::Parallel_if_available_tag;
  for(const Given given : {Given::normals, Given::nothing}) {
    const std::string full = name + (given == Given::normals ? "" : " without normals");
    const Shapes expected = detect_valid(full, cloud, parameters, given);
    CHECK_AT(expected.number_of_shapes() >= 3, full);
    for(const int threads : {1, 3, 8})
      with_threads(threads, [&] {
        check_equal(difference(expected, detect<Tag>(cloud, parameters, given)), "",
                    full + ", " + std::to_string(threads) + " threads");
      });
    Cloud reversed(cloud.rbegin(), cloud.rend()), shuffled = cloud;
    shuffle(shuffled, 2);
    for(const Cloud& permuted : {reversed, shuffled})
      check_equal(difference({cloud, expected}, {permuted, detect<Tag>(permuted, parameters, given)}, given), "",
                  full + ", permuted");
  }
}

void check_scene(const std::string& name, const scenes::Options& options, std::size_t minimum)
{
  const scenes::Scene scene = scenes::make_scene(name, options);
  const double epsilon = (std::max)(3 * options.noise, .002) * scene.diagonal;
  check_runs(name, to_cloud(scene), make_parameters(epsilon, minimum));
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  scenes::Options indoor = scene_options(20000, .0005, .05);
  indoor.varies_density = true;
  indoor.normals = scenes::Normals::perturbed;
  check_scene("indoor", indoor, 50);
  check_scene("staircase", scene_options(5000, 0, .02), 50);
}

// Each point comes two or three times: equal in all bits, which no order can tell
// apart, or nearer to its twin than the grid resolves, with another normal.
BOOST_AUTO_TEST_CASE(test_copies)
{
  const scenes::Scene scene = scenes::make_scene("house", scene_options(4000, .001, .1));
  for(const double distance : {0., 1e-9}) {
    Cloud cloud = to_cloud(scene);
    scenes::Random random(5);
    for(std::size_t i = 0, n = cloud.size(); i < n; ++i)
      for(std::uint64_t copies = 1 + random.bits() % 2; copies > 0; --copies) {
        const scenes::Vec d = distance * random.direction(), m = (distance > 0 ? .4 : 0.) * random.direction();
        cloud.emplace_back(cloud[i].first + Kernel::Vector_3(d.x, d.y, d.z),
                           cloud[i].second + Kernel::Vector_3(m.x, m.y, m.z));
      }
    check_runs(distance > 0 ? "close twins" : "duplicates", cloud, make_parameters(.003 * scene.diagonal, 60));
  }
}

// So far that many points share a code of the curve.
BOOST_AUTO_TEST_CASE(test_far_points)
{
  const scenes::Scene scene = scenes::make_scene("house", scene_options(5000, .001, .1));
  Cloud cloud = to_cloud(scene);
  scenes::Random random(6);
  for(int i = 0; i < 50; ++i)
    add(cloud, 9000 * random.direction(), {0, 0, 1});
  check_runs("far points", cloud, make_parameters(.003 * scene.diagonal, 40));
}

BOOST_AUTO_TEST_SUITE_END()
