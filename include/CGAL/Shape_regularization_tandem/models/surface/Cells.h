// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part of space that is cut into convex cells. A facet has a cell on each side, and an edge has the same ends in all
// facets around it: a cell may have several facets in one plane, and facets vertices on straight edges.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELLS_H

#include <CGAL/Tandem/Coefficients.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

inline constexpr int none = -1;

struct Facet {
  std::vector<int> vertices; // counterclockwise, seen from the cell in front
  int plane;                 // position in the planes; none: a side of the box
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

// Of a point above a plane.
inline double height(const Coefficients& c, const Point& p)
{
  return c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3];
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

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CELLS_H
