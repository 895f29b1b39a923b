// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The areas that the points of shapes cover, before they are points of the caller's kernel.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_POLYGON_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_POLYGON_TABLE_H

#include <CGAL/Tandem/internal/result/Shapes_data.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief A polygon with holes in a plane, whose corners are positions in a table of points. The order of corners is that
seen from the side to which the normal of `Planar_shapes_3::plane()` points, whatever the normals of the points are.
*/
struct Indexed_polygon {
  /// the corners of a closed line, the first one once
  using Loop = std::vector<std::uint32_t>;

  /// counterclockwise
  Loop outer;
  /// clockwise
  std::vector<Loop> holes;
  /// a constrained Delaunay triangulation, without further vertices: counterclockwise
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

} // namespace CGAL::Tandem

namespace CGAL::Tandem::internal::outlines {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polygon = Indexed_polygon;

// The first of the largest numbers of a normal.
template <class Numbers>
std::size_t steepest_axis(const Numbers& normal)
{
  std::size_t steepest = 0;
  for(std::size_t k = 1; k < 3; ++k)
    if(std::fabs(normal[k]) > std::fabs(normal[steepest]))
      steepest = k;
  return steepest;
}

// Without the coordinate along which the plane is steepest, seen from where the normal points to. Nothing is rounded:
// what lines are here, simple for example, they are as they are written. Areas shrink by `shrinkage()`.
class Projection {
public:
  explicit Projection(const Coefficients& plane) : plane(plane), steepest(steepest_axis(plane))
  {
    axes = {(steepest + 1) % 3, (steepest + 2) % 3};
    if(plane[steepest] < 0)
      std::swap(axes[0], axes[1]);
  }

  Kernel::Point_2 projected(const Position& p) const { return Kernel::Point_2(p[axes[0]], p[axes[1]]); }

  // The position that is projected to `p`.
  Position on_plane(const Kernel::Point_2& p) const
  {
    Position x;
    x[axes[0]] = p.x();
    x[axes[1]] = p.y();
    const long double rest =
      static_cast<long double>(plane[axes[0]]) * p.x() + static_cast<long double>(plane[axes[1]]) * p.y() + plane[3];
    x[steepest] = double(-rest / plane[steepest]);
    return x;
  }

  double shrinkage() const { return std::fabs(plane[steepest]); }

private:
  Coefficients plane;
  std::size_t steepest;
  std::array<std::size_t, 2> axes;
};

// f(corners) for the lines and triangles of a polygon.
template <class Function>
void for_each_list(Polygon& polygon, Function f)
{
  f(polygon.outer);
  for(Polygon::Loop& hole : polygon.holes)
    f(hole);
  for(auto& triangle : polygon.triangles)
    f(triangle);
}

// Of all shapes, with one table of vertices. The outlines of a shape are simple and have no common points: the vertices as
// they are, without the coordinate along which the plane is steepest, are those of simple polygons in two dimensions. No
// polygon, if the points cover less than a few squares of their spacing.
struct Polygon_table {
  std::vector<Position> points;
  std::vector<std::vector<Polygon>> polygons;
  std::vector<double> areas;
  std::vector<Projection> frames;
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_POLYGON_TABLE_H
