// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The areas that the points of the shapes cover, as polygons with holes in the planes of the shapes.

#ifndef DETECT_PLANES_SHAPE_POLYGONS_H
#define DETECT_PLANES_SHAPE_POLYGONS_H

#include "outlines/Unit.h"

#include <array>
#include <cstdint>
#include <vector>

namespace program {

// Positions of its corners in the vertices of the shape.
struct Polygon {
  using Loop = std::vector<std::uint32_t>;
  Loop outer;                                          // counterclockwise, seen from where the normals point to
  std::vector<Loop> holes;                             // clockwise
  std::vector<std::array<std::uint32_t, 3>> triangles; // counterclockwise, without further vertices
};

// Of one shape. Outlines are simple and have no common points: the vertices as they are, without the coordinate along
// which the plane is steepest, are those of simple polygons in two dimensions. No polygon, if the points cover less
// than a few squares of their spacing.
struct Shape_polygons {
  std::vector<Position> vertices;
  std::vector<Polygon> polygons;
  double area = 0;
};

// Where a shape ends at the plane of another one, its outline is straight, and its vertices are on both planes.
std::vector<Shape_polygons> polygons_of_shapes(const Point_set& points, const Shapes& shapes);

} // namespace program

#endif // DETECT_PLANES_SHAPE_POLYGONS_H
