// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The areas of the shapes as a mesh: binary PLY with the shape of each face, or OBJ with
// a group for each shape. Shapes share no vertices.

#ifndef DETECT_PLANES_WRITE_POLYGONS_H
#define DETECT_PLANES_WRITE_POLYGONS_H

#include "output/shape_polygons.h"

#include <vector>

namespace program {

inline std::vector<Shape_polygons> polygons_of_shapes(const Point_set& points, const Shapes& shapes)
{
  std::vector<Shape_polygons> result;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    result.push_back(polygons_of_shape(points, shapes, s));
  return result;
}

inline void write_polygons_ply(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  const std::vector<Shape_polygons> all = polygons_of_shapes(points, shapes);
  std::size_t vertices = 0, faces = 0;
  for(const Shape_polygons& p : all) {
    vertices += p.vertices.size();
    faces += p.triangles.size();
  }
  out << "ply\nformat binary_little_endian 1.0\ncomment detect_planes of Tandem\nelement vertex " << vertices
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << faces
      << "\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property int shape\nend_header\n";
  Binary_writer binary(out);
  for(const Shape_polygons& p : all)
    for(const auto& vertex : p.vertices)
      for(double x : vertex)
        binary.write(x);
  std::uint32_t first = 0;
  for(std::size_t s = 0; s < all.size(); ++s) {
    for(const auto& triangle : all[s].triangles) {
      binary.write(std::uint8_t(3));
      for(std::uint32_t corner : triangle)
        binary.write(std::int32_t(first + corner));
      for(std::uint8_t channel : color_of_shape(int(s)))
        binary.write(channel);
      binary.write(std::int32_t(s));
    }
    first += std::uint32_t(all[s].vertices.size());
  }
}

inline void write_polygons_obj(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  out << "# detect_planes of Tandem\n" << std::setprecision(17);
  std::uint32_t first = 1; // OBJ counts from 1
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const Shape_polygons p = polygons_of_shape(points, shapes, s);
    out << "g shape_" << s << '\n';
    for(const auto& v : p.vertices)
      out << "v " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    for(const auto& t : p.triangles)
      out << "f " << first + t[0] << ' ' << first + t[1] << ' ' << first + t[2] << '\n';
    first += std::uint32_t(p.vertices.size());
  }
}

inline void write_polygons(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& path)
{
  if(lower_case_extension(path) == ".obj")
    write_polygons_obj(out, points, shapes);
  else
    write_polygons_ply(out, points, shapes);
}

} // namespace program

#endif // DETECT_PLANES_WRITE_POLYGONS_H
