// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"
#include "file_names.h"
#include "output/write_results.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <ostream>

namespace program {

namespace {

using Faces = std::vector<Polygon::Loop>;

Faces triangles_of(const Polygon& polygon)
{
  Faces result;
  for(const auto& t : polygon.triangles)
    result.emplace_back(t.begin(), t.end());
  return result;
}

// Without holes.
Faces faces_of(const Shape_polygons& shape, Faces_of_file kind)
{
  Faces result;
  for(const Polygon& polygon : shape.polygons) {
    if(kind == Faces_of_file::polygons && polygon.holes.empty()) {
      result.push_back(polygon.outer);
      continue;
    }
    const Faces triangles = triangles_of(polygon);
    result.insert(result.end(), triangles.begin(), triangles.end());
  }
  return result;
}

void write_ply(std::ostream& out, const std::vector<Shape_polygons>& all, Faces_of_file kind)
{
  std::vector<Faces> faces;
  std::size_t number_of_vertices = 0, number_of_faces = 0, largest = 0;
  for(const Shape_polygons& shape : all) {
    number_of_vertices += shape.vertices.size();
    faces.push_back(faces_of(shape, kind));
    number_of_faces += faces.back().size();
    for(const Polygon::Loop& face : faces.back())
      largest = (std::max)(largest, face.size());
  }
  const bool is_small = largest <= (std::numeric_limits<std::uint8_t>::max)(); // some readers know no other type
  out << "ply\nformat binary_little_endian 1.0\ncomment detect_planes of Tandem\nelement vertex " << number_of_vertices
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << number_of_faces
      << "\nproperty list " << (is_small ? "uchar" : "int")
      << " int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property int shape\nend_header\n";
  Binary_writer binary(out);
  for(const Shape_polygons& shape : all)
    for(const Position& vertex : shape.vertices)
      for(double x : vertex)
        binary.write(x);
  std::size_t first = 0;
  for(std::size_t s = 0; s < all.size(); ++s) {
    for(const Polygon::Loop& face : faces[s]) {
      if(is_small)
        binary.write(std::uint8_t(face.size()));
      else
        binary.write(std::int32_t(face.size()));
      for(std::uint32_t corner : face)
        binary.write(std::int32_t(first + corner));
      for(std::uint8_t channel : color_of_shape(int(s)))
        binary.write(channel);
      binary.write(std::int32_t(s));
    }
    first += all[s].vertices.size();
  }
}

void write_obj(std::ostream& out, const std::vector<Shape_polygons>& all, Faces_of_file kind)
{
  out << "# detect_planes of Tandem\n" << std::setprecision(17);
  std::size_t first = 1; // OBJ counts from 1
  for(std::size_t s = 0; s < all.size(); ++s) {
    out << "g shape_" << s << '\n';
    for(const Position& v : all[s].vertices)
      out << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    for(const Polygon::Loop& face : faces_of(all[s], kind)) {
      out << 'f';
      for(std::uint32_t corner : face)
        out << ' ' << first + corner;
      out << '\n';
    }
    first += all[s].vertices.size();
  }
}

// --- GeoJSON, of which no more than a polygon is in memory at once

// The first corner again at the end.
Json json_of_ring(const Shape_polygons& shape, const Polygon::Loop& ring)
{
  Json json = Json::array();
  for(std::size_t i = 0; i <= ring.size(); ++i)
    json.push_back(shape.vertices[ring[i % ring.size()]]);
  return json;
}

void write_coordinates(std::ostream& out, const Shape_polygons& shape, Faces_of_file faces)
{
  const char* before = "\n   ";
  const auto write_polygon = [&](const Polygon::Loop& outer, const std::vector<Polygon::Loop>& holes) {
    Json json = Json::array({json_of_ring(shape, outer)});
    for(const Polygon::Loop& hole : holes)
      json.push_back(json_of_ring(shape, hole));
    out << before << json;
    before = ",\n   ";
  };
  for(const Polygon& polygon : shape.polygons)
    if(faces == Faces_of_file::triangles)
      for(const Polygon::Loop& triangle : triangles_of(polygon))
        write_polygon(triangle, {});
    else
      write_polygon(polygon.outer, polygon.holes);
}

void write_geojson(std::ostream& out, const std::vector<Shape_polygons>& all, const Shapes& shapes, Faces_of_file faces)
{
  out << R"({"type": "FeatureCollection", "features": [)";
  for(std::size_t s = 0; s < all.size(); ++s) {
    const Json properties = {{"shape", s},
                             {"plane", shapes.coefficients(s)},
                             {"parallel_group", shapes.parallel_group(s)},
                             {"coplanar_group", shapes.coplanar_group(s)},
                             {"points", shapes.points(s).size()},
                             {"area", all[s].area}};
    out << (s == 0 ? "\n" : ",\n") << R"( {"type": "Feature", "properties": )" << properties
        << R"(, "geometry": {"type": "MultiPolygon", "coordinates": [)";
    write_coordinates(out, all[s], faces);
    out << "]}}";
  }
  out << "\n]}\n";
}

} // namespace

void write_polygons(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& path,
                    Faces_of_file kind)
{
  const std::vector<Shape_polygons> all = polygons_of_shapes(points, shapes);
  const std::string extension = lower_case_extension(path);
  if(extension == ".obj")
    write_obj(out, all, kind);
  else if(extension == ".ply")
    write_ply(out, all, kind);
  else
    write_geojson(out, all, shapes, kind);
}

} // namespace program
