// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curves of the largest shapes and planes, on cases counted by hand.

#undef NDEBUG

#define BOOST_TEST_MODULE criteria_curves
#include <boost/test/unit_test.hpp>

#include "evaluate_columns.h"

using namespace CGAL::Tandem::benchmark;

namespace {

const auto within = boost::test_tools::tolerance(1e-12);
const Tolerances tolerances = {.25, 30};

// Points at given heights, upright, with a label each.
struct Case {
  std::vector<Vec> points, normals;
  Detection detection;

  void add(int n, double height, std::int32_t label, const Vec& normal = {0, 0, 1})
  {
    for(int i = 0; i < n; ++i) {
      points.push_back({double(points.size()), 0, height});
      normals.push_back(normal);
      detection.label.push_back(label);
    }
  }

  Curves curves() const { return evaluate_curves(points, normals, detection, tolerances); }
};

// 100 points: 50 and 20 in one plane across a gap, 20 in a parallel one, 10 free.
Case floors()
{
  Case c;
  c.add(20, 0, 0);
  c.add(50, 0, 1);
  c.add(20, 2, 2);
  c.add(10, 9, -1);
  c.detection.planes = {{{0, 0, 1}, 0}, {{0, 0, -1}, 0}, {{0, 0, 1}, -2}};
  return c;
}

} // namespace

BOOST_AUTO_TEST_CASE(largest_first)
{
  const Curves curves = floors().curves();
  BOOST_TEST(curves.shapes.size() == 3u);
  BOOST_TEST(curves.shapes.top(0) == 0., within);
  BOOST_TEST(curves.shapes.top(1) == .5, within);
  BOOST_TEST(curves.shapes.top(2) == .7, within);
  BOOST_TEST(curves.shapes.top(99) == .9, within);
  BOOST_TEST(curves.shapes.area(4) == (.5 + .7 + .9 + .9) / 4, within);
  BOOST_TEST(curves.planes.size() == 2u);
  BOOST_TEST(curves.planes.top(1) == .7, within);
  BOOST_TEST(curves.planes.area(2) == .8, within);
}

BOOST_AUTO_TEST_CASE(shapes_and_freedom_for_a_coverage)
{
  const Curves curves = floors().curves();
  BOOST_TEST(curves.needed[0].shapes == 1u); // 50 %
  BOOST_TEST(curves.needed[0].degrees_of_freedom == 3u);
  BOOST_TEST(curves.needed[1].shapes == 2u); // 60 %: of one plane
  BOOST_TEST(curves.needed[1].degrees_of_freedom == 3u);
  BOOST_TEST(curves.needed[3].shapes == 3u); // 80 %: two offsets, one direction
  BOOST_TEST(curves.needed[3].degrees_of_freedom == 4u);
  Case few = floors();
  few.add(100, 9, -1);
  BOOST_TEST(few.curves().needed[0].shapes == 0u); // 45 % are not 50 %
}

// Points beyond epsilon or alpha count for no detector.
BOOST_AUTO_TEST_CASE(misfits_do_not_count)
{
  Case c = floors();
  c.add(60, .26, 1);
  c.add(30, 2, 2, {0, 1, 1});
  c.add(10, 2.25, 2);
  const Curves curves = c.curves();
  BOOST_TEST(curves.shapes.top(1) == 50. / 200, within);
  BOOST_TEST(curves.shapes.top(2) == 80. / 200, within);
  BOOST_TEST(curves.shapes.top(3) == 100. / 200, within);
  Case without_normals = c;
  without_normals.normals.clear();
  BOOST_TEST(without_normals.curves().shapes.top(1) == 60. / 200, within);
  c.detection.planes.push_back({{1, 0, 0}, 0}); // without points
  BOOST_TEST(c.curves().shapes.size() == 3u);
}

// Planes that nearly agree are one, if nine tenths of the points of the smaller shape fit the plane of the larger one.
BOOST_AUTO_TEST_CASE(planes_are_distinct_by_their_points)
{
  for(int misfits : {1, 2}) {
    Case c;
    c.add(30, 0, 0);
    c.add(10 - misfits, .2, 1);
    c.add(misfits, .3, 1);
    c.detection.planes = {{{0, 0, 1}, 0}, {{0, 0, 1}, -.25}};
    BOOST_TEST(c.curves().planes.size() == std::size_t(misfits));
  }
}

BOOST_AUTO_TEST_CASE(nothing_found)
{
  Case c;
  c.add(5, 0, -1);
  const Curves curves = c.curves();
  BOOST_TEST(curves.shapes.size() == 0u);
  BOOST_TEST(curves.planes.top(10) == 0., within);
  BOOST_TEST(curves.shapes.area(100) == 0., within);
  Row row;
  append_curves(row, curves);
  for(const auto& cell : row)
    BOOST_TEST((cell.second.empty() || cell.second == "0"), cell.first + " " + cell.second);
  append_curves(row, Case().curves());
}
