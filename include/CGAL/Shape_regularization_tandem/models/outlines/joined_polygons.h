// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One table of vertices for the polygons of all shapes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_JOINED_POLYGONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_JOINED_POLYGONS_H

#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// Of one shape, with vertices of its own.
struct Shape_polygons {
  std::vector<Position> vertices;
  std::vector<Polygon> polygons;
  double area = 0;
};

// Vertices with equal coordinates become one.
inline Polygon_table joined(std::vector<Shape_polygons>& of_shapes)
{
  Polygon_table result;
  std::map<Position, std::uint32_t> number_of;
  for(Shape_polygons& shape : of_shapes) {
    std::vector<std::uint32_t> numbers;
    for(const Position& p : shape.vertices) {
      const auto added = number_of.emplace(p, std::uint32_t(result.points.size()));
      if(added.second)
        result.points.push_back(p);
      numbers.push_back(added.first->second);
    }
    const auto renumber = [&](auto& corners) {
      for(std::uint32_t& corner : corners)
        corner = numbers[corner];
    };
    for(Polygon& polygon : shape.polygons) {
      renumber(polygon.outer);
      for(Polygon::Loop& hole : polygon.holes)
        renumber(hole);
      for(auto& triangle : polygon.triangles)
        renumber(triangle);
    }
    result.polygons.push_back(std::move(shape.polygons));
    result.areas.push_back(shape.area);
  }
  return result;
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_JOINED_POLYGONS_H
