// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detections inside of tasks of the caller, of which some throw or are cancelled: each detection that has begun gives
// the result that it gives alone.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <atomic>
#include <chrono>
#include <thread>

BOOST_AUTO_TEST_SUITE(test_tbb_contexts)

struct Thrown_by_caller {};

// All clouds in tasks of one group, of which one calls end(context) as soon as another one has begun.
BOOST_AUTO_TEST_CASE(ended_groups)
{
  constexpr std::size_t clouds = 6;
  const Parameters parameters = make_parameters(.01, 40);
  std::vector<Cloud> cloud;
  std::vector<std::uint64_t> expected;
  for(std::size_t i = 0; i < clouds; ++i) {
    cloud.push_back(to_cloud(scenes::make_scene("house", scene_options(20000 + 2000 * i, .002))));
    expected.push_back(detect(cloud[i], parameters, Given::nothing).hash());
  }
  std::atomic<int> compared{0};
  const auto run = [&](const std::string& name, std::size_t last, auto end) {
    std::atomic<int> begun{0}, ended{0};
    tbb::task_group_context context;
    const auto task = [&](std::size_t i) {
      if(i == last) {
        const auto start = std::chrono::steady_clock::now();
        while(begun == 0 && std::chrono::steady_clock::now() - start < std::chrono::milliseconds(200))
          std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
        end(context);
        return;
      }
      ++begun;
      const bool is_equal = detect<CGAL::Parallel_tag>(cloud[i], parameters, Given::nothing).hash() == expected[i];
      ended += is_equal;
      ++compared;
    };
    try {
      tbb::parallel_for(std::size_t(0), clouds, task, tbb::simple_partitioner(), context);
    } catch(const Thrown_by_caller&) {
    }
    check_equal(int(ended), int(begun), name + ": detections that have ended with their result");
  };
  for(std::size_t last : {std::size_t(0), clouds / 2, clouds - 1}) {
    run("thrown", last, [](tbb::task_group_context&) { throw Thrown_by_caller(); });
    run("cancelled", last, [](tbb::task_group_context& context) { context.cancel_group_execution(); });
  }
  CHECK_AT(compared > 0, "no detection has begun");
}

BOOST_AUTO_TEST_SUITE_END()
#endif
