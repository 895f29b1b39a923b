// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far runs differ, and the columns under which criteria are written.

#undef NDEBUG

#define BOOST_TEST_MODULE criteria_spread
#include <boost/test/unit_test.hpp>

#include "evaluate_columns.h"

#include <set>

using namespace CGAL::Tandem::benchmark;

namespace {

const auto within = boost::test_tools::tolerance(1e-12);

const std::vector<Plane> two_planes = {{{0, 0, 1}, 0}, {{1, 0, 0}, -1}};
const Detection first{{0, 0, 0, 0, 1, 1, 1, 1, -1, -1}, two_planes};

std::string value(const Row& row, const std::string& name)
{
  for(const auto& cell : row)
    if(cell.first == name)
      return cell.second;
  BOOST_FAIL("no column " + name);
  return "";
}

std::vector<std::string> names(const Row& row)
{
  std::vector<std::string> result;
  for(const auto& cell : row)
    result.push_back(cell.first);
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(equal_runs_have_no_spread)
{
  Spread spread = evaluate_spread({first, first, first});
  BOOST_TEST(spread.runs == 3u);
  BOOST_TEST(spread.is_same);
  BOOST_TEST(spread.relabeled == 0.0);
  BOOST_TEST(spread.fewest_shapes == 2u);
  BOOST_TEST(spread.maximum_shapes == 2u);
  BOOST_TEST(spread.minimum_coverage == 0.8, within);
  BOOST_TEST(spread.maximum_coverage == 0.8, within);
  BOOST_TEST(evaluate_spread({}).is_same);
  BOOST_TEST(evaluate_spread({first}).relabeled == 0.0);
}

BOOST_AUTO_TEST_CASE(renumbered_shapes_are_other_bits_but_the_same_partition)
{
  Detection renumbered{{1, 1, 1, 1, 0, 0, 0, 0, -1, -1}, {two_planes[1], two_planes[0]}};
  Spread spread = evaluate_spread({first, renumbered});
  BOOST_TEST(!spread.is_same);
  BOOST_TEST(spread.relabeled == 0.0);
}

BOOST_AUTO_TEST_CASE(the_last_bit_of_a_plane_counts)
{
  Detection moved = first;
  moved.planes[1].offset = std::nextafter(-1.0, 0.0);
  BOOST_TEST(!evaluate_spread({first, moved}).is_same);
  moved = first;
  moved.planes[0].normal.y = 1e-300;
  BOOST_TEST(!evaluate_spread({first, moved}).is_same);
}

BOOST_AUTO_TEST_CASE(moved_lost_and_gained_points_are_counted)
{
  Detection other = first;
  other.label[3] = 1;
  BOOST_TEST(share_relabeled(first, other) == 0.1, within);
  other.label[8] = 0;
  BOOST_TEST(share_relabeled(first, other) == 0.2, within);
  other.label[7] = -1;
  BOOST_TEST(share_relabeled(first, other) == 0.3, within);
}

BOOST_AUTO_TEST_CASE(a_split_shape_keeps_its_larger_part)
{
  Detection split{{2, 0, 0, 0, 1, 1, 1, 1, -1, -1}, {two_planes[0], two_planes[1], two_planes[0]}};
  Spread spread = evaluate_spread({first, split});
  BOOST_TEST(spread.relabeled == 0.1, within);
  BOOST_TEST(spread.fewest_shapes == 2u);
  BOOST_TEST(spread.maximum_shapes == 3u);
  // And a new shape of points that had none.
  Detection more{{0, 0, 0, 0, 1, 1, 1, 1, 2, 2}, {two_planes[0], two_planes[1], two_planes[0]}};
  spread = evaluate_spread({first, more, split});
  BOOST_TEST(spread.relabeled == 0.2, within);
  BOOST_TEST(spread.minimum_coverage == 0.8, within);
  BOOST_TEST(spread.maximum_coverage == 1.0, within);
}

BOOST_AUTO_TEST_CASE(runs_that_do_not_fit_are_refused)
{
  Detection shorter{{0, 1}, two_planes}, unknown = first;
  unknown.label[0] = 2;
  BOOST_CHECK_THROW(evaluate_spread({first, shorter}), std::runtime_error);
  BOOST_CHECK_THROW(evaluate_spread({first, unknown}), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(columns_hold_the_criteria)
{
  std::vector<Vec> points(10, Vec{1, 0, 0}), normals(10, Vec{0, 0, 1});
  Row row;
  append_criteria(row, evaluate(points, normals, first, {0.5, 25}));
  append_spread(row, evaluate_spread({first}));
  BOOST_TEST(value(row, "shapes") == "2");
  BOOST_TEST(value(row, "coverage") == "0.8");
  BOOST_TEST(value(row, "complexity_exact") == "0.833333");
  BOOST_TEST(value(row, "beyond_epsilon") == "0");
  BOOST_TEST(value(row, "beyond_alpha") == "4");
  BOOST_TEST(value(row, "same_result") == "true");
  std::vector<std::string> all = names(row);
  BOOST_TEST(std::set<std::string>(all.begin(), all.end()).size() == all.size());
}

BOOST_AUTO_TEST_CASE(columns_of_the_truth_are_there_without_it)
{
  Truth truth{{0, 0, 0, 0, 1, 1, 1, 1, -1, -1}, two_planes};
  Row known, unknown;
  append_truth(known, evaluate_truth(truth, first, {1, {0, 0, 0}}, 1));
  append_no_truth(unknown);
  BOOST_TEST(names(known) == names(unknown), boost::test_tools::per_element());
  BOOST_TEST(value(known, "face_f1_50") == "1");
  BOOST_TEST(value(known, "orthogonal_kept_exact") == "1");
  BOOST_TEST(value(known, "parallel_kept_exact") == ""); // there is no such pair
  BOOST_TEST(value(unknown, "face_f1_50") == "");
}

// Zeros would look better than what any detector finds.
BOOST_AUTO_TEST_CASE(what_finds_nothing_is_not_the_best)
{
  Detection nothing{std::vector<std::int32_t>(10, -1), {}};
  std::vector<Vec> points(10, Vec{1, 0, 0});
  Truth truth{{0, 0, 0, 0, 1, 1, 1, 1, -1, -1}, two_planes};
  Row row;
  append_criteria(row, evaluate(points, {}, nothing, {0.5, 25}));
  append_truth(row, evaluate_truth(truth, nothing, {1, {0, 0, 0}}, 1));
  for(const char* column : {"complexity_exact", "complexity_relaxed", "mean_distance", "max_distance_in_epsilons",
                            "angle_error_deg", "split_faces", "swallowed_faces", "parallel_false_relaxed"})
    BOOST_TEST(value(row, column) == "", column);
  BOOST_TEST(value(row, "coverage") == "0");
  BOOST_TEST(value(row, "face_f1_50") == "0");
}
