// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detections inside of tasks of the caller, of which some throw or are cancelled: each detection that has begun gives
// the result that it gives alone. The sort by several threads.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#include <CGAL/Tandem/internal/base/keys.h>

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

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

// The parts of a sort depend on a sample of the keys: few and many of them, all equal, nearly all equal, skewed, sorted.
BOOST_AUTO_TEST_CASE(sorts)
{
  using namespace CGAL::Tandem::internal;
  Tbb_backend backend;
  for(const std::size_t n : {0, 1, 4095, 4096, 4097, 300000})
    for(const std::uint64_t kind : {0, 1, 2, 3, 4}) {
      Host_sort_table table(n);
      std::vector<std::pair<std::uint64_t, std::uint32_t>> expected;
      for(std::uint64_t i = 0; i < n; ++i) {
        const std::uint64_t random = hash_of_pair(i) >> 1;
        const std::uint64_t keys[] = {7, random % 1000 == 0 ? random : 7, random >> random % 60, i, random};
        expected.push_back({keys[kind], std::uint32_t(i)});
        table.view().set(i, keys[kind], std::uint32_t(i));
      }
      backend.sort(table);
      std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
      for(std::size_t i = 0; i < table.size(); ++i)
        sorted.push_back({table.view().key(i), table.view().index(i)});
      const auto is_less = [](const auto& a, const auto& b) { return a.first < b.first; };
      CHECK_AT(std::is_sorted(sorted.begin(), sorted.end(), is_less), std::to_string(n) + " keys");
      std::sort(sorted.begin(), sorted.end());
      std::sort(expected.begin(), expected.end());
      CHECK_AT(sorted == expected, std::to_string(n) + " keys"); // none is lost, and each has its index
    }
}

BOOST_AUTO_TEST_SUITE_END()
#endif
