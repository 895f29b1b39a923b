// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of a comparison: above all, it marks every method that is better.

#include "testing/checks.h"

#include "experiments/comparison_table.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(test_comparison_table)

using namespace CGAL::Tandem::benchmark;

struct Made_up {
  const char *method, *is_cleaned;
  double seconds, coverage;
  int beyond;
};

Row row_of(const Made_up& m)
{
  Row row;
  append_cell(row, "cloud", "hut");
  append_cell(row, "method", m.method);
  append_cell(row, "description", std::string("the ") + m.method);
  append_cell(row, "cleaned", m.is_cleaned);
  append_cell(row, "finished", true);
  append_cell(row, "seconds", m.seconds);
  append_cell(row, "coverage", m.coverage);
  append_cell(row, "beyond_epsilon", m.beyond);
  append_cell(row, "points_relabeled", 0);
  return row;
}

// The text under a title, beside the reference.
std::string shown(const Summary& summary, const Summary& reference, const std::string& title)
{
  const auto found = std::find_if(std::begin(shown_criteria), std::end(shown_criteria),
                                  [&](const Criterion& c) { return c.title == title; });
  BOOST_REQUIRE(found != std::end(shown_criteria));
  return marked(*found, summary, reference);
}

BOOST_AUTO_TEST_CASE(better_methods_are_marked)
{
  const std::vector<Summary> all =
    summaries({row_of({"tandem", "false", 2, .8, 0}), row_of({"peer", "false", 3, .9, 7}),
               row_of({"peer", "true", 1, .7, 0}), row_of({"fast", "false", 1, .8, 0})});
  BOOST_REQUIRE_EQUAL(all.size(), 4u);
  BOOST_TEST(shown(all[0], all[0], "seconds") == "2.00");
  BOOST_TEST(shown(all[0], all[0], "cover.%") == "80.0");
  BOOST_TEST(cell(all[1].first(), "description") == "the peer");
  BOOST_TEST(shown(all[1], all[0], "seconds") == "3.00");
  BOOST_TEST(shown(all[1], all[0], "cover.%") == "90.0*");
  BOOST_TEST(shown(all[1], all[0], ">eps") == "7");
  BOOST_TEST(shown(all[2], all[0], "seconds") == "-"); // a cleaned result was not run by itself
  BOOST_TEST(shown(all[2], all[0], "cover.%") == "70.0");
  BOOST_TEST(shown(all[3], all[0], "seconds") == "1.00*");
  BOOST_TEST(shown(all[3], all[0], "cover.%") == "80.0");
  BOOST_TEST(shown(all[3], all[0], "F1") == "-");
}

BOOST_AUTO_TEST_CASE(runs_are_summarized_by_their_median)
{
  const std::vector<Summary> all =
    summaries({row_of({"tandem", "false", 9, .8, 0}), row_of({"tandem", "false", 1, .8, 0}),
               row_of({"tandem", "false", 2, .8, 0}), row_of({"peer", "false", 3, .8, 0})});
  BOOST_REQUIRE_EQUAL(all.size(), 2u);
  BOOST_TEST(shown(all[0], all[0], "seconds") == "2.00");
  BOOST_TEST(shown(all[0], all[0], "again%") == "0.0");
  BOOST_TEST(shown(all[1], all[0], "seconds") == "3.00");
  BOOST_TEST(shown(all[1], all[0], "again%") == "-"); // it ran once
  Row failed = row_of({"peer", "false", 0, 0, 0});
  failed[4].second = "false";
  BOOST_TEST(shown(Summary(failed), all[0], "seconds") == "-");
}

BOOST_AUTO_TEST_SUITE_END()
