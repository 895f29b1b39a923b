// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts a box into convex cells by planes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELL_CUTTER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELL_CUTTER_H

#include <CGAL/Shape_regularization_tandem/models/Model_progress.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/centroid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// --- A part of space that is cut into convex cells. A facet has a cell on each side, and an edge has the same ends in all
// facets around it: a cell may have several facets in one plane, and facets vertices on straight edges.

inline constexpr int none = -1;

struct Facet {
  std::vector<int> vertices; // counterclockwise, seen from the cell in front
  int plane;                 // position in the planes; none: a face of the box
  int behind, front;         // cells; none: beyond the box
};

struct Cells {
  std::vector<Point> points; // of the vertices
  std::vector<Facet> facets;
  std::vector<std::vector<int>> cells; // facets of each

  const Facet& facet(int f) const { return facets[std::size_t(f)]; }
  const std::vector<int>& facets_of(int cell) const { return cells[std::size_t(cell)]; }

  std::vector<std::vector<std::size_t>> facets_of_planes(std::size_t number_of_planes) const
  {
    std::vector<std::vector<std::size_t>> result(number_of_planes);
    for(std::size_t f = 0; f < facets.size(); ++f)
      if(facets[f].plane != none)
        result[std::size_t(facets[f].plane)].push_back(f);
    return result;
  }

  // Within a cell.
  Point middle(int cell) const
  {
    std::vector<Point> corners;
    for(int f : facets_of(cell))
      for(int v : facet(f).vertices)
        corners.push_back(points[std::size_t(v)]);
    return CGAL::centroid(corners.begin(), corners.end(), CGAL::Dimension_tag<0>());
  }

  std::vector<Point> corners(const Facet& facet) const
  {
    std::vector<Point> result;
    for(int v : facet.vertices)
      result.push_back(points[std::size_t(v)]);
    return result;
  }
};

