// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many passes a detection makes over points, lists and shapes: the same on each back end of the host, not more for
// more points, and not more than there are today. A change that makes more says why, and raises the bounds; one that
// makes fewer lowers them, so that the gain is not lost again.

#include "testing/test_support.h"
#include "testing/work.h"

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>

#include <iostream>

BOOST_AUTO_TEST_SUITE(test_work)

using CGAL::Tandem::Statistics;
using CGAL::Tandem::Work;

Cloud make_cloud(std::size_t points) { return to_cloud(scenes::make_scene("indoor", scene_options(points, .001, .1))); }

std::string to_text(Given given) { return given == Given::normals ? "given normals" : "own normals"; }

// Of a cloud whose points are surfels: then each pass is a whole one. In a round, bounds are 5 % above the present
// numbers; before and after the rounds, half a pass. So one pass more exceeds them.
struct Bounds {
  Given given;
  Work prepare, round, finish;
};

const Bounds bounds[] = {
  {Given::normals, {14.5, .16, 0, 35}, {11.4, 1.66, 44, 75}, {58.5, 4.6, 141, 251}},
  {Given::nothing, {32.5, .16, 0, 54}, {11.9, 1.8, 44, 77}, {79.5, 6.5, 155, 302}},
};

void print(const Work& w, double times, const std::string& name)
{
  std::cout << name << ": " << w.passes_over_points / times << " passes over points, " << w.passes_over_lists / times
            << " over lists, " << double(w.loops_over_shapes) / times << " loops over shapes, "
            << double(w.launches) / times << " launches" << std::endl;
}

BOOST_AUTO_TEST_CASE(test_bounds)
{
  for(const Bounds& b : bounds)
    for(const std::size_t points : {30000, 120000}) {
      const std::string name = to_text(b.given) + ", " + std::to_string(points) + " points";
      const Statistics s = detect(make_cloud(points), points_only(.02, 60), b.given).statistics();
      const double rounds = double(s.number_of_rounds);
      CHECK_AT(s.number_of_shapes > 10 && rounds >= 5, name);
      print(s.work.prepare, 1, name + ", preparation");
      print(s.work.rounds, rounds, name + ", a round");
      print(s.work.finish, 1, name + ", end");
      check_bounded(s.work.prepare, 1, b.prepare, name + ", preparation");
      check_bounded(s.work.rounds, rounds, b.round, name + ", a round");
      check_bounded(s.work.finish, 1, b.finish, name + ", end");
    }
}

// With surfels, and with cells so small that most loops of several threads have several pieces.
BOOST_AUTO_TEST_CASE(test_back_ends)
{
#ifdef CGAL_LINKED_WITH_TBB
  const Cloud cloud = make_cloud(20000);
  for(const Given given : {Given::normals, Given::nothing}) {
    Parameters parameters = make_parameters(.02, 60);
    parameters.cell_size = 700;
    const Shapes sequential = detect(cloud, parameters, given),
                 parallel = detect<CGAL::Parallel_tag>(cloud, parameters, given);
    CHECK(sequential.hash() == parallel.hash());
    check_same_work(parallel.statistics().work, sequential.statistics().work, to_text(given));
  }
#endif
}

// Results between rounds are no work of the detection.
BOOST_AUTO_TEST_CASE(test_steps)
{
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, CGAL::Sequential_tag>;
  const Cloud cloud = make_cloud(10000);
  const Parameters parameters = make_parameters(.02, 60);
  const auto list =
    CGAL::Tandem::parameters::settings(parameters).point_map(First<Kernel>()).normal_map(Second<Kernel>());
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(cloud, list);
  Statistics before = detection.shapes().statistics();
  check_equal(before.work.rounds.launches, std::size_t(0), "launches of no round");
  while(detection.iterate()) {
    const Statistics s = detection.shapes().statistics();
    CHECK(s.work.rounds.passes_over_points >= before.work.rounds.passes_over_points + 1);
    check_equal(s.work.finish.launches, std::size_t(0), "launches of no end");
    before = s;
  }
  detection.finish();
  check_same_work(detection.shapes().statistics().work, detect(cloud, parameters).statistics().work, "in steps");
}

BOOST_AUTO_TEST_CASE(test_nothing)
{
  const Statistics s = detect(Cloud(), make_parameters(.02, 60)).statistics();
  check_same_work(s.work, CGAL::Tandem::Stage_work(), "no points");
}

BOOST_AUTO_TEST_SUITE_END()
