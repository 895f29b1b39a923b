// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells into which planes cut a box: they fill it, are closed, and meet in whole facets. And the part of a plane that
// points cover.

#include "testing/checks.h"

#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>

#include <random>
#include <set>

BOOST_AUTO_TEST_SUITE(test_surface_cells)

using namespace CGAL::Tandem::internal::surface;
using CGAL::Tandem::Coefficients;

constexpr double resolution = 1e-7;

// From a point outside of all cells; facets are counterclockwise from the front.
double volume_of(const Cells& cells, int cell)
{
  const Point origin(-7, 5, 3);
  double sum = 0;
  for(int f : cells.facets_of(cell)) {
    const Facet& facet = cells.facet(f);
    const std::vector<Point> c = cells.corners(facet);
    double part = 0;
    for(std::size_t i = 2; i < c.size(); ++i)
      part += CGAL::determinant(c[0] - origin, c[i - 1] - origin, c[i] - origin) / 6;
    sum += facet.behind == cell ? part : -part;
  }
  return sum;
}

void check_cells(const Cells& cells, double volume, const std::string& name, double smallest = 0)
{
  double sum = 0;
  for(int c = 0; c < int(cells.cells.size()); ++c) {
    const double own = volume_of(cells, c);
    CHECK_AT(own > smallest, name + ": a cell of no volume");
    sum += own;
    std::map<Edge, int> facets_of_edge;
    for(int f : cells.facets_of(c)) {
      CHECK_AT(cells.facet(f).behind == c || cells.facet(f).front == c, name);
      for_each_edge(cells.facet(f).vertices, [&](int u, int v) { ++facets_of_edge[edge_of(u, v)]; });
    }
    for(const auto& [edge, count] : facets_of_edge)
      CHECK_AT(count == 2, name + ": an edge of a cell that is open");
  }
  CHECK_AT(std::fabs(sum - volume) < 1e-9 * volume, name + ": the volume is " + std::to_string(sum));
  for(const Facet& f : cells.facets)
    CHECK_AT(f.behind != f.front && f.behind != none && (f.front != none) == (f.plane != none), name + ": a facet");
}

void cut_all(Cell_cutter& cutter, const Coefficients& plane)
{
  const int number = cutter.add_plane(plane);
  for(int c = int(cutter.number_of_cells()) - 1; c >= 0; --c)
    cutter.split(c, number);
}

// Of planes in general position, the number of cells is known.
BOOST_DATA_TEST_CASE(planes_in_general_position, boost::unit_test::data::xrange(1u, 6u), seed)
{
  std::mt19937 random(seed);
  const auto uniform = [&] { return double(random() >> 8) / double(1 << 24); };
  Cell_cutter cutter(CGAL::Bbox_3(0, 0, 0, 1, 2, 1), resolution);
  for(int p = 0; p < 12; ++p) {
    const double a = 2 * uniform() - 1, b = 2 * uniform() - 1, c = 2 * uniform() - 1;
    cut_all(cutter, {a, b, c, -a * uniform() - 2 * b * uniform() - c * uniform()});
  }
  const Cells cells = cutter.cells();
  CHECK(cells.cells.size() > 50);
  check_cells(cells, 2, "seed " + std::to_string(seed));
}

// Many planes through common lines and points.
BOOST_AUTO_TEST_CASE(degenerate_planes)
{
  Cell_cutter cutter(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), resolution);
  const double third = 1. / 3, planes[][4] = {{1, 0, 0, 0},  {0, 1, 0, 0},  {0, 0, 1, 0},
                                              {1, 1, 0, 0},  {1, -1, 0, 0}, {third, third, third, 0},
                                              {1, 1, 1, 0},  {-1, 1, 0, 0}, {1, 0, 0, -1},
                                              {1, 1, 1, -3}, {0, 1, 1, 0}};
  for(const auto& p : planes)
    cut_all(cutter, {p[0], p[1], p[2], p[3]});
  const Cells cells = cutter.cells();
  check_cells(cells, 8, "planes through one point");
  std::set<int> of_planes;
  for(const Facet& f : cells.facets)
    of_planes.insert(f.plane);
  CHECK(of_planes == std::set<int>({none, 0, 1, 2, 3, 4, 5, 10})); // the others are the same, or do not cut the box
}

