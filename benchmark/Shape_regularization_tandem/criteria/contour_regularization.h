// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's regularization of closed contours in place of that of polygons(): each loop on its own, towards the directions of lines with
// other planes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTOUR_REGULARIZATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTOUR_REGULARIZATION_H

#include "clouds/outline_cloud.h"

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_directions.h>
#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>

#include <CGAL/Shape_regularization/regularize_contours.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace CGAL::Tandem::benchmark {

// A loop that CGAL gives up stays. Edges are joined whose offset is at most the given one.
inline std::vector<Outline_kernel::Point_2>
regularized_contour(const std::vector<Outline_kernel::Point_2>& loop,
                    const std::vector<Outline_kernel::Direction_2>& directions, double maximum_offset)
{
  namespace contours = CGAL::Shape_regularization::Contours;
  using Contour = std::vector<Outline_kernel::Point_2>;
  Contour result;
  const contours::User_defined_directions_2<Outline_kernel, Contour> given(loop, true, directions);
  contours::regularize_closed_contour(loop, given, std::back_inserter(result),
                                      CGAL::parameters::maximum_offset(maximum_offset));
  return result.size() < 3 ? loop : result;
}

// The outlines of a table with regularized loops, and without triangles and areas. spacing: that of the border points of each
// shape, the largest offset of edges that are joined.
inline internal::outlines::Polygon_table regularized_contours(const internal::outlines::Polygon_table& table,
                                                              const Outline_shapes& shapes,
                                                              const std::vector<double>& spacing)
{
  namespace outlines = internal::outlines;
  outlines::Polygon_table result;
  result.frames = table.frames;
  result.polygons.resize(table.polygons.size());
  result.areas.resize(table.polygons.size());
  const outlines::Plane_directions all_directions(shapes);
  const auto point = [&](std::uint32_t i) {
    const internal::Position& p = table.points[i];
    return Outline_kernel::Point_3(p[0], p[1], p[2]);
  };
  for(std::size_t s = 0; s < table.polygons.size(); ++s) {
    if(table.polygons[s].empty())
      continue;
    const outlines::Plane_frame frame(shapes, s, point(table.polygons[s][0].outer[0]));
    const auto along = all_directions.of_shape(s, frame);
    std::vector<Outline_kernel::Direction_2> directions;
    for(std::size_t i = 0; i < along.size(); i += 2) // the others are orthogonal to these
      directions.emplace_back(along[i]);
    const auto regularized = [&](const Indexed_polygon::Loop& loop) {
      std::vector<Outline_kernel::Point_2> flat;
      for(std::uint32_t i : loop)
        flat.push_back(frame.flat(point(i)));
      Indexed_polygon::Loop numbers;
      for(const auto& p : directions.empty() ? flat : regularized_contour(flat, directions, spacing[s])) {
        const Outline_kernel::Point_3 lifted = frame.lifted(p);
        numbers.push_back(std::uint32_t(result.points.size()));
        result.points.push_back({lifted.x(), lifted.y(), lifted.z()});
      }
      return numbers;
    };
    for(const Indexed_polygon& polygon : table.polygons[s]) {
      Indexed_polygon changed;
      changed.outer = regularized(polygon.outer);
      for(const Indexed_polygon::Loop& hole : polygon.holes)
        changed.holes.push_back(regularized(hole));
      result.polygons[s].push_back(std::move(changed));
    }
  }
  return result;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTOUR_REGULARIZATION_H
