// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines at which known rectangles meet: edges, crossings, holes and corners.

#include "testing/test_support.h"

#include <CGAL/Shape_regularization_tandem/lines.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_lines)

namespace np = CGAL::Tandem::parameters;
using Lines = CGAL::Tandem::Shape_lines_3<Kernel>;
using Point = Kernel::Point_3;

const auto maps = np::point_map(First<Kernel>()).normal_map(Second<Kernel>());
constexpr double spacing = .05;

struct Side {
  double low, high;
};

// Rectangles across an axis, each of which is a plane of its own, with points at the centers of squares.
struct Scene {
  Cloud cloud;
  std::vector<CGAL::Tandem::Coefficients> planes;

  // `is_hole(point)` tells where there is none. `normal` is 1 or -1, along the axis.
  template <class Is_hole>
  void add(int axis, double place, const Side& first, const Side& second, Is_hole is_hole)
  {
    CGAL::Tandem::Coefficients plane = {0, 0, 0, -place};
    plane[std::size_t(axis)] = 1;
    planes.push_back(plane);
    for(double u = first.low + spacing / 2; u < first.high; u += spacing)
      for(double v = second.low + spacing / 2; v < second.high; v += spacing) {
        std::array<double, 3> p;
        p[std::size_t(axis)] = place;
        p[std::size_t((axis + 1) % 3)] = u;
        p[std::size_t((axis + 2) % 3)] = v;
        const Point point(p[0], p[1], p[2]);
        if(!is_hole(point))
          cloud.emplace_back(point, Kernel::Vector_3(plane[0], plane[1], plane[2]));
      }
  }

  void add(int axis, double place, const Side& first, const Side& second)
  {
    add(axis, place, first, second, [](const Point&) { return false; });
  }

  Shapes shapes() const
  {
    return CGAL::Tandem::shapes_of_planes(planes, cloud,
                                          maps.maximum_distance(.02).maximum_angle(20).minimum_region_size(20));
  }

  Lines lines() const { return CGAL::Tandem::lines(shapes(), cloud, maps); }
};

std::string text_of(const Lines& lines)
{
  std::string result;
  for(const auto& s : lines.segments) {
    std::ostringstream out;
    out << s.shapes[0] << '-' << s.shapes[1] << ": " << lines.points[s.ends[0]] << " to " << lines.points[s.ends[1]]
        << " (" << s.sides[0] << ", " << s.sides[1] << ")\n";
    result += out.str();
  }
  return result;
}

// Where the outlines follow points, places are known to a spacing.
void check_segment(const Lines& lines, std::size_t i, const Point& first, const Point& last, double tolerance = spacing)
{
  const auto& ends = lines.segments.at(i).ends;
  CHECK_AT(CGAL::squared_distance(lines.points[ends[0]], first) <= tolerance * tolerance, text_of(lines));
  CHECK_AT(CGAL::squared_distance(lines.points[ends[1]], last) <= tolerance * tolerance, text_of(lines));
}

void check_sides(const Lines& lines, std::size_t i, const std::array<int, 2>& sides)
{
  CHECK_AT(lines.segments.at(i).sides == sides, text_of(lines));
}

// --- Two shapes

// They end at each other, on the side of the normals.
BOOST_AUTO_TEST_CASE(test_edge)
{
  Scene scene;
  scene.add(2, 0, {0, 4}, {0, 3});  // x, y
  scene.add(0, 0, {.5, 2}, {0, 2}); // y, z
  const Lines lines = scene.lines();
  CHECK_AT(lines.segments.size() == 1 && lines.corners.empty() && lines.points.size() == 2, text_of(lines));
  check_segment(lines, 0, {0, .5, 0}, {0, 2, 0});
  check_sides(lines, 0, {1, 1});
  for(const Point& p : lines.points)
    CHECK_AT(p.x() == 0 && p.z() == 0, text_of(lines));
}

// One ends inside of the other one, below and above it.
BOOST_AUTO_TEST_CASE(test_junction)
{
  for(const double bottom : {0., -1.5}) {
    Scene scene;
    scene.add(2, 0, {0, 4}, {0, 3});
    scene.add(0, 2, {.5, 2.5}, {bottom, bottom + 1.5});
    const Lines lines = scene.lines();
    CHECK_AT(lines.segments.size() == 1 && lines.corners.empty(), text_of(lines));
    check_segment(lines, 0, {2, .5, 0}, {2, 2.5, 0});
    check_sides(lines, 0, {0, bottom < 0 ? -1 : 1});
  }
}