// A cut through one cell only: its neighbors get vertices on their edges.
BOOST_AUTO_TEST_CASE(one_cell)
{
  Cell_cutter cutter(CGAL::Bbox_3(0, 0, 0, 1, 1, 1), resolution);
  cutter.split(0, cutter.add_plane({1, 0, 0, -.5}));
  cutter.split(1, cutter.add_plane({0, 1, 0, -.5}));
  const Cells cells = cutter.cells();
  CHECK(cells.cells.size() == 3);
  CHECK(cells.facets_of(0).size() == 7); // two in the plane of the cut
  check_cells(cells, 1, "one cell");
  CHECK(cutter.section(1, cutter.add_plane({0, 0, 1, -.5})).size() == 8); // each edge in both of its facets
}

// Planes that nearly pass through one point, or are nearly the same, make neither short edges nor flat cells.
BOOST_DATA_TEST_CASE(nearly_common_points, boost::unit_test::data::xrange(1u, 51u), seed)
{
  std::mt19937 random(seed);
  const auto uniform = [&] { return 2 * double(random() >> 8) / double(1 << 24) - 1; };
  Cell_cutter cutter(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1), resolution);
  for(int p = 0; p < 16; ++p) {
    const double a = uniform(), b = uniform(), c = uniform(), length = std::sqrt(a * a + b * b + c * c);
    const double offset = std::pow(10., -7 - p % 10) * uniform();
    cut_all(cutter, {a / length, b / length, c / length, offset});
    if(p % 4 == 0)
      cut_all(cutter, {a / length, b / length, c / length, offset + 1e-9 * uniform()});
  }
  const Cells cells = cutter.cells();
  const std::string name = "seed " + std::to_string(seed);
  CHECK_AT(cells.cells.size() > 100, name);
  check_cells(cells, 8, name, -resolution * resolution); // vertices are close to their planes only
  for(const Facet& f : cells.facets)
    for_each_edge(f.vertices, [&](int u, int v) {
      CHECK_AT(CGAL::squared_distance(cells.points[std::size_t(u)], cells.points[std::size_t(v)]) >
                 .99 * resolution * resolution,
               name + ": a short edge");
    });
}

// The common part of two convex polygons, and what is covered.
BOOST_AUTO_TEST_CASE(common_parts)
{
  using P = CGAL::Tandem::internal::surface::Kernel::Point_2;
  const Flat_polygon square = {P(0, 0), P(2, 0), P(2, 2), P(0, 2)};
  check_close(area_of(common_part(square, {P(1, 1), P(3, 1), P(1, 3)})), 1, 1e-12, "a corner");
  check_close(area_of(common_part({P(-1, -1), P(5, -1), P(-1, 5)}, square)), 4, 1e-12, "all of it");
  CHECK(!(area_of(common_part(square, {P(2, 0), P(3, 0), P(3, 1)})) > 0));
  CHECK(common_part(square, {P(3, 0), P(4, 0), P(4, 1)}).empty());

  Plane_coverage plane({0, 0, 1, -3}, {Point(0, 0, 3), Point(4, 0, 3), Point(4, 4, 3), Point(0, 4, 3)});
  plane.cover({Point(0, 0, 3), Point(4, 0, 3), Point(0, 4, 3)});
  CHECK(plane.has_area() && plane.is_covered(Point(1, 1, 3)) && !plane.is_covered(Point(3, 3, 3)));
  CHECK(!Plane_coverage({0, 0, 1, -3}, {Point(0, 0, 3), Point(4, 0, 3), Point(2, 0, 3)}).has_area());
}

BOOST_AUTO_TEST_SUITE_END()
