// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Progress rises from 0 to 1 through all stages. A cancelled detection leaves a valid result; what the callback throws
// ends it at once.

#include "testing/box_cloud.h"
#include "testing/measured_violation.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

BOOST_AUTO_TEST_SUITE(test_callback)

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::detect_planes;
using Stage = CGAL::Tandem::Detection_stage;

// Whether what the callback throws in its n-th call reaches the caller, without another call.
template <class Range, class List>
bool throws_at(std::size_t n, const Range& points, const List& list)
{
  struct Stop {};
  std::size_t count = 0;
  const CGAL::Tandem::Callback stop = [&](double) -> bool {
    if(++count == n)
      throw Stop();
    return true;
  };
  try {
    detect_planes(points, list.callback(stop));
  } catch(const Stop&) {
    return count == n;
  }
  return false;
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  const Pairs<Epick> points = make_pairs<Epick>(make_box_cloud());
  const auto list = np::point_map(First<Epick>()).normal_map(Second<Epick>()).maximum_distance(.006);
  const auto silent = detect_planes(points, list);
  CHECK(!silent.is_cancelled());

  std::vector<double> progress;
  const CGAL::Tandem::Callback record = [&](double p) {
    progress.push_back(p);
    return true;
  };
  CHECK(detect_planes(points, list.callback(record)).hash() == silent.hash());
  CHECK(progress.size() >= 3 && progress.front() == 0 && progress.back() == 1);
  for(std::size_t i = 1; i < progress.size(); ++i)
    CHECK_AT(progress[i - 1] <= progress[i] && progress[i] <= 1, std::to_string(i));

  for(Stage stage : {Stage::sort, Stage::neighbors, Stage::seeds, Stage::rounds, Stage::end_game, Stage::done})
    CHECK_AT(
      std::any_of(progress.begin(), progress.end(), [&](double p) { return CGAL::Tandem::stage_at(p) == stage; }),
      "stage " + std::to_string(int(stage)));

  for(std::size_t calls = 1; calls < progress.size(); ++calls) {
    std::size_t count = 0;
    const CGAL::Tandem::Callback cancel = [&](double) { return ++count < calls; };
    const auto shapes = detect_planes(points, list.callback(cancel));
    CHECK_AT(shapes.is_cancelled() && count == calls, std::to_string(calls));
    CHECK_AT(calls > 1 || shapes.number_of_shapes() == 0, std::to_string(calls));
    CHECK_AT(shapes.number_of_points() == points.size(), std::to_string(calls));
    std::string why;
    CHECK_AT((why = violation_of(points, shapes, list)).empty(), std::to_string(calls) + ": " + why);
    CHECK_AT(throws_at(calls, points, list), std::to_string(calls));
  }
}

BOOST_AUTO_TEST_SUITE_END()
