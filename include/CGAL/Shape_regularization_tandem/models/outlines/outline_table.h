// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outlines of shapes. They do not depend on the sides of the planes: they are made for those with positive normals.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TABLE_H

#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Polygon_maker.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// Whether the largest number in the normal is negative.
inline bool is_turned(const Coefficients& c)
{
  const auto is_smaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  return *std::max_element(c.begin(), c.begin() + 3, is_smaller) < 0;
}

// The largest number of each normal is positive.
inline Shapes_data with_positive_normals(Shapes_data data)
{
  for(Coefficients& c : data.coefficients)
    if(is_turned(c))
      for(double& x : c)
        x = -x;
  return data;
}

// To the planes as they were.
inline Polygon_table with_sides_of(const std::vector<Coefficients>& planes, Polygon_table table)
{
  const auto reverse = [](auto& corners) { std::reverse(corners.begin(), corners.end()); };
  for(std::size_t s = 0; s < planes.size(); ++s) {
    if(!is_turned(planes[s]))
      continue;
    table.frames[s] = Projection(planes[s]);
    for(Polygon& polygon : table.polygons[s]) {
      reverse(polygon.outer);
      for(Polygon::Loop& hole : polygon.holes)
        reverse(hole);
      for(auto& triangle : polygon.triangles)
        reverse(triangle);
    }
  }
  return table;
}

// Of shapes with points.
inline Polygon_table table_of_outlines(const std::vector<Position>& points, const Shapes_data& data, bool are_regular)
{
  const Shapes shapes(with_positive_normals(data));
  return with_sides_of(data.coefficients, Polygon_maker(points, shapes).polygons(are_regular));
}

// Known planes may have no points.
CGAL_TANDEM_MODELS_INLINE Polygon_table outline_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      bool are_regular)
{
  std::vector<std::size_t> source;
  std::vector<int> number(data.size.size(), -1);
  for(std::size_t s = 0; s < number.size(); ++s)
    if(data.size[s] > 0) {
      number[s] = int(source.size());
      source.push_back(s);
    }
  if(source.size() == number.size())
    return table_of_outlines(points, data, are_regular);
  Polygon_table table = table_of_outlines(points, relabel_shapes(data, source, number), are_regular), all;
  all.points = std::move(table.points);
  all.polygons.resize(number.size());
  all.areas.assign(number.size(), 0);
  for(std::size_t s = 0; s < number.size(); ++s) {
    all.frames.emplace_back(data.coefficients[s]);
    if(number[s] < 0)
      continue;
    all.polygons[s] = std::move(table.polygons[std::size_t(number[s])]);
    all.areas[s] = table.areas[std::size_t(number[s])];
    all.frames[s] = table.frames[std::size_t(number[s])];
  }
  return all;
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TABLE_H
