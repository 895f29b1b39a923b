// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outlines of points in a plane, of all sorts and random ones, which must become simple polygons that have nothing in
// common; and the work that the borders between many shapes are.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/models/outlines/Border_finder.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation.h>

#include <CGAL/Polygon_2_algorithms.h>

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>

#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(test_polygons)

namespace outlines = CGAL::Tandem::internal::outlines;
using outlines::Outline_vertex;
using outlines::Polygon;
using Flat = outlines::Kernel::Point_2;

// Loops are simple, and have no point in common.
void check_apart(const std::vector<std::vector<Flat>>& loops, const std::string& where)
{
  using Segment = outlines::Kernel::Segment_2;
  const auto edge = [](const std::vector<Flat>& l, std::size_t i) { return Segment(l[i], l[(i + 1) % l.size()]); };
  for(std::size_t a = 0; a < loops.size(); ++a) {
    CHECK_AT(CGAL::is_simple_2(loops[a].begin(), loops[a].end(), outlines::Kernel()), where);
    for(std::size_t b = 0; b < a; ++b)
      for(std::size_t i = 0; i < loops[a].size(); ++i)
        for(std::size_t j = 0; j < loops[b].size(); ++j)
          CHECK_AT(!CGAL::do_intersect(edge(loops[a], i), edge(loops[b], j)), where);
  }
}

