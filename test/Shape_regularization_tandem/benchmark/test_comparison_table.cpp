// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of a comparison: above all, it marks every method that is better.

#include "testing/checks.h"

#include "experiments/comparison_table.h"

#include <boost/test/unit_test.hpp>

#include <map>

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
  append_cell(row, "top_10_shapes", m.coverage - .1);
  append_cell(row, "beyond_epsilon", m.beyond);
  return row;
}

// The texts under these titles, beside the first one.
void check_shown(const std::vector<Summary>& all, std::size_t i, const std::map<std::string, std::string>& expected)
{
  std::size_t found = 0;
  for(const Criterion& c : shown_criteria)
    if(const auto e = expected.find(c.title); e != expected.end()) {
      ++found;
      BOOST_TEST(marked(c, all.at(i), all.at(0)) == e->second, i << ": " << c.title);
    }
  BOOST_TEST(found == expected.size());
}

BOOST_AUTO_TEST_CASE(better_methods_are_marked)
{
  const std::vector<Summary> all =
    summaries({row_of({"tandem", "false", 2, .8, 0}), row_of({"peer", "false", 3, .9, 7}),
               row_of({"peer", "true", 1, .7, 0}), row_of({"fast", "false", 1, .8, 0})});
  BOOST_REQUIRE_EQUAL(all.size(), 4u);
  BOOST_TEST(cell(all[1].first(), "description") == "the peer");
  check_shown(all, 0, {{"seconds", "2.00"}, {"cover.%", "80.0"}, {"top10%", "70.0"}});
  check_shown(all, 1, {{"seconds", "3.00"}, {"cover.%", "90.0*"}, {"top10%", "80.0*"}, {">eps", "7"}});
  check_shown(all, 2, {{"seconds", "-"}, {"cover.%", "70.0"}}); // a cleaned result was not run by itself
  check_shown(all, 3, {{"seconds", "1.00*"}, {"cover.%", "80.0"}, {"F1", "-"}});
}

BOOST_AUTO_TEST_CASE(runs_are_summarized_by_their_median)
{
  Row failed = row_of({"fast", "false", 0, 0, 0});
  failed[4].second = "false";
  const std::vector<Summary> all =
    summaries({row_of({"tandem", "false", 9, .8, 0}), row_of({"tandem", "false", 1, .8, 0}),
               row_of({"tandem", "false", 2, .8, 0}), row_of({"peer", "false", 3, .8, 0}), failed});
  BOOST_REQUIRE_EQUAL(all.size(), 3u);
  check_shown(all, 0, {{"seconds", "2.00"}});
  check_shown(all, 1, {{"seconds", "3.00"}});
  check_shown(all, 2, {{"seconds", "-"}});
}

BOOST_AUTO_TEST_SUITE_END()
