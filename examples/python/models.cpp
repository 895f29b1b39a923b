// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "detection.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/lines.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <CGAL/Polygon_with_holes_2.h>

#include <algorithm>
#include <limits>

namespace tandem_python {

namespace {

template <class Range>
void append(const Range& numbers, Indices& to)
{
  for(auto number : numbers)
    to.push_back(std::int32_t(number));
}

// A run of numbers, and where the next one starts.
template <class Range>
void append_run(const Range& numbers, Indices& to, Indices& starts)
{
  append(numbers, to);
  starts.push_back(std::int32_t(to.size()));
}

// Numbers beyond those of int are as good as the last ones.
int number_of(const std::optional<long long>& given, int otherwise)
{
  using Limits = std::numeric_limits<int>;
  return given ? int((std::max)(Limits::min() + 0LL, (std::min)(*given, Limits::max() + 0LL))) : otherwise;
}

std::vector<CGAL::Polygon_with_holes_2<Kernel>> footprints_of(const Surface_settings& settings)
{
  const auto polygon_of = [](const Surface_settings::Ring& ring) {
    CGAL::Polygon_2<Kernel> polygon;
    for(const auto& [x, y] : ring)
      polygon.push_back(Kernel::Point_2(x, y));
    return polygon;
  };
  std::vector<CGAL::Polygon_with_holes_2<Kernel>> result;
  for(const std::vector<Surface_settings::Ring>& rings : settings.footprints) {
    result.emplace_back(rings.empty() ? CGAL::Polygon_2<Kernel>() : polygon_of(rings[0])); // an empty one is refused
    for(std::size_t i = 1; i < rings.size(); ++i)
      result.back().add_hole(polygon_of(rings[i]));
  }
  return result;
}

} // namespace

Polygon_tables polygons(const Cloud& cloud, const Shapes& shapes, bool one_for_each_plane)
{
  const auto areas = CGAL::Tandem::polygons(
    shapes, rows_of(cloud), np::point_map(Point_map{cloud.points}).one_for_each_plane(one_for_each_plane));
  Polygon_tables result;
  result.vertices = areas.points();
  for(std::size_t i = 0; i < areas.number_of_entries(); ++i)
    for(const CGAL::Tandem::Indexed_polygon& polygon : areas.polygons(i)) {
      append_run(polygon.outer, result.loop_vertices, result.loop_starts);
      for(const auto& hole : polygon.holes)
        append_run(hole, result.loop_vertices, result.loop_starts);
      result.polygon_starts.push_back(std::int32_t(result.loop_starts.size() - 1));
      result.polygon_shape.push_back(std::int32_t(i));
      for(const auto& triangle : polygon.triangles)
        append(triangle, result.triangles);
      result.triangle_shape.resize(result.triangles.size() / 3, std::int32_t(i));
    }
  return result;
}

Line_tables lines(const Cloud& cloud, const Shapes& shapes)
{
  auto found = CGAL::Tandem::lines(shapes, rows_of(cloud), np::point_map(Point_map{cloud.points}));
  Line_tables result;
  result.vertices = std::move(found.points);
  for(const CGAL::Tandem::Indexed_segment& segment : found.segments) {
    append(segment.ends, result.segments);
    append(segment.shapes, result.segment_shapes);
  }
  for(const CGAL::Tandem::Indexed_corner& corner : found.corners) {
    result.corners.push_back(std::int32_t(corner.point));
    append_run(corner.shapes, result.corner_shapes, result.corner_starts);
  }
  return result;
}

Surface_tables closed_surface(const Cloud& cloud, const Shapes& shapes, const Surface_settings& settings,
                              const CGAL::Tandem::Callback& callback)
{
  const std::array<double, 3> up = settings.upward.value_or(shapes.parameters().symmetry_direction);
  const auto all = np::point_map(Point_map{cloud.points})
                     .maximum_number_of_planes(number_of(settings.planes, (std::numeric_limits<int>::max)()))
                     .maximum_number_of_components(number_of(settings.components, 0))
                     .symmetry_direction(Kernel::Vector_3(up[0], up[1], up[2]))
                     .footprints(footprints_of(settings))
                     .callback(callback);
  auto surface = settings.base ? CGAL::Tandem::closed_surface(shapes, rows_of(cloud), all.base_height(*settings.base))
                               : CGAL::Tandem::closed_surface(shapes, rows_of(cloud), all);
  Surface_tables result;
  result.vertices = std::move(surface.points);
  for(const auto& triangle : surface.triangles)
    append(triangle, result.triangles);
  append(surface.face_of_triangle, result.triangle_face);
  for(const auto& face : surface.faces)
    append_run(face, result.face_vertices, result.face_starts);
  append(surface.plane_of_face, result.face_plane);
  result.face_supported = std::move(surface.supported_of_face);
  result.supported = surface.supported;
  result.number_of_points = surface.number_of_points;
  result.number_of_planes = surface.number_of_planes;
  result.number_of_omitted_planes = surface.number_of_omitted_planes;
  return result;
}

} // namespace tandem_python
