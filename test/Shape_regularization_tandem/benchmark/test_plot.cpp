// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the plots of the experiments show: means over repeats, least times, steps
// in the order of the rows, and no point where a value is not known.

#undef NDEBUG

#define BOOST_TEST_MODULE plot
#include <boost/test/included/unit_test.hpp>

#include "report/plot.h"

using namespace CGAL::Tandem::benchmark;

namespace {

Row row(const char* method, const char* step, const char* value)
{
  return {{"method", method}, {"step", step}, {"value", value}};
}

const std::vector<Row> rows = {row("b", "8", "1"), row("b", "8", "4"), row("b", "2", "7"), row("a", "8", "3"),
                               row("a", "2", "")};

} // namespace

BOOST_AUTO_TEST_CASE(means_and_least)
{
  std::vector<Series> mean = Series_table(rows, "method", "step")("step", "value", true);
  BOOST_REQUIRE_EQUAL(mean.size(), 2u);
  BOOST_TEST(mean[0].name == "b");
  BOOST_REQUIRE_EQUAL(mean[0].points.size(), 2u);
  BOOST_TEST(mean[0].points[0].x == 8);
  BOOST_TEST(mean[0].points[0].y == 2.5);
  BOOST_TEST(mean[0].points[0].mark == "8");
  BOOST_TEST(mean[0].points[1].x == 2);
  BOOST_TEST(mean[1].name == "a");
  BOOST_REQUIRE_EQUAL(mean[1].points.size(), 1u);
  BOOST_TEST(mean[1].points[0].y == 3);
  std::vector<Series> least = Series_table(rows, "method", "step", Repeats::least)("step", "value");
  BOOST_TEST(least[0].points[0].y == 1);
  BOOST_TEST(least[0].points[0].mark == "");
}

BOOST_AUTO_TEST_CASE(the_script_has_all_panels_and_names)
{
  const Axis x{"steps"}, time{"time (s)", true}, share{"coverage (%)", false, true};
  const Series_table table(rows, "method", "step");
  std::ostringstream out;
  write_script(out, {"A \"plot\"", {{x, time, table("step", "value")}, {x, share, table("step", "value")}}}, "a.svg");
  const std::string script = out.str();
  for(const char* part : {"\"A \\\"plot\\\"\"", "set output \"a.svg\"", "set ylabel \"time (s)\"", "set logscale y",
                          "set ylabel \"coverage (%)\"", "unset logscale y", "set yrange [0:*]", "$p0_0 << EOD\n8 2.5",
                          "$p1_1 << EOD\n8 3 "})
    BOOST_TEST(script.find(part) != std::string::npos, part);
}