BOOST_AUTO_TEST_CASE(test_crossing)
{
  Scene scene;
  scene.add(2, 0, {0, 4}, {0, 3});
  scene.add(0, 2, {.5, 4}, {-1, 1});
  const Lines lines = scene.lines();
  CHECK_AT(lines.segments.size() == 1 && lines.corners.empty(), text_of(lines));
  check_segment(lines, 0, {2, .5, 0}, {2, 3, 0});
  check_sides(lines, 0, {0, 0});
}

// There is a line on both sides of a hole.
BOOST_AUTO_TEST_CASE(test_hole)
{
  Scene scene;
  scene.add(2, 0, {0, 4}, {0, 3}, [](const Point& p) { return p.x() > 1.5 && p.x() < 2.5 && p.y() > 1 && p.y() < 2; });
  scene.add(0, 2, {.25, 2.75}, {-1, 1});
  const Lines lines = scene.lines();
  CHECK_AT(lines.segments.size() == 2 && lines.corners.empty(), text_of(lines));
  check_segment(lines, 0, {2, .25, 0}, {2, 1, 0});
  check_segment(lines, 1, {2, 2, 0}, {2, 2.75, 0});
}

// Neither shapes that are apart, nor those that touch in a point, nor parallel ones have a line.
BOOST_AUTO_TEST_CASE(test_no_line)
{
  Scene scene;
  scene.add(2, 0, {0, 4}, {0, 3});
  scene.add(0, 2, {.5, 2.5}, {.5, 1.5});
  scene.add(0, 5, {.5, 2.5}, {-1, 1});
  scene.add(2, -2, {0, 4}, {0, 3});
  scene.add(1, 3, {0, 1}, {4, 5}); // z, x
  const Lines lines = scene.lines();
  CHECK_AT(lines.segments.empty() && lines.corners.empty() && lines.points.empty(), text_of(lines));
}

// --- Corners

// A box has its exact edges and corners, whatever the order of its points.
BOOST_AUTO_TEST_CASE(test_box)
{
  Scene scene;
  const double size[] = {2, 1.6, 1.2};
  for(int axis = 0; axis < 3; ++axis)
    for(double place : {0., size[axis]})
      scene.add(axis, place, {0, size[(axis + 1) % 3]}, {0, size[(axis + 2) % 3]});
  const Lines lines = scene.lines();
  CHECK_AT(lines.segments.size() == 12 && lines.corners.size() == 8 && lines.points.size() == 8, text_of(lines));
  for(std::size_t i = 0; i < lines.segments.size(); ++i) {
    const Point &p = lines.points[lines.segments[i].ends[0]], &q = lines.points[lines.segments[i].ends[1]];
    int differences = 0;
    for(int k = 0; k < 3; ++k) {
      differences += p[k] != q[k];
      CHECK_AT((p[k] == 0 || p[k] == size[k]) && (q[k] == 0 || q[k] == size[k]), text_of(lines));
    }
    CHECK_AT(differences == 1, text_of(lines));
    check_sides(lines, i,
                {lines.points[lines.segments[i].ends[0]][int(lines.segments[i].shapes[1] / 2)] == 0 ? 1 : -1,
                 lines.points[lines.segments[i].ends[0]][int(lines.segments[i].shapes[0] / 2)] == 0 ? 1 : -1});
  }
  std::set<std::vector<std::uint32_t>> all;
  for(const auto& corner : lines.corners) {
    CHECK(corner.shapes.size() == 3 && all.insert(corner.shapes).second);
    for(int k = 0; k < 3; ++k)
      CHECK(lines.points[corner.point][k] == (corner.shapes.at(std::size_t(k)) % 2 == 0 ? 0 : size[k]));
  }
}

// Three rectangles cross inside of each other.
BOOST_AUTO_TEST_CASE(test_corner_inside)
{
  Scene scene;
  scene.add(2, 0, {0, 4}, {0, 3});
  scene.add(0, 2, {0, 3}, {-1, 1});
  scene.add(1, 1.5, {-1, 1}, {0, 4});
  const Lines lines = scene.lines();
  CHECK_AT(lines.segments.size() == 3 && lines.points.size() == 7, text_of(lines));
  CHECK(lines.corners.size() == 1 && lines.corners[0].shapes == std::vector<std::uint32_t>({0, 1, 2}));
  CHECK(lines.points.at(lines.corners.at(0).point) == Point(2, 1.5, 0));
}

// --- Outlines that do not quite end at a line

// Across an axis, without points.
struct Flat_scene {
  CGAL::Tandem::internal::outlines::Polygon_table table;
  CGAL::Tandem::internal::Shapes_data data;

