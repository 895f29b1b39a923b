// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/Mesh.h"
#include "output/writers.h"
#include "view/write_points.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <boost/algorithm/string/replace.hpp>

#include <cstring>
#include <iterator>

namespace program {

// The page before and after the data, as embed_page.cmake puts it together of three.js and the files of this folder: in
// pieces, as compilers limit the length of a literal. A null pointer is at the end.
extern const char* const page_before_data[];
extern const char* const page_after_data[];

namespace {

const std::string no_model = "<script type=\"text/plain\" id=\"model\">\n</script>\n";

// --- Outlines and triangles of the shapes

using Polygon = CGAL::Tandem::Indexed_polygon;

// Their number, and of each its number of corners and these.
void write_loops(Base64_lines& lines, const std::vector<Polygon>& polygons)
{
  std::vector<Polygon::Loop> loops;
  for(const Polygon& polygon : polygons) {
    loops.push_back(polygon.outer);
    loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
  }
  lines.write(std::uint32_t(loops.size()));
  for(const Polygon::Loop& loop : loops) {
    lines.write(std::uint32_t(loop.size()));
    for(std::uint32_t corner : loop)
      lines.write(corner);
  }
}

// Three elements, which layers.js reads: the corners, three floats each, relative to the center of the page; then for
// each shape the number of its loops, and for each loop its number of corners and these; then for each shape the number
// of its triangles, and their corners. Corners are positions in the first element, of 32 bits.
void write_areas(std::ostream& out, const Shape_areas& areas, const Kernel::Point_3& center)
{
  write_numbers(out, "corners", [&](Base64_lines& lines) {
    for(const Kernel::Point_3& p : areas.points())
      for(int k = 0; k < 3; ++k)
        lines.write(float(p[k] - center[k]));
  });
  write_numbers(out, "loops", [&](Base64_lines& lines) {
    for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
      write_loops(lines, areas.polygons(s));
  });
  write_numbers(out, "triangles", [&](Base64_lines& lines) {
    for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
      const auto triangles = areas.triangles(s);
      lines.write(std::uint32_t(triangles.size()));
      for(const auto& triangle : triangles)
        for(std::uint32_t corner : triangle)
          lines.write(corner);
    }
  });
}

// --- The scene and its points

constexpr std::size_t largest_number_of_points = 3000000; // that a browser draws well

void write_pieces(std::ostream& out, const char* const* pieces)
{
  for(; *pieces != nullptr; ++pieces)
    out << *pieces;
}

// What the first look shows: the shapes, as points without one may be far away; all points where none has a shape.
CGAL::Bbox_3 box_of_shapes(const Point_set& points, const Shapes& shapes)
{
  const bool has_points = shapes.statistics().number_of_assigned_points > 0;
  CGAL::Bbox_3 box;
  std::size_t position = 0;
  for(Point_set::Index i : points)
    if((shapes.shape_index(position++) >= 0 || !has_points) && is_finite(points.point(i)))
      box += points.point(i).bbox();
  return box;
}

Kernel::Point_3 center_of(const CGAL::Bbox_3& box)
{
  const auto middle = [&](int k) { return box.min(k) / 2 + box.max(k) / 2; }; // their sum may be too large
  return Kernel::Point_3(middle(0), middle(1), middle(2));
}

// Lists: the columns of the table, and what the page takes from them in another form.
Json json_of_shapes(const Shapes& shapes, const Json& table, const Run& run, const Kernel::Point_3& center)
{
  const bool has_sides = run.normals == "given" || run.normals.find("viewpoint") != std::string::npos;
  Json json = table;
  std::vector<double> plane, centroid;
  std::vector<int> outward; // 1 if that side is the one of the normal, -1 if it is the other one, 0 if it is not known
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto& c = shapes.coefficients(s);
    plane.insert(plane.end(), c.begin(), c.end());
    int axis = 0;
    for(const char* name : {"x", "y", "z"}) { // a shape without points is at the center
      const double x = table[name][s].get<double>();
      centroid.push_back(std::isnan(x) ? 0 : x - center[axis]);
      ++axis;
    }
    outward.push_back(!has_sides ? 0 : shapes.is_flipped(s) ? -1 : 1);
  }
  json["coefficients"] = plane;
  json["centroid"] = centroid;
  json["outward"] = outward;
  return json;
}

// But for the shapes.
Json json_of_scene(const Shapes& shapes, const Run& run, const Thinned_points& thinned, const CGAL::Bbox_3& box)
{
  const Kernel::Point_3 center = center_of(box);
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  return {{"name", utf8(std::filesystem::path(run.input).filename().string())},
          {"points", s.number_of_points},
          {"assigned", s.number_of_assigned_points},
          {"ignored", s.number_of_ignored_points()},
          {"directions", s.number_of_directions},
          {"planes", s.number_of_planes},
          {"shown", thinned.size()},
          {"stride", thinned.stride},
          {"coverage", s.coverage},
          {"maximum_distance", shapes.parameters().maximum_distance},
          {"center", {center.x(), center.y(), center.z()}},
          {"extent", {box.x_span(), box.y_span(), box.z_span()}},
          {"up", run.up.direction},
          {"orthogonal", shapes.orthogonal_groups()}};
}