// Returns the area.
double check_valid(const std::vector<Flat>& vertices, const std::vector<Polygon>& polygons, const std::string& where)
{
  std::vector<std::vector<Flat>> loops;
  const auto add = [&](const Polygon::Loop& loop) {
    loops.emplace_back();
    for(std::uint32_t i : loop)
      loops.back().push_back(vertices.at(i));
    CHECK_AT(loop.size() >= 3, where);
    return CGAL::polygon_area_2(loops.back().begin(), loops.back().end(), outlines::Kernel());
  };
  double sum = 0;
  for(const Polygon& polygon : polygons) {
    double area = add(polygon.outer), of_triangles = 0;
    CHECK_AT(area > 0, where);
    for(const Polygon::Loop& hole : polygon.holes) {
      const double of_hole = add(hole);
      CHECK_AT(of_hole < 0, where);
      area += of_hole;
    }
    for(const auto& t : polygon.triangles) {
      CHECK_AT(CGAL::orientation(vertices[t[0]], vertices[t[1]], vertices[t[2]]) == CGAL::LEFT_TURN, where);
      of_triangles += CGAL::area(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    }
    CHECK_AT(std::fabs(of_triangles - area) < 1e-9 * (1 + area), where); // so the holes are inside of this one
    sum += area;
  }
  check_apart(loops, where);
  return sum;
}

struct Result {
  double area;
  std::size_t pieces, holes;
};

Result outline_of(const std::vector<Flat>& points, const std::string& where)
{
  const outlines::Outline_limits limits;
  std::vector<Outline_vertex> vertices;
  std::vector<Polygon> polygons;
  CHECK_AT(outlines::make_polygons(outlines::Outline_triangulation(points).outline(limits), limits.tolerance, vertices,
                                   polygons),
           where);
  std::vector<Flat> corners;
  for(const Outline_vertex& v : vertices)
    corners.push_back(v.point);
  Result result = {check_valid(corners, polygons, where), polygons.size(), 0};
  for(const Polygon& polygon : polygons)
    result.holes += polygon.holes.size();
  return result;
}

struct Rectangle {
  double x, y, width, height;
};

struct Generator {
  std::mt19937 random;
  double unit() { return random_unit(random); }

  void add(std::vector<Flat>& points, int n, const Rectangle& r)
  {
    for(int i = 0; i < n; ++i) {
      const double u = unit(), v = unit();
      points.emplace_back(r.x + r.width * u, r.y + r.height * v);
    }
  }
};

BOOST_AUTO_TEST_CASE(points_in_a_plane)
{
  Generator g{std::mt19937(5)};
  std::vector<Flat> step, apart, line, equal(50, Flat(1, 2)), crossed;
  g.add(step, 20000, {0, 0, 1, 1});
  g.add(step, 800, {1, 0, 1, 1}); // five times as far apart
  const Result one = outline_of(step, "density");
  CHECK_AT(one.pieces == 1 && one.holes == 0 && std::fabs(one.area / 2 - 1) < .05,
           std::to_string(one.pieces) + ' ' + std::to_string(one.holes) + ' ' + std::to_string(one.area));
  g.add(apart, 4000, {0, 0, 1, 1});
  g.add(apart, 4000, {1.2, 0, 1, 1});
  const Result two = outline_of(apart, "apart");
  CHECK_AT(two.pieces == 2 && two.holes == 0 && std::fabs(two.area / 2 - 1) < .05, std::to_string(two.pieces));
  g.add(apart, 3, {1.05, .1, .1, .8}); // stray points between them
  CHECK(outline_of(apart, "stray").pieces == 2);
  for(int i = 0; i < 100; ++i)
    line.emplace_back(.1 * i, .3 * i);
  for(const auto& points : {line, equal, std::vector<Flat>{}, std::vector<Flat>{{0, 0}, {1, 0}, {0, 1}}})
    CHECK(outline_of(points, "degenerate").pieces == 0);
}

// Clusters of all densities, lines, lattices and equal points.
BOOST_DATA_TEST_CASE(random_points, boost::unit_test::data::xrange(60), run)
{
  Generator g{std::mt19937(unsigned(run))};
  std::vector<Flat> points;
  for(int i = 0; i < 6; ++i) {
    const int n = int(400 * g.unit());
    g.add(points, n, {g.unit(), g.unit(), g.unit() * g.unit(), g.unit() * g.unit()});
  }
  if(run % 3 == 0)
    for(int i = 0; i < 300; ++i)
      points.emplace_back(i % 20 * .05, i / 20 * .05);
  if(run % 4 == 0)
    points.insert(points.end(), points.begin(), points.begin() + 20);
  outline_of(points, "run " + std::to_string(run));
}

// What it is to find the borders of walls of 1 x 1 that stand on one floor, in rows, each in one plane.
double work(std::size_t walls)
{
  CGAL::Tandem::internal::Shapes_data data;
  data.parameters.maximum_distance = .01;
  data.coefficients = {{0, 0, 1, 0}};
  data.parallel_group = data.coplanar_group = {0};
  std::vector<outlines::Kernel::Point_3> points;
  std::vector<std::int32_t> labels;
  const double row = std::floor(std::sqrt(double(walls)));
  for(std::size_t i = 0; i < walls; ++i) {
    const double x = 2 * std::fmod(double(i), row), y = 2 * std::floor(double(i) / row);
    for(int k = 0; k < 64; ++k) {
      const double u = k % 8 / 7., v = k / 8 / 7.;
      points.emplace_back(x + u, y + v, 0);
      points.emplace_back(x + u, y, v);
      labels.insert(labels.end(), {0, std::int32_t(i + 1)});
    }
    data.coefficients.push_back({0, 1, 0, -y});
    data.parallel_group.push_back(1);
    data.coplanar_group.push_back(1 + int(y / 2));
  }
  data.shape_of = std::move(labels);
  data.is_flipped.resize(walls + 1);
  const outlines::Shapes shapes(data);
  const outlines::Unit unit(points, shapes);
  std::vector<outlines::Shape_points> all;
  for(std::size_t s = 0; s <= walls; ++s) {
    all.push_back({outlines::Plane_frame(shapes, s, unit.in(points[*shapes.points(s).begin()])), {}, {}, {}});
    for(std::uint32_t i : shapes.points(s))
      all.back().points.push_back(unit.in(points[i]));
    all.back().spacing.assign(all.back().points.size(), float(unit.in(1 / 7.)));
  }
  const outlines::Border_finder finder(shapes, unit, all);
  std::size_t comparisons = 0, borders = 0;
  for(std::size_t s = 0; s <= walls; ++s) {
    outlines::Straight_borders of_shape;
    borders += finder.pieces_of(s, of_shape).size();
    comparisons += of_shape.comparisons;
  }
  CHECK(borders > walls / 2);
  return double(comparisons);
}

// Where ten times as many shapes are, the work is ten times as much.
BOOST_AUTO_TEST_CASE(work_grows_with_the_shapes)
{
  constexpr int walls = is_sanitized ? 100 : 1000;
  const double few = work(walls), many = work(10 * walls);
  CHECK_AT(many < 11 * few, std::to_string(few) + ' ' + std::to_string(many));
}

BOOST_AUTO_TEST_SUITE_END()
