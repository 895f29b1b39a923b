// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The areas that the points of shapes cover, before they are points of the caller's kernel.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_POLYGON_PARTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_POLYGON_PARTS_H

#include <CGAL/Shape_regularization_tandem/Indexed_polygon.h>
#include <CGAL/Shape_regularization_tandem/internal/outlines/Plane_frame.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

using Polygon = Indexed_polygon;

// Of one shape. Outlines are simple and have no common points: the vertices as they are, without the coordinate along
// which the plane is steepest, are those of simple polygons in two dimensions. No polygon, if the points cover less
// than a few squares of their spacing.
struct Shape_polygons {
  std::vector<Position> vertices;
  std::vector<Polygon> polygons;
  double area = 0;
};

// Of all shapes, with one table of vertices.
struct Polygon_table {
  std::vector<Position> points;
  std::vector<std::vector<Polygon>> polygons;
  std::vector<double> areas;
  std::vector<Projection> frames;
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_POLYGON_PARTS_H