  void add(int axis, double place, const Side& first, const Side& second)
  {
    const auto n = std::uint32_t(table.points.size());
    const Side sides[] = {first, second};
    for(int i = 0; i < 4; ++i) {
      std::array<double, 3> p;
      p[std::size_t(axis)] = place;
      for(int k : {0, 1})
        p[std::size_t((axis + 1 + k) % 3)] = (k == 0 ? i == 1 || i == 2 : i >= 2) ? sides[k].high : sides[k].low;
      table.points.push_back(p);
    }
    table.polygons.push_back({{{n, n + 1, n + 2, n + 3}, {}, {}}});
    CGAL::Tandem::Coefficients plane = {0, 0, 0, -place};
    plane[std::size_t(axis)] = 1;
    data.coplanar_group.push_back(int(data.coefficients.size()));
    data.parallel_group.push_back(axis);
    data.coefficients.push_back(plane);
  }

  auto lines()
  {
    data.parameters.maximum_distance = .1;
    return CGAL::Tandem::internal::outlines::line_table(table, data);
  }
};

// A wall ends just above the floor and just before another wall. It reaches both, and the corner.
BOOST_AUTO_TEST_CASE(test_tolerance)
{
  for(const double gap : {.08, .12}) {
    Flat_scene scene;
    scene.add(2, 0, {0, 4}, {0, 3});
    scene.add(0, 2, {1, 3 - gap}, {gap, 2});
    scene.add(1, 3, {0, 2}, {0, 4}); // z, x
    const auto lines = scene.lines();
    std::set<std::pair<Point, Point>> segments;
    const auto point = [&](std::uint32_t i) {
      return Point(lines.points[i][0], lines.points[i][1], lines.points[i][2]);
    };
    for(const auto& s : lines.segments)
      segments.emplace(point(s.ends[0]), point(s.ends[1]));
    std::set<std::pair<Point, Point>> expected = {{{0, 3, 0}, {4, 3, 0}}};
    if(gap < .1)
      expected.insert({{{2, 1, 0}, {2, 3, 0}}, {{2, 3, 0}, {2, 3, 2}}});
    CHECK_AT(segments == expected && lines.segments.size() == expected.size(), std::to_string(gap));
    CHECK_AT(lines.corners.size() == (gap < .1 ? 1 : 0), std::to_string(gap));
    if(gap < .1)
      CHECK(point(lines.corners.at(0).point) == Point(2, 3, 0) && lines.corners[0].shapes.size() == 3);
  }
}

// Short segments are left out.
BOOST_AUTO_TEST_CASE(test_short)
{
  for(const double length : {.19, .21}) {
    Flat_scene scene;
    scene.add(2, 0, {0, 4}, {0, 3});
    scene.add(0, 2, {1, 1 + length}, {0, 2});
    CHECK_AT(scene.lines().segments.size() == (length < .2 ? 0 : 1), std::to_string(length));
  }
}

// --- What does not change the result

bool are_equal(const Lines& a, const Lines& b)
{
  return a.points == b.points &&
         std::equal(a.segments.begin(), a.segments.end(), b.segments.begin(), b.segments.end(),
                    [](const auto& s, const auto& t) {
                      return s.ends == t.ends && s.shapes == t.shapes && s.sides == t.sides;
                    }) &&
         std::equal(a.corners.begin(), a.corners.end(), b.corners.begin(), b.corners.end(),
                    [](const auto& c, const auto& d) { return c.point == d.point && c.shapes == d.shapes; });
}

// A detected box has noise. Its edges and corners are those of its outlines.
BOOST_AUTO_TEST_CASE(test_order_of_points)
{
  Cloud cloud = make_pairs<Kernel>(make_box_cloud(400));
  const auto lines_of = [&](const Cloud& points) {
    return CGAL::Tandem::lines(detect(points, make_parameters(.02, 50)), points, maps);
  };
  const Lines expected = lines_of(cloud);
  CHECK_AT(expected.segments.size() == 12 && expected.corners.size() == 8, text_of(expected));
  const Shapes shapes = detect(cloud, make_parameters(.02, 50));
  const auto areas = CGAL::Tandem::polygons(shapes, cloud, maps);
  CHECK(are_equal(CGAL::Tandem::lines(shapes, areas), expected));
  const std::set<Point> corners(areas.points().begin(), areas.points().end());
  for(const Point& p : expected.points)
    CHECK(corners.count(p) == 1);
  shuffle(cloud, 5);
  CHECK(are_equal(lines_of(cloud), expected));
}

// Of other entries than those of the shapes.
BOOST_AUTO_TEST_CASE(test_refused)
{
  Scene scene;
  scene.add(2, 0, {0, 1}, {0, 1});
  CHECK(throws<std::invalid_argument>(
    [&] { CGAL::Tandem::lines(scene.shapes(), CGAL::Tandem::Shape_polygons_3<Kernel>()); }));
}

BOOST_AUTO_TEST_SUITE_END()
