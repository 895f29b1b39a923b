// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outlines of the shapes: of scenes whose areas are known, of points of all sorts in a plane, and of random ones,
// which must become simple polygons that have nothing in common.

#include "testing/test_support.h"

#include "outlines/many_shapes.h"

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <CGAL/Polygon_2_algorithms.h>

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>

#include <cmath>
#include <string>

BOOST_AUTO_TEST_SUITE(test_polygons)

using outlines::Outline_vertex;
using outlines::Polygon;
using Flat = outlines::Kernel::Point_2;
using Areas = CGAL::Tandem::Shape_polygons_3<Kernel>;

// --- Validity

double signed_area(const std::vector<Flat>& loop)
{
  double area = 0;
  for(std::size_t i = 0; i < loop.size(); ++i) {
    const Flat &p = loop[i], &q = loop[(i + 1) % loop.size()];
    area += (p.x() - loop[0].x()) * (q.y() - loop[0].y()) - (p.y() - loop[0].y()) * (q.x() - loop[0].x());
  }
  return area / 2;
}

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
    return signed_area(loops.back());
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

// --- Points in a plane

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

// --- Shapes

constexpr double sigma = .004;

// Turned about the z axis, and far from the origin.
Kernel::Point_3 placed(double x, double y, double z)
{
  return Kernel::Point_3(.8 * x - .6 * y + 4.5e5, .6 * x + .8 * y, z);
}

bool is_floor(double x, double y) { return x < 3 || y < 2; }
bool is_window(double x, double z) { return x > 2 && x < 3.5 && z > 1 && z < 2.2; }

// An L-shaped floor of 18 square meters, and a wall of 16.2 beside it.
Cloud make_scene()
{
  Cloud points;
  Generator g{std::mt19937(7)};
  std::normal_distribution<double> noise(0, sigma);
  for(int i = 0; i < 30000; ++i) {
    const double x = 6 * g.unit(), y = 4 * g.unit(), z = 3 * g.unit();
    if(is_floor(x, y))
      points.emplace_back(placed(x, y, noise(g.random)), Kernel::Vector_3(0, 0, 1));
    if(!is_window(x, z))
      points.emplace_back(placed(x, noise(g.random), z), Kernel::Vector_3(-.6, .8, 0));
  }
  return points;
}

double distance(const Shapes& shapes, std::size_t s, const Kernel::Point_3& p)
{
  const auto& c = shapes.coefficients(s);
  return std::fabs(std::fma(c[0], p.x(), std::fma(c[1], p.y(), std::fma(c[2], p.z(), c[3]))));
}

// The longest edge that lies on both planes.
double longest_common_edge(const Shapes& shapes, const Areas& areas, std::size_t s)
{
  const auto& outer = areas.polygons(s)[0].outer;
  double longest = 0;
  for(std::size_t i = 0; i < outer.size(); ++i) {
    const auto &p = areas.points()[outer[i]], &q = areas.points()[outer[(i + 1) % outer.size()]];
    constexpr double rounding = 1e-10; // of coordinates of 4.5e5
    if((std::max)({distance(shapes, 0, p), distance(shapes, 1, p), distance(shapes, 0, q), distance(shapes, 1, q)}) <
       rounding)
      longest = (std::max)(longest, std::sqrt(CGAL::squared_distance(p, q)));
  }
  return longest;
}

BOOST_AUTO_TEST_CASE(areas_of_a_scene)
{
  const Cloud points = make_scene();
  const Shapes shapes = detect(points, make_parameters(.02, 300));
  CHECK_AT(shapes.number_of_shapes() == 2, std::to_string(shapes.number_of_shapes()));
  const Areas areas = CGAL::Tandem::polygons(shapes, points, CGAL::Tandem::parameters::point_map(First<Kernel>()));
  for(std::size_t s = 0; s < 2; ++s) {
    const bool is_wall = std::fabs(shapes.coefficients(s)[2]) < .5;
    CHECK_AT(areas.polygons(s).size() == 1 && areas.polygons(s)[0].holes.size() == (is_wall ? 1 : 0),
             std::to_string(areas.polygons(s).size()));
    CHECK_AT(std::fabs(areas.area(s) / (is_wall ? 16.2 : 18) - 1) < .02, std::to_string(areas.area(s)));
    CHECK_AT(longest_common_edge(shapes, areas, s) > 5.8, std::to_string(longest_common_edge(shapes, areas, s)));
    for(std::uint32_t v : areas.polygons(s)[0].outer)
      CHECK(distance(shapes, s, areas.points()[v]) < 1e-10);
  }
  CHECK_AT(areas.points().size() < 200, std::to_string(areas.points().size()));
}

// --- Many shapes

// Where ten times as many shapes are, the work is ten times as much.
BOOST_AUTO_TEST_CASE(work_grows_with_the_shapes)
{
  const auto work = [](const Many_shapes& scene) {
    const outlines::Border_finder finder(scene.shapes, outlines::Unit(scene.points, scene.shapes), scene.all);
    std::size_t sum = 0, borders = 0;
    for(std::size_t s = 0; s < scene.all.size(); ++s) {
      outlines::Straight_borders of_shape;
      borders += finder.pieces_of(s, of_shape).size();
      sum += of_shape.comparisons;
    }
    CHECK(borders > scene.all.size() / 2);
    return double(sum);
  };
  for(const bool has_floor : {false, true}) {
    constexpr int number = is_sanitized ? 100 : 1000;
    const double few = work(Many_shapes(number, has_floor)), many = work(Many_shapes(10 * number, has_floor));
    CHECK_AT(many < 11 * few, std::to_string(few) + ' ' + std::to_string(many));
  }
}

BOOST_AUTO_TEST_SUITE_END()
