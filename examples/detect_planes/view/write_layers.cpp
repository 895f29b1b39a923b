// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "view/write_layers.h"
#include "input/point_set.h"
#include "view/Base64_lines.h"

#include <CGAL/Shape_regularization_tandem/Indexed_polygon.h>

namespace program {

namespace {

using Polygon = CGAL::Tandem::Indexed_polygon;

void write_loop(Base64_lines& lines, const Polygon::Loop& loop)
{
  lines.write(std::uint32_t(loop.size()));
  for(std::uint32_t corner : loop)
    lines.write(corner);
}

void write_loops(std::ostream& out, const Shape_areas& areas)
{
  Base64_lines lines(out, "loops");
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
    std::size_t size = 0;
    for(const Polygon& polygon : areas.polygons(s))
      size += 1 + polygon.holes.size();
    lines.write(std::uint32_t(size));
    for(const Polygon& polygon : areas.polygons(s)) {
      write_loop(lines, polygon.outer);
      for(const Polygon::Loop& hole : polygon.holes)
        write_loop(lines, hole);
    }
  }
}

void write_triangles(std::ostream& out, const Shape_areas& areas)
{
  Base64_lines lines(out, "triangles");
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
    const auto triangles = areas.triangles(s);
    lines.write(std::uint32_t(triangles.size()));
    for(const auto& triangle : triangles)
      for(std::uint32_t corner : triangle)
        lines.write(corner);
  }
}

} // namespace

void write_areas(std::ostream& out, const Shape_areas& areas, const Kernel::Point_3& center)
{
  {
    Base64_lines lines(out, "corners");
    for(const Kernel::Point_3& p : areas.points())
      for(int k = 0; k < 3; ++k)
        lines.write(float(p[k] - center[k]));
  }
  write_loops(out, areas);
  write_triangles(out, areas);
}

void write_input_colors(std::ostream& out, const Point_set& points, const std::vector<std::uint32_t>& positions)
{
  Base64_lines lines(out, "input-colors");
  const auto colors = points.property_map<Input_color>(color_name);
  if(!colors.second)
    return;
  for(std::uint32_t position : positions)
    for(std::uint16_t channel : colors.first[*(points.begin() + std::ptrdiff_t(position))])
      lines.write(std::uint8_t(channel >> 8));
}

} // namespace program
