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

void check_cells(const Cells& cells, double volume, const std::string& name)
{
  double sum = 0;
  for(int c = 0; c < int(cells.cells.size()); ++c) {
    const double own = volume_of(cells, c);
    CHECK_AT(own > 0, name + ": a cell of no volume");
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
  Cell_cutter cutter(CGAL::Bbox_3(0, 0, 0, 1, 2, 1));
  for(int p = 0; p < 12; ++p) {
    const double a = 2 * uniform() - 1, b = 2 * uniform() - 1, c = 2 * uniform() - 1;
    cut_all(cutter, {a, b, c, -a * uniform() - 2 * b * uniform() - c * uniform()});
  }
  const Cells cells = cutter.cells();
  CHECK(cells.cells.size() > 50);
  check_cells(cells, 2, "seed " + std::to_string(seed));
}

// Many planes through common lines and points, which only exact numbers see.
BOOST_AUTO_TEST_CASE(degenerate_planes)
{
  Cell_cutter cutter(CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
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
  Cell_cutter cutter(CGAL::Bbox_3(0, 0, 0, 1, 1, 1));
  cutter.split(0, cutter.add_plane({1, 0, 0, -.5}));
  cutter.split(1, cutter.add_plane({0, 1, 0, -.5}));
  const Cells cells = cutter.cells();
  CHECK(cells.cells.size() == 3);
  CHECK(cells.facets_of(0).size() == 7); // two in the plane of the cut
  check_cells(cells, 1, "one cell");
  CHECK(cutter.section(1, cutter.add_plane({0, 0, 1, -.5})).size() == 8); // each edge in both of its facets
}

// However dense they are, points cover the area on which they lie; copies have their part of it.
BOOST_AUTO_TEST_CASE(covered_area)
{
  std::mt19937 random(1);
  const auto uniform = [&] { return double(random()) / 4294967296.; };
  std::vector<Point> points;
  for(int i = 0; i < 20000; ++i) {
    const double x = i % 2 == 0 ? uniform() : .2 * uniform(), y = uniform();
    points.insert(points.end(), i % 100 == 0 ? 50 : 1, Point(x, y, 3));
  }
  const Plane_coverage plane({0, 0, 1, -3}, points, 1e-4);
  double sum = 0;
  for(std::size_t i = 0; i < points.size(); ++i)
    sum += plane.area_of_point(i);
  check_close(sum, 1, .05, "covered area");
}

BOOST_AUTO_TEST_SUITE_END()
