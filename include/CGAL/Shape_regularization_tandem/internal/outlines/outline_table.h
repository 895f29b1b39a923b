// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outlines of shapes. They do not depend on the sides of the planes: they are made for those with positive normals.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_OUTLINE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_OUTLINE_TABLE_H

#include <CGAL/Shape_regularization_tandem/internal/outlines/Polygon_maker.h>

#include <algorithm>
#include <cmath>
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

// Outlines that are not regular are straightened only.
inline Polygon_table outline_table(const std::vector<Kernel::Point_3>& points, const Shapes_data& data,
                                   bool are_regular = true)
{
  const Shapes shapes(with_positive_normals(data));
  return with_sides_of(data.coefficients, Polygon_maker(points, shapes).polygons(are_regular));
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_OUTLINE_TABLE_H