// Points without a shape may be so far away that the steps of their block are larger than the cloud. So they are written
// from the inside to the outside, with the blocks of each reach apart. Gives the positions as they were written.
Positions write_points(std::ostream& out, const Point_set& points, const Shapes& shapes, const Thinned_points& thinned,
                       const CGAL::Bbox_3& box)
{
  constexpr std::ptrdiff_t block_size = 4096;
  const Kernel::Point_3 center = center_of(box);
  Positions positions = thinned.positions;
  auto written = positions.begin(), next = positions.end() - std::ptrdiff_t(thinned.shown.back());
  double reach = 2 * (std::max)({box.x_span(), box.y_span(), box.z_span(), 1e-300});
  const auto is_near = [&](std::uint32_t position) {
    const Kernel::Vector_3 v = point_at(points, position) - center;
    return (std::max)({std::fabs(v.x()), std::fabs(v.y()), std::fabs(v.z())}) <= reach;
  };
  for(; written != positions.end(); reach *= 64) {
    next = std::stable_partition(next, positions.end(), is_near);
    for(auto end = written; written != next; written = end) {
      end += (std::min)(block_size, next - written);
      out << base64(block_of(points, shapes, center, Positions(written, end))) << '\n';
    }
  }
  return positions;
}

} // namespace

void write_view(std::ostream& out, const Described_shapes& described, const Run& run)
{
  const Point_set& points = described.points;
  const Shapes& shapes = described.shapes;
  const Thinned_points thinned(points, shapes, largest_number_of_points);
  const CGAL::Bbox_3 box = box_of_shapes(points, shapes);
  write_pieces(out, page_before_data);
  out << "<script type=\"application/json\" id=\"scene\">";
  Json scene = json_of_scene(shapes, run, thinned, box);
  const Kernel::Point_3 center = center_of(box);
  const Json& table = described.table();
  scene["shapes"] = json_of_shapes(shapes, table, run, center);
  for(const auto& column : table.items())
    scene["table"].push_back(column.key());
  scene["shapes"]["shown"] = thinned.shown;                     // one more: points without a shape
  out << boost::replace_all_copy(ascii(scene), "<", "\\u003c"); // no </script>
  out << "</script>\n<script type=\"text/plain\" id=\"points\">\n";
  const Positions positions = write_points(out, points, shapes, thinned, box);
  out << "</script>\n";
  write_areas(out, described.areas(), center);
  // Three bytes for each of the positions, if the input has colors; else the element is empty.
  const auto colors = find_property<Input_color>(points, color_name);
  write_numbers(out, "input-colors", [&](Base64_lines& lines) {
    for(std::size_t i = 0; colors && i < positions.size(); ++i)
      for(std::uint16_t channel : (*colors)[*(points.begin() + std::ptrdiff_t(positions[i]))])
        lines.write(std::uint8_t(channel >> 8));
  });
  out << no_model;
  write_pieces(out, page_after_data);
}

// In place of the empty element, which is before the last pieces. For each triangle nine floats, the coordinates of its
// corners relative to the center of the page; the index of a shape in its plane, or the number of shapes, of 24 bits; and
// a byte for the share of its face that has points.
void write_view_with_mesh(std::ostream& out, std::istream& page, const Described_shapes& described, const Mesh& mesh)
{
  std::size_t behind = no_model.size();
  for(const char* const* piece = page_after_data; *piece != nullptr; ++piece)
    behind += std::strlen(*piece);
  std::string text(std::istreambuf_iterator<char>(page), {});
  text.resize(text.size() - behind);
  out << text;
  const Kernel::Point_3 center = center_of(box_of_shapes(described.points, described.shapes));
  const CGAL::Tandem::Closed_surface_3<Kernel>& surface = mesh.surface;
  write_numbers(out, "model", [&](Base64_lines& lines) {
    for(std::size_t t = 0; t < surface.triangles.size(); ++t) {
      for(std::size_t corner : surface.triangles[t])
        for(int k = 0; k < 3; ++k)
          lines.write(float(surface.points[corner][k] - center[k]));
      const std::size_t face = surface.face_of_triangle[t];
      const int shape = mesh.shape_of_face[face];
      const std::size_t mark = shape < 0 ? described.shapes.number_of_shapes() : std::size_t(shape);
      lines.write(std::uint32_t(mark + (std::size_t(std::lround(255 * surface.supported_of_face[face])) << 24)));
    }
  });
  write_pieces(out, page_after_data);
}

} // namespace program
