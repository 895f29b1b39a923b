// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which of equal shapes a point chooses, and when the passes of an assignment end.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/rounds/assign.h>

#include <cstdint>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_assignment_passes)

using namespace CGAL::Tandem::internal;

using Labels = std::vector<std::uint32_t>;

// A point with a neighbor in each of two shapes that have one plane and one bonus: the smaller id has it, whatever the
// order of the neighbors and the own label are.
BOOST_AUTO_TEST_CASE(test_ties)
{
  const std::vector<Grid_point> point(3, {0, 0, 10, encode_normal({0, 0, 1})});
  const Tolerance tolerance = make_tolerance(100, cosine_deg(25));
  const Plane level = make_plane({0, 0, 1}, {0, 0, 0});
  const std::vector<Assigned_shape> shape(9, {level, 50, -1});
  for(std::uint32_t own : {3u, 7u, free_label})
    for(bool is_reversed : {false, true}) {
      Labels label = {own, is_reversed ? 7u : 3u, is_reversed ? 3u : 7u}, next = label;
      const Labels neighbor = {1, 2, no_index, no_index, no_index, no_index};
      const Cloud_view cloud = {point.data(), neighbor.data(), 3, 2, {point.data(), nullptr, nullptr}};
      const Block_row row = {1, {0}};
      const std::vector<Block_entries> entries(3, 1);
      const Block_points outside = 7;
      Block_points border = 0, recent = 0, changed[2] = {0, 0};
      Labels has_changes(tuning::moves::assignment_passes, 0);
      using Passes = Assignment_passes<Sequential_backend>;
      const Passes passes = {cloud,
                             shape.data(),
                             1,
                             &row,
                             entries.data(),
                             &outside,
                             &recent,
                             {&changed[0], &changed[1]},
                             &border,
                             has_changes.data(),
                             {label.data(), next.data()},
                             Score(10, 2),
                             tolerance};
      for(int step : {Passes::begin, Passes::visit})
        passes.run(step, 0, 0, 1);
      check_equal(next[0], 3u, "ties"); // the hash of 0 is 0, so the first pass considers it
      check_equal(changed[0], Block_points(own != 3), "whether the label of a tie has changed");
      check_equal(has_changes[0], std::uint32_t(own != 3), "whether a label has changed");
      check_equal(border, Block_points(1), "points at a border");
    }
}

// Passes end when two have changed nothing.
BOOST_AUTO_TEST_CASE(test_end)
{
  Labels has_changes = {1, 0, 1, 0, 0, 0};
  const Assignment_passes<Sequential_backend> passes = {
    {}, nullptr, 0, nullptr, nullptr, nullptr, nullptr, {}, nullptr, has_changes.data(), {}, Score(10, 2), {}};
  for(std::size_t pass = 0; pass <= has_changes.size(); ++pass)
    check_equal(passes.is_last(pass), pass >= 5, "whether pass " + std::to_string(pass) + " is needed");
}

BOOST_AUTO_TEST_SUITE_END()
