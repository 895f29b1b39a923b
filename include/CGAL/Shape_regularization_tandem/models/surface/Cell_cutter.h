// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts a box into convex cells by planes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELL_CUTTER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELL_CUTTER_H

#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_rational.h>

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

inline double extent_of(const CGAL::Bbox_3& box)
{
  return (std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
}

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

// --- Cuts, each of which goes through one cell only. Nothing is rounded: a vertex is the point of three planes, with
// rational coordinates.

class Cell_cutter {
public:
  explicit Cell_cutter(const CGAL::Bbox_3& box)
  {
    for(int axis = 0; axis < 3; ++axis)
      for(const bool is_upper : {false, true}) {
        Coefficients c = {0, 0, 0, is_upper ? -box.max(axis) : -box.min(axis)};
        c[std::size_t(axis)] = 1;
        planes_.push_back(c);
      }
    for(int corner = 0; corner < 8; ++corner)
      add_vertex({corner & 1, 2 + (corner >> 1 & 1), 4 + (corner >> 2)});
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

  // Where a plane cuts the edges of a cell, in no order. Rounded.
  std::vector<Point> section(int cell, int plane) const
  {
    const Coefficients& c = planes_[std::size_t(plane + faces_of_box)];
    std::vector<Point> result;
    for(int f : cells_.facets_of(cell))
      for_each_edge(cells_.facet(f).vertices, [&](int u, int v) {
        const Point &p = cells_.points[std::size_t(u)], &q = cells_.points[std::size_t(v)];
        const double a = height(c, p), b = height(c, q);
        if((a < 0) != (b < 0))
          result.push_back(p + a / (a - b) * (q - p));
      });
    return result;
  }

  // The cell becomes its part where the plane is negative, the other part is a cell of its own. Nothing happens if the
  // plane does not cut the cell.
  void split(int cell, int plane)
  {
    plane += faces_of_box;
    oriented_sides_.clear();
    int least = 0, most = 0;
    for(int f : cells_.facets_of(cell))
      for(int v : cells_.facet(f).vertices) {
        const auto added = oriented_sides_.emplace(v, 0);
        if(added.second)
          added.first->second = oriented_side(v, plane);
        least = (std::min)(least, added.first->second);
        most = (std::max)(most, added.first->second);
      }
    if(least == 0 || most == 0)
      return;
    split_edges(cell, plane);
    const std::vector<int> whole = cells_.facets_of(cell);
    for(int f : whole)
      if(has_side(f, -1) && has_side(f, 1))
        split_facet(f, plane);
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
  using Number = CGAL::Exact_rational;
  using Exact_point = std::array<Number, 3>;
  struct Planes_and_facets { // of an edge
    std::array<int, 2> planes;
    std::vector<int> facets;
  };
  static constexpr int faces_of_box = 6; // their planes come first

  void add_vertex(const std::array<int, 3>& of_planes)
  {
    std::array<std::array<Number, 4>, 3> rows;
    for(std::size_t i = 0; i < 3; ++i)
      for(std::size_t k = 0; k < 4; ++k)
        rows[i][k] = Number(planes_[std::size_t(of_planes[i])][k]);
    const auto determinant = [&](std::size_t a, std::size_t b, std::size_t c) {
      return CGAL::determinant(rows[0][a], rows[0][b], rows[0][c], rows[1][a], rows[1][b], rows[1][c], rows[2][a],
                               rows[2][b], rows[2][c]);
    };
    const Number d = determinant(0, 1, 2);
    exact_.push_back({-determinant(3, 1, 2) / d, -determinant(0, 3, 2) / d, -determinant(0, 1, 3) / d});
    const Exact_point& p = exact_.back();
    cells_.points.emplace_back(CGAL::to_double(p[0]), CGAL::to_double(p[1]), CGAL::to_double(p[2]));
  }

  // Of a vertex: -1, 0 or 1. Rational numbers decide where the rounded ones cannot.
  int oriented_side(int vertex, int plane) const
  {
    constexpr double rounding = 1e-14; // of the sum, by its terms: more than a dozen of roundings
    const Point& p = cells_.points[std::size_t(vertex)];
    const Coefficients& c = planes_[std::size_t(plane)];
    double sum = 0, size = 0;
    for(const double term : {c[0] * p.x(), c[1] * p.y(), c[2] * p.z(), c[3]}) {
      sum += term;
      size += std::fabs(term);
    }
    if(std::fabs(sum) > rounding * size)
      return sum < 0 ? -1 : 1;
    Number exact(c[3]);
    for(std::size_t k = 0; k < 3; ++k)
      exact += Number(c[k]) * exact_[std::size_t(vertex)][k];
    return int(CGAL::sign(exact));
  }

  bool has_side(int facet, int s) const
  {
    const std::vector<int>& loop = cells_.facet(facet).vertices;
    return std::any_of(loop.begin(), loop.end(), [&](int v) { return oriented_sides_.at(v) == s; });
  }

  void add_facet(const Facet& facet)
  {
    const int f = int(cells_.facets.size());
    cells_.facets.push_back(facet);
    for_each_edge(facet.vertices, [&](int u, int v) {
      Planes_and_facets& e = edges_[edge_of(u, v)];
      if(e.facets.empty())
        e.planes[0] = facet.plane;
      else if(e.planes[0] != facet.plane)
        e.planes[1] = facet.plane;
      e.facets.push_back(f);
    });
    for(int c : {facet.behind, facet.front})
      if(c != none)
        cells_.cells[std::size_t(c)].push_back(f);
  }

  void split_edges(int cell, int plane)
  {
    for(int f : cells_.facets_of(cell)) {
      const std::vector<int> loop = cells_.facet(f).vertices;
      for_each_edge(loop, [&](int u, int v) {
        if(oriented_sides_.at(u) * oriented_sides_.at(v) < 0)
          split_edge(u, v, plane);
      });
    }
  }

  // All facets at the edge have a vertex more.
  void split_edge(int u, int v, int plane)
  {
    const auto at = edges_.find(edge_of(u, v));
    const Planes_and_facets edge = at->second;
    edges_.erase(at);
    const int w = int(cells_.points.size());
    add_vertex({edge.planes[0], edge.planes[1], plane});
    oriented_sides_[w] = 0;
    edges_[edge_of(u, w)] = edges_[edge_of(v, w)] = edge;
    for(int f : edge.facets) {
      std::vector<int>& loop = cells_.facets[std::size_t(f)].vertices;
      std::size_t i = 0;
      while(edge_of(loop[i], loop[(i + 1) % loop.size()]) != edge_of(u, v))
        ++i;
      loop.insert(loop.begin() + std::ptrdiff_t(i) + 1, w);
    }
  }

  // The part on the positive side becomes a facet of its own.
  void split_facet(int f, int plane)
  {
    const Facet whole = cells_.facet(f);
    const std::vector<int>& loop = whole.vertices;
    const std::size_t n = loop.size();
    std::size_t start = 0; // where the positive side begins
    while(oriented_sides_.at(loop[start]) != 0 || oriented_sides_.at(loop[(start + 1) % n]) <= 0)
      ++start;
    std::size_t end = 1; // and where it ends, from there on
    while(oriented_sides_.at(loop[(start + end) % n]) > 0)
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
      std::vector<int>& facets = edges_[edge_of(positive.vertices[i], positive.vertices[i + 1])].facets;
      facets.erase(std::find(facets.begin(), facets.end(), f));
    }
    cells_.facets[std::size_t(f)].vertices = negative;
    edges_[edge_of(negative.front(), negative.back())] = {{whole.plane, plane}, {f}};
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
        if(oriented_sides_.at(u) == 0 && oriented_sides_.at(v) == 0)
          next[is_behind ? v : u] = is_behind ? u : v;
      });
    }
    std::vector<int> loop(1, next.begin()->first);
    for(int v = next.at(loop.front()); v != loop.front(); v = next.at(v))
      loop.push_back(v);
    add_facet({loop, plane, other, cell});
  }

  std::vector<Coefficients> planes_;
  Cells cells_; // with the numbers of these planes
  std::vector<Exact_point> exact_;
  std::map<Edge, Planes_and_facets> edges_;
  std::map<int, int> oriented_sides_; // of the vertices of the cell that is split
};

// --- The cells of a box that planes cut: each plane cuts those that the hull of its points meets or is close to. So their
// number grows about linearly with that of the planes, and gaps between shapes are bridged.

inline Cells cut_cells(const std::vector<Plane_coverage>& planes, const CGAL::Bbox_3& box)
{
  const double reach = .05 * extent_of(box); // of the planes beyond their points
  Cell_cutter cutter(box);
  for(const Plane_coverage& plane : planes) {
    const int number = cutter.add_plane(plane.plane());
    for(int c = int(cutter.number_of_cells()) - 1; c >= 0; --c) {
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
