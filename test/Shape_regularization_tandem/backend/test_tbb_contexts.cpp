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
#include <stdexcept>
#include <thread>

BOOST_AUTO_TEST_SUITE(test_tbb_contexts)

constexpr std::size_t clouds = 6;

struct Thrown_by_caller : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Siblings {
public:
  Siblings()
  {
    for(std::size_t i = 0; i < clouds; ++i) {
      cloud_.push_back(to_cloud(scenes::make_scene("house", scene_options(20000 + 2000 * i, .002))));
      expected_.push_back(detect(cloud_[i], parameters_, Given::nothing).hash());
    }
  }

  // All clouds in tasks of one group, of which one calls end(context) as soon as another one has begun. Returns how
  // many detections were compared.
  template <class End>
  std::size_t run(const std::string& name, std::size_t last, End end)
  {
    std::atomic<int> begun{0};
    std::vector<char> is_done(clouds, 0), is_equal(clouds, 0);
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
      is_equal[i] = detect<CGAL::Parallel_tag>(cloud_[i], parameters_, Given::nothing).hash() == expected_[i];
      is_done[i] = 1;
    };
    try {
      tbb::parallel_for(std::size_t(0), clouds, task, tbb::simple_partitioner(), context);
    } catch(const Thrown_by_caller&) {
    }
    std::size_t compared = 0;
    for(std::size_t i = 0; i < clouds; ++i) {
      CHECK_AT(!is_done[i] || is_equal[i], name + ": cloud " + std::to_string(i));
      compared += is_done[i] != 0;
    }
    check_equal(compared, std::size_t(begun), name + ": detections that have ended");
    return compared;
  }

private:
  const Parameters parameters_ = make_parameters(.01, 40);
  std::vector<Cloud> cloud_;
  std::vector<std::uint64_t> expected_;
};

BOOST_AUTO_TEST_CASE(ended_groups)
{
  Siblings siblings;
  std::size_t compared = 0;
  for(std::size_t last : {std::size_t(0), clouds / 2, clouds - 1}) {
    compared +=
      siblings.run("thrown", last, [](tbb::task_group_context&) { throw Thrown_by_caller("by a task of the caller"); });
    compared +=
      siblings.run("cancelled", last, [](tbb::task_group_context& context) { context.cancel_group_execution(); });
  }
  CHECK_AT(compared > 0, "no detection has begun");
}

BOOST_AUTO_TEST_SUITE_END()
#endif
