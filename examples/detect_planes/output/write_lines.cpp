// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines at which the shapes meet.

#include "output/writers.h"

#include <CGAL/Shape_regularization_tandem/lines.h>

namespace program {

namespace {

using Lines = CGAL::Tandem::Shape_lines_3<Kernel>;
using Segment = CGAL::Tandem::Indexed_segment;

Json json_of(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

// Between the planes, at most 90 degrees.
double angle_of(const Segment& segment, const Shapes& shapes)
{
  const Kernel::Vector_3 a = shapes.plane(segment.shapes[0]).orthogonal_vector();
  const Kernel::Vector_3 b = shapes.plane(segment.shapes[1]).orthogonal_vector();
  const double sine = std::sqrt(CGAL::cross_product(a, b).squared_length());
  return std::atan2(sine, std::fabs(a * b)) * 180 / CGAL_PI;
}

// Whether both shapes are behind the outward side of the other one, or both before it; otherwise null.
Json convexity_of(const Segment& segment, const Shapes& shapes, const Run& run)
{
  const auto outward = [&](std::size_t i) {
    return shapes.is_flipped(segment.shapes[1 - i]) ? -segment.sides[i] : segment.sides[i];
  };
  if(!run.has_outward_sides || outward(0) == 0 || outward(0) != outward(1))
    return nullptr;
  return outward(0) < 0;
}

void write_features(std::ostream& out, const Lines& lines, const Shapes& shapes, const Run& run, const Options& o)
{
  begin_geojson(out, o);
  std::size_t id = 0;
  const auto write = [&](const Json& properties, const char* type, const Json& coordinates) {
    out << (id == 0 ? "\n" : ",\n") << R"( {"type": "Feature", "id": )" << id << R"(, "properties": )" << properties
        << R"(, "geometry": {"type": ")" << type << R"(", "coordinates": )" << coordinates << "}}";
    ++id;
  };
  for(const Segment& segment : lines.segments) {
    const Kernel::Point_3 &p = lines.points[segment.ends[0]], &q = lines.points[segment.ends[1]];
    write({{"shapes", segment.shapes},
           {"length", std::hypot(q.x() - p.x(), q.y() - p.y(), q.z() - p.z())},
           {"angle", angle_of(segment, shapes)},
           {"convex", convexity_of(segment, shapes, run)}},
          "LineString", {json_of(p), json_of(q)});
  }
  for(const CGAL::Tandem::Indexed_corner& corner : lines.corners)
    write({{"shapes", corner.shapes}}, "Point", json_of(lines.points[corner.point]));
  out << "\n]}\n";
}

// AutoCAD R12, which needs nothing but the entities.
void write_dxf(std::ostream& out, const Lines& lines)
{
  out << std::setprecision(17) << "999\ndetect_planes of Tandem\n0\nSECTION\n2\nENTITIES\n";
  const auto write = [&](const Kernel::Point_3& p, int which) {
    for(int k = 0; k < 3; ++k)
      out << 10 * (k + 1) + which << '\n' << p[k] << '\n';
  };
  for(const Segment& segment : lines.segments) {
    out << "0\nLINE\n8\nLINES\n";
    write(lines.points[segment.ends[0]], 0);
    write(lines.points[segment.ends[1]], 1);
  }
  for(const CGAL::Tandem::Indexed_corner& corner : lines.corners) {
    out << "0\nPOINT\n8\nCORNERS\n";
    write(lines.points[corner.point], 0);
  }
  out << "0\nENDSEC\n0\nEOF\n";
}

void write_line_elements(std::ostream& out, const Lines& lines)
{
  out << "# detect_planes of Tandem\n";
  write_vertices(out, lines.points, "v ");
  for(const Segment& segment : lines.segments)
    write_corners(out << 'l', segment.ends, 1) << '\n';
  for(const CGAL::Tandem::Indexed_corner& corner : lines.corners)
    write_corners(out << 'p', std::array<std::uint32_t, 1>{corner.point}, 1) << '\n';
}

} // namespace

void write_lines(std::ostream& out, const Described_shapes& described, const Run& run, const Options& o)
{
  const Lines lines = CGAL::Tandem::lines(described.shapes, described.areas());
  if(is_geojson(o.lines))
    write_features(out, lines, described.shapes, run, o);
  else if(lower_case_extension(o.lines) == ".dxf")
    write_dxf(out, lines);
  else
    write_line_elements(out, lines);
}

} // namespace program