// Of a convex polygon that is counterclockwise, seen from its end; twice as long as its area.
inline Vector normal_of(const std::vector<Point>& corners)
{
  Vector sum = CGAL::NULL_VECTOR;
  for(std::size_t i = 2; i < corners.size(); ++i)
    sum = sum + CGAL::cross_product(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

inline double area_of(const std::vector<Point>& corners) { return std::sqrt(normal_of(corners).squared_length()) / 2; }

// The ends of an edge, in any direction.
using Edge = std::pair<int, int>;

inline Edge edge_of(int u, int v) { return std::minmax(u, v); }

// f(u, v) for the edges of a loop of vertices.
template <class Function>
void for_each_edge(const std::vector<int>& loop, Function f)
{
  for(std::size_t i = 0; i < loop.size(); ++i)
    f(loop[i], loop[i + 1 < loop.size() ? i + 1 : 0]);
}

// --- Cuts, each of which goes through one cell only. A vertex within the resolution of a plane is a vertex of the cut: so
// planes that nearly meet in a point have a vertex there, no cell is thinner, and no edge is shorter.

class Cell_cutter {
public:
  Cell_cutter(const CGAL::Bbox_3& box, double resolution) : resolution_(resolution), boxes_(1, box)
  {
    for(int axis = 0; axis < 3; ++axis)
      for(const bool is_upper : {false, true}) {
        Coefficients c = {0, 0, 0, is_upper ? -box.max(axis) : -box.min(axis)};
        c[std::size_t(axis)] = 1;
        planes_.push_back(c);
      }
    for(int corner = 0; corner < 8; ++corner)
      add_vertex(Point((corner & 1) == 0 ? box.xmin() : box.xmax(), (corner & 2) == 0 ? box.ymin() : box.ymax(),
                       (corner & 4) == 0 ? box.zmin() : box.zmax()));
    cells_.cells.resize(1);
    for(int axis = 0; axis < 3; ++axis)
      for(int end = 0; end < 2; ++end) {
        const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = end << axis;
        std::vector<int> loop = {base, base + u, base + u + v, base + v};
        if(end == 0)
          std::reverse(loop.begin(), loop.end());
        add_facet({loop, 2 * axis + end, 0, none});
      }
  }

  int add_plane(const Coefficients& plane)
  {
    planes_.push_back(plane);
    return int(planes_.size()) - 1 - faces_of_box;
  }

  std::size_t number_of_cells() const { return cells_.cells.size(); }

  const CGAL::Bbox_3& box(int cell) const { return boxes_[std::size_t(cell)]; }

  // Where a plane cuts the edges of a cell, in no order.
  std::vector<Point> section(int cell, int plane) const
  {
    const Coefficients& c = planes_[std::size_t(plane + faces_of_box)];
    std::vector<Point> result;
    for(int f : cells_.facets_of(cell))
      for_each_edge(cells_.facet(f).vertices, [&](int u, int v) {
        const Point &p = cells_.points[std::size_t(u)], &q = cells_.points[std::size_t(v)];
        const double a = height(c, p), b = height(c, q);
        if((a < 0) != (b < 0))
          result.push_back(zero_between(p, a, q, b));
      });
    return result;
  }

  // The cell becomes its part where the plane is negative, the other part is a cell of its own. Nothing happens if the
  // plane does not cut the cell, or if the cut would have a short edge, or more than one line, as vertices are not exactly
  // in their planes.
  void split(int cell, int plane)
  {
    plane += faces_of_box;
    for(int f : cells_.facets_of(cell))
      for(int v : cells_.facet(f).vertices)
        side_[std::size_t(v)] = side_of(v, plane);
    if(!has_single_cut(cell, planes_[std::size_t(plane)]))
      return;
    split_edges(cell, plane);
    const std::vector<int> whole = cells_.facets_of(cell);
    for(int f : whole)
      if(has_side(f, -1) && has_side(f, 1))
        split_facet(f);
    separate(cell, plane);
  }

  Cells cells() const
  {
    Cells result = cells_;
    for(Facet& f : result.facets)
      f.plane = (std::max)(f.plane - faces_of_box, none);
    return result;
  }

private:
  static constexpr int faces_of_box = 6; // their planes come first

  void add_vertex(const Point& p)
  {
    cells_.points.push_back(p);
    side_.push_back(0);
  }

  // Of a vertex: -1, 0 or 1.
  signed char side_of(int vertex, int plane) const
  {
    const double h = height(planes_[std::size_t(plane)], cells_.points[std::size_t(vertex)]);
    return h > resolution_ ? 1 : h < -resolution_ ? -1 : 0;
  }

  int side(int vertex) const { return side_[std::size_t(vertex)]; }

  // Where the plane cuts an edge with an end on each side.
  Point place_on(const Edge& edge, const Coefficients& plane) const
  {
    const Point &p = cells_.points[std::size_t(edge.first)], &q = cells_.points[std::size_t(edge.second)];
    return zero_between(p, height(plane, p), q, height(plane, q));
  }

  // Corners of a cut are vertices, which are given twice, and edges with an end on each side.
  using Cut_line = std::pair<Edge, Edge>; // from corner to corner

  // The lines of the cut along which a facet meets its part on the positive side. Returns whether each of its parts is in
  // one piece, and no line across it is an edge of others.
  bool find_cut(const std::vector<int>& loop, std::vector<Cut_line>& lines) const
  {
    const auto corner = [&](int u, int positive) { return side(u) == 0 ? Edge(u, u) : edge_of(u, positive); };
    int positive_parts = 0, negative_parts = 0;
    Cut_line across;
    for_each_edge(loop, [&](int u, int v) {
      if(side(u) <= 0 && side(v) > 0) {
        across.second = corner(u, v);
        ++positive_parts;
      }
      if(side(u) > 0 && side(v) <= 0)
        across.first = corner(v, u);
      if(side(u) >= 0 && side(v) < 0)
        ++negative_parts;
      if(side(u) == 0 && side(v) == 0)
        lines.push_back({{u, u}, {v, v}});
    });
    if(negative_parts > 0)
      lines = {across};
    const bool is_edge = negative_parts > 0 && across.first.first == across.first.second &&
                         across.second.first == across.second.second &&
                         facets_of_edge_.count(edge_of(across.first.first, across.second.first)) > 0;
    return positive_parts <= 1 && negative_parts <= 1 && !is_edge;
  }

  // Whether one closed line, no part of which is too short, separates the sides.
  bool has_single_cut(int cell, const Coefficients& plane) const
  {
    const auto place = [&](const Edge& corner) {
      return corner.first == corner.second ? cells_.points[std::size_t(corner.first)] : place_on(corner, plane);
    };
    std::map<Edge, Edge> next;
    bool is_simple = true, has_negative = false;
    for(int f : cells_.facets_of(cell)) {
      has_negative = has_negative || has_side(f, -1);
      if(!has_side(f, 1))
        continue;
      std::vector<Cut_line> lines;
      is_simple = find_cut(cells_.facet(f).vertices, lines) && is_simple;
      for(auto [first, last] : lines) {
        if(cells_.facet(f).behind == cell)
          std::swap(first, last);
        is_simple = is_simple && next.emplace(first, last).second &&
                    CGAL::squared_distance(place(first), place(last)) > resolution_ * resolution_;
      }
    }
    if(!is_simple || !has_negative || next.size() < 3)
      return false;
    std::size_t length = 1;
    for(auto at = next.find(next.begin()->second); at != next.begin(); at = next.find(at->second), ++length)
      if(at == next.end() || length > next.size())
        return false;
    return length == next.size();
  }

  bool has_side(int facet, int s) const
  {
    const std::vector<int>& loop = cells_.facet(facet).vertices;
    return std::any_of(loop.begin(), loop.end(), [&](int v) { return side(v) == s; });
  }

  void add_facet(const Facet& facet)
  {
    const int f = int(cells_.facets.size());
    cells_.facets.push_back(facet);
    for_each_edge(facet.vertices, [&](int u, int v) { facets_of_edge_[edge_of(u, v)].push_back(f); });
    for(int c : {facet.behind, facet.front})
      if(c != none)
        cells_.cells[std::size_t(c)].push_back(f);
  }

  void split_edges(int cell, int plane)
  {
    for(int f : cells_.facets_of(cell)) {
      const std::vector<int> loop = cells_.facet(f).vertices;
      for_each_edge(loop, [&](int u, int v) {
        if(side(u) * side(v) < 0)
          split_edge(edge_of(u, v), planes_[std::size_t(plane)]);
      });
    }
  }

  // All facets at the edge have a vertex more.
  void split_edge(const Edge& edge, const Coefficients& plane)
  {
    const auto at = facets_of_edge_.find(edge);
    const std::vector<int> facets = std::move(at->second);
    facets_of_edge_.erase(at);
    const auto [u, v] = edge;
    const int w = int(cells_.points.size());
    add_vertex(place_on(edge, plane));
    facets_of_edge_[edge_of(u, w)] = facets_of_edge_[edge_of(v, w)] = facets;
    for(int f : facets) {
      std::vector<int>& loop = cells_.facets[std::size_t(f)].vertices;
      std::size_t i = 0;
      while(edge_of(loop[i], loop[(i + 1) % loop.size()]) != edge)
        ++i;
      loop.insert(loop.begin() + std::ptrdiff_t(i) + 1, w);
    }
  }

  // The part on the positive side becomes a facet of its own.
  void split_facet(int f)
  {
    const Facet whole = cells_.facet(f);
    const std::vector<int>& loop = whole.vertices;
    const std::size_t n = loop.size();
    std::size_t start = 0; // where the positive side begins
    while(side(loop[start]) != 0 || side(loop[(start + 1) % n]) <= 0)
      ++start;
    std::size_t end = 1; // and where it ends, from there on
    while(side(loop[(start + end) % n]) > 0)
      ++end;
    Facet positive = {{}, whole.plane, whole.behind, whole.front};
    std::vector<int> negative;
    for(std::size_t i = 0; i <= n; ++i) {
      if(i <= end)
        positive.vertices.push_back(loop[(start + i) % n]);
      if(i >= end)
        negative.push_back(loop[(start + i) % n]);
    }
    for(std::size_t i = 0; i < end; ++i) {
      std::vector<int>& facets = facets_of_edge_[edge_of(positive.vertices[i], positive.vertices[i + 1])];
      facets.erase(std::find(facets.begin(), facets.end(), f));
    }
    cells_.facets[std::size_t(f)].vertices = negative;
    facets_of_edge_[edge_of(negative.front(), negative.back())] = {f};
    add_facet(positive);
  }

  // The facets on the positive side go to a new cell, and the cut is a facet between both.
  void separate(int cell, int plane)
  {
    const int other = int(cells_.cells.size());
    const std::vector<int> all = cells_.facets_of(cell);
    cells_.cells.emplace_back();
    cells_.cells[std::size_t(cell)].clear();
    std::map<int, int> next; // vertices of the cut, counterclockwise seen from the negative side
    for(int f : all) {
      const bool is_positive = has_side(f, 1);
      cells_.cells[std::size_t(is_positive ? other : cell)].push_back(f);
      if(!is_positive)
        continue;
      Facet& facet = cells_.facets[std::size_t(f)];
      const bool is_behind = facet.behind == cell;
      (is_behind ? facet.behind : facet.front) = other;
      for_each_edge(facet.vertices, [&](int u, int v) {
        if(side(u) == 0 && side(v) == 0)
          next[is_behind ? v : u] = is_behind ? u : v;
      });
    }
    std::vector<int> loop(1, next.begin()->first);
    for(int v = next.at(loop.front()); v != loop.front(); v = next.at(v))
      loop.push_back(v);
    add_facet({loop, plane, other, cell});
    boxes_.resize(cells_.cells.size());
    for(int c : {cell, other})
      measure(c);
  }

  void measure(int cell)
  {
    CGAL::Bbox_3& box = boxes_[std::size_t(cell)];
    box = CGAL::Bbox_3();
    for(int f : cells_.facets_of(cell))
      for(int v : cells_.facet(f).vertices)
        box += cells_.points[std::size_t(v)].bbox();
  }

  double resolution_;
  std::vector<Coefficients> planes_;
  Cells cells_; // with the numbers of these planes
  std::map<Edge, std::vector<int>> facets_of_edge_;
  std::vector<CGAL::Bbox_3> boxes_; // of the cells
  std::vector<signed char> side_;   // of the vertices of the cell that is split
};

// --- The cells of a box that planes cut: each plane cuts those that the hull of its points meets or is close to. So their
// number grows about linearly with that of the planes, and gaps between shapes are bridged.

// Ends early with that number of cells.
inline Cells cut_cells(const std::vector<Plane_coverage>& planes, const CGAL::Bbox_3& box, std::size_t most_cells,
                       const Model_progress& progress)
{
  Cell_cutter cutter(box, resolution_of(box));
  for(const Plane_coverage& plane : planes) {
    const int number = cutter.add_plane(plane.plane());
    progress.check(double(number) / double(planes.size()));
    if(cutter.number_of_cells() >= most_cells)
      break;
    const double reach = (std::min)(2 * extent_of(plane.box(0)), .05 * extent_of(box)); // beyond its points
    const CGAL::Bbox_3 near = plane.box(reach);
    for(int c = int(cutter.number_of_cells()) - 1; c >= 0; --c) {
      if(!CGAL::do_overlap(near, cutter.box(c)))
        continue;
      std::vector<Kernel::Point_2> corners, section;
      for(const Point& p : cutter.section(c, number))
        corners.push_back(plane.flat(p));
      CGAL::convex_hull_2(corners.begin(), corners.end(), std::back_inserter(section));
      if(section.size() > 2 && !separates(section, plane.hull(), reach) && !separates(plane.hull(), section, reach))
        cutter.split(c, number);
    }
  }
  return cutter.cells();
}

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELL_CUTTER_H
