// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the page of the benchmark says of results that were made up: above all,
// that it names every peer that is better.

#undef NDEBUG

#define BOOST_TEST_MODULE benchmark_page
#include <boost/test/included/unit_test.hpp>

#include "report/page_overview.h"
#include "report/page_targets.h"

using namespace CGAL::Tandem::benchmark;

namespace {

struct Made_up {
  std::string method, cleaned;
  double seconds, coverage, bytes_per_point;
  int beyond;
};

Row row_of(const Made_up& m, const std::string& cloud = "hut")
{
  Row row;
  append_cell(row, "cloud", cloud);
  append_cell(row, "points", 200000);
  append_cell(row, "normals", "given");
  append_cell(row, "method", m.method);
  append_cell(row, "description", "the " + m.method);
  append_cell(row, "cleaned", m.cleaned);
  append_cell(row, "finished", true);
  append_cell(row, "seconds", m.seconds);
  append_cell(row, "bytes_per_point", m.bytes_per_point);
  append_cell(row, "coverage", m.coverage);
  append_cell(row, "beyond_epsilon", m.beyond);
  append_cell(row, "beyond_either", m.beyond);
  append_cell(row, "same_result", true);
  append_cell(row, "hash", m.method.substr(0, 6));
  return row;
}

const Made_up tandem{"tandem", "false", 1, 0.8, 180, 0};
const Made_up sloppy{"growing", "false", 10, 0.9, 90, 7};
const Made_up cleaned_one{"growing", "true", 0.5, 0.7, 90, 0};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

BOOST_AUTO_TEST_CASE(pieces_of_html)
{
  BOOST_TEST(html::base64("") == "");
  BOOST_TEST(html::base64("f") == "Zg==");
  BOOST_TEST(html::base64("fo") == "Zm8=");
  BOOST_TEST(html::base64("foo") == "Zm9v");
  BOOST_TEST(html::base64(std::string("\x00\xff\x80", 3)) == "AP+A");
  BOOST_TEST(html::escaped("a<b & \"c\"") == "a&lt;b &amp; &quot;c&quot;");
  BOOST_TEST(html::tag("td class=x", "y") == "<td class=x>y</td>");
  BOOST_TEST(html::grouped("1234567.25") == "1,234,567.25");
  BOOST_TEST(html::grouped("-1234") == "-1,234");
  BOOST_TEST(html::grouped("999") == "999");
  BOOST_TEST(html::rounded(0.01234) == "0.0123");
  BOOST_TEST(html::rounded(12.345) == "12.3");
  BOOST_TEST(html::rounded(0) == "0");
  BOOST_TEST(html::breakable("a_b_") == "a_<wbr>b_<wbr>");
}

BOOST_AUTO_TEST_CASE(a_better_peer_is_named_with_its_violations)
{
  std::string text = others_ahead(results_of_clouds({row_of(tandem), row_of(sloppy), row_of(cleaned_one)}).front());
  BOOST_TEST(has(text, "coverage (%), Tandem <b>80.0</b>: the growing&dagger; <b>90.0</b>"));
  BOOST_TEST(has(text, "peak memory"));
  BOOST_TEST(!has(text, "time")); // the cleaned result was not run by itself
  BOOST_TEST(!has(text, "points beyond epsilon"));
  text = others_ahead(results_of_clouds({row_of(tandem), row_of({"growing", "false", 1, 0.8, 180, 0})}).front());
  BOOST_TEST(has(text, "In no criterion"));
}

BOOST_AUTO_TEST_CASE(the_best_and_the_better_are_marked)
{
  Cloud_results hut = results_of_clouds({row_of(tandem), row_of(sloppy)}).front();
  Criterion seconds = shown_criteria().front();
  BOOST_TEST(is_best(seconds, hut.methods[0], hut));
  BOOST_TEST(!is_best(seconds, hut.methods[1], hut));
  BOOST_TEST(has(row_of_method(hut.methods[1], hut), "10.0&times;"));
  BOOST_TEST(has(row_of_method(hut.methods[1], hut), "&#9650;</span><strong>90.0"));
  BOOST_TEST(!has(row_of_method(hut.methods[0], hut), "&#9650;"));
}

BOOST_AUTO_TEST_CASE(overview_counts_clouds)
{
  std::vector<Row> rows = {row_of(tandem), row_of(sloppy), row_of(tandem, "barn"),
                           row_of({"growing", "false", 0.5, 0.7, 190, 0}, "barn")};
  std::string text = overview(results_of_clouds(rows));
  BOOST_TEST(has(text, "<td>10.0&times;</td>"));
  BOOST_TEST(has(text, "<td class=ahead>0.500&times;</td>"));
  BOOST_TEST(has(text, "coverage (%)</th><td class=ahead>1 of 2</td>"));
  BOOST_TEST(has(text, "points beyond epsilon</th><td class=none>0</td>"));
}

BOOST_AUTO_TEST_CASE(targets_count_floor_and_goal)
{
  Target faster{"faster", "", 8, 20, true, 0};
  BOOST_TEST(has(verdict(faster, {9, 30}), "class=floor>floor on 2, goal on 1 of 2"));
  BOOST_TEST(has(verdict(faster, {5, 30}), "class=missed>floor on 1, goal on 1 of 2"));
  BOOST_TEST(has(verdict(faster, {20, 30}), "goal reached"));
  BOOST_TEST(has(verdict(faster, {5}), "class=missed>missed"));
  BOOST_TEST(has(verdict({"less", "", 8, 2, false, 0}, {5}), "class=floor>floor reached"));
  BOOST_TEST(range_of(faster, {30, 5, 10}) == "5 to 30, median 10");
  BOOST_TEST(has(row_of_target(faster, {}), "not measured"));
}

BOOST_AUTO_TEST_CASE(targets_are_measured)
{
  std::vector<Row> rows = {row_of(tandem), row_of(sloppy)}, none;
  BOOST_TEST(has(Target_table(results_of_clouds(rows), none).text(), "<td>10.0&times;</td><td class=floor>"));
  Made_up wrong{"tandem-sequential", "false", 1, 0.8, 180, 3};
  rows.push_back(row_of(wrong));
  rows.back().back().second = "another hash";
  std::string text = Target_table(results_of_clouds(rows), none).text();
  BOOST_TEST(has(text, "0 to 3, median 2</td><td class=missed>"));
  BOOST_TEST(has(text, "orders of the points</th><td>&le; 0</td><td>&le; 0</td><td>1</td><td class=missed>"));
}
