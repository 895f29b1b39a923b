// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes as polygons and as vertex groups.

#include "output/writers.h"

namespace program {

namespace {

using Polygon = CGAL::Tandem::Indexed_polygon;

struct Face {
  std::size_t shape;
  Polygon::Loop corners;
};
using Faces = std::vector<Face>;

// Without holes, counterclockwise as seen from the outward side.
Faces faces_of(const Shape_areas& areas, const Shapes& shapes, Faces_of_file kind)
{
  Faces result;
  const auto add = [&](std::size_t s, Polygon::Loop corners) {
    if(shapes.is_flipped(s))
      std::reverse(corners.begin(), corners.end());
    result.push_back({s, std::move(corners)});
  };
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const Polygon& polygon : areas.polygons(s)) {
      if(kind == Faces_of_file::polygons && polygon.holes.empty()) {
        add(s, polygon.outer);
        continue;
      }
      for(const auto& t : polygon.triangles)
        add(s, {t.begin(), t.end()});
    }
  return result;
}

void write_ply(std::ostream& out, const Shape_areas& areas, const Faces& faces)
{
  std::size_t largest = 0;
  for(const Face& face : faces)
    largest = (std::max)(largest, face.corners.size());
  const bool is_small = largest <= (std::numeric_limits<std::uint8_t>::max)(); // some readers know no other type
  out << "ply\nformat binary_little_endian 1.0\ncomment detect_planes of Tandem\nelement vertex "
      << areas.points().size() << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
      << faces.size() << "\nproperty list " << (is_small ? "uchar" : "int")
      << " int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty int "
         "shape\nend_header\n";
  Binary_writer binary(out);
  for(const Kernel::Point_3& p : areas.points())
    for(int k = 0; k < 3; ++k)
      binary.write(p[k]);
  for(const Face& face : faces) {
    if(is_small)
      binary.write(std::uint8_t(face.corners.size()));
    else
      binary.write(std::int32_t(face.corners.size()));
    for(std::uint32_t corner : face.corners)
      binary.write(std::int32_t(corner));
    for(std::uint8_t channel : color_of_shape(int(face.shape)))
      binary.write(channel);
    binary.write(std::int32_t(face.shape));
  }
}

void write_obj(std::ostream& out, const Shape_areas& areas, const Faces& faces)
{
  out << "# detect_planes of Tandem\n";
  write_vertices(out, areas.points(), "v ");
  auto face = faces.begin();
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
    out << "g shape_" << s << '\n';
    for(; face != faces.end() && face->shape == s; ++face) {
      out << 'f';
      write_corners(out, face->corners, 1);
      out << '\n';
    }
  }
}

void write_off(std::ostream& out, const Shape_areas& areas, const Faces& faces)
{
  out << "OFF\n# detect_planes of Tandem\n" << areas.points().size() << ' ' << faces.size() << " 0\n";
  write_vertices(out, areas.points(), "");
  for(const Face& face : faces) {
    out << face.corners.size();
    write_corners(out, face.corners, 0);
    for(std::uint8_t channel : color_of_shape(int(face.shape)))
      out << ' ' << int(channel);
    out << '\n';
  }
}

// --- GeoJSON, of which no more than a polygon is in memory at once

// Exterior rings are counterclockwise as seen from above, as RFC 7946 wants it. Upright ones are so about the normal of
// the written plane.
bool is_seen_from_below(const Shapes& shapes, std::size_t s)
{
  constexpr double rounding = 1e-9; // of unit normals; it is far less than that
  return shapes.coefficients(s)[2] < -rounding;
}

// The first corner again at the end.
Json json_of_ring(const Shape_areas& areas, Polygon::Loop ring, bool is_reversed)
{
  if(is_reversed)
    std::reverse(ring.begin(), ring.end());
  Json json = Json::array();
  for(std::size_t i = 0; i <= ring.size(); ++i) {
    const Kernel::Point_3& p = areas.points()[ring[i % ring.size()]];
    json.push_back({p.x(), p.y(), p.z()});
  }
  return json;
}

void write_coordinates(std::ostream& out, const Shape_areas& areas, const Shapes& shapes, std::size_t s,
                       Faces_of_file faces)
{
  const char* before = "\n   ";
  const bool is_reversed = is_seen_from_below(shapes, s);
  const auto write_polygon = [&](const Polygon::Loop& outer, const std::vector<Polygon::Loop>& holes) {
    Json json = Json::array({json_of_ring(areas, outer, is_reversed)});
    for(const Polygon::Loop& hole : holes)
      json.push_back(json_of_ring(areas, hole, is_reversed));
    out << before << json;
    before = ",\n   ";
  };
  for(const Polygon& polygon : areas.polygons(s))
    if(faces == Faces_of_file::triangles)
      for(const auto& triangle : polygon.triangles)
        write_polygon({triangle.begin(), triangle.end()}, {});
    else
      write_polygon(polygon.outer, polygon.holes);
}

// The properties of a shape are its row of the table of shapes, with the plane as one list.
void write_geojson(std::ostream& out, const Described_shapes& described, const Polygon_format& format)
{
  const Shape_areas& areas = described.areas();
  const Shapes& shapes = described.shapes;
  out << R"({"type": "FeatureCollection", )";
  if(!format.crs.empty())
    out << R"("crs": {"type": "name", "properties": {"name": )" << ascii(Json(utf8(format.crs))) << "}}, ";
  out << R"("features": [)";
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
    Json properties = {{"shape", s}, {"plane", shapes.coefficients(s)}};
    for(const auto& column : described.table().items())
      if(std::string("abcd").find(column.key()) == std::string::npos)
        properties[column.key()] = column.value()[s];
    out << (s == 0 ? "\n" : ",\n") << R"( {"type": "Feature", "id": )" << s << R"(, "properties": )" << properties
        << R"(, "geometry": {"type": "MultiPolygon", "coordinates": [)";
    write_coordinates(out, areas, shapes, s, format.faces);
    out << "]}}";
  }
  out << "\n]}\n";
}

// --- Vertex groups

constexpr std::uint32_t not_in_file = std::uint32_t(-1);

// The position of each point in the file. The readers know no NaN and no infinity, so such points are left out.
std::vector<std::uint32_t> positions_in_vg(const Point_set& points, std::uint32_t& count)
{
  std::vector<std::uint32_t> position;
  count = 0;
  for(Point_set::Index i : points)
    position.push_back(is_finite(points.point(i)) ? count++ : not_in_file);
  return position;
}

// The readers take numbers of single precision: digits for that are enough where the input has no more.
template <class Real>
void write_vg_coordinates(std::ostream& out, const Point_set& points)
{
  for(Point_set::Index i : points)
    if(const Kernel::Point_3& p = points.point(i); is_finite(p)) {
      write_shortest(out, Real(p.x()), ' ');
      write_shortest(out, Real(p.y()), ' ');
      write_shortest(out, Real(p.z()), '\n');
    }
}

// Normals of length 1, to a hundredth of a degree. The null vector, where a point has none.
void write_vg_normals(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  const auto rounded = [](double x) { return std::round(1e4 * x) / 1e4 + 0.; }; // no -0
  for(Point_set::Index i : points)
    if(is_finite(points.point(i))) {
      const Kernel::Vector_3 n = normal_used(points, shapes, i);
      const double length = is_usable_normal(n) ? std::sqrt(n.squared_length()) : 0;
      const Kernel::Vector_3 unit = length > 0 ? n / length : Kernel::Vector_3(CGAL::NULL_VECTOR);
      write_shortest(out, rounded(unit.x()), ' ');
      write_shortest(out, rounded(unit.y()), ' ');
      write_shortest(out, rounded(unit.z()), '\n');
    }
}

// Colors of points are left out: groups have one.
void write_vg_points(std::ostream& out, const Point_set& points, const Shapes& shapes, std::uint32_t count)
{
  out << "num_points: " << count << '\n';
  if(needs_double(points, [&](Point_set::Index i) { return points.point(i); }))
    write_vg_coordinates<double>(out, points);
  else
    write_vg_coordinates<float>(out, points);
  out << "num_colors: 0\nnum_normals: " << count << '\n';
  write_vg_normals(out, points, shapes);
}

void write_vg_group(std::ostream& out, const Shapes& shapes, std::size_t s, const std::vector<std::uint32_t>& position)
{
  const auto& c = shapes.coefficients(s);
  const double sign = shapes.is_flipped(s) ? -1 : 1;
  const Color color = color_of_shape(int(s));
  out << "group_type: 0\nnum_group_parameters: 4\ngroup_parameters: " << std::setprecision(17) << sign * c[0] << ' '
      << sign * c[1] << ' ' << sign * c[2] << ' ' << sign * c[3] << "\ngroup_label: shape_" << s
      << "\ngroup_color: " << std::setprecision(3) << color[0] / 255. << ' ' << color[1] / 255. << ' '
      << color[2] / 255. << "\ngroup_num_points: " << shapes.points(s).size() << '\n';
  const char* before = "";
  for(std::size_t i : shapes.points(s)) {
    out << before << position[i];
    before = " ";
  }
  out << "\nnum_children: 0\n";
}

} // namespace

void write_polygons(std::ostream& out, const Described_shapes& described, const Polygon_format& format)
{
  const Shape_areas& areas = described.areas();
  const Shapes& shapes = described.shapes;
  if(format.extension == ".obj")
    write_obj(out, areas, faces_of(areas, shapes, format.faces));
  else if(format.extension == ".ply")
    write_ply(out, areas, faces_of(areas, shapes, format.faces));
  else if(format.extension == ".off")
    write_off(out, areas, faces_of(areas, shapes, format.faces));
  else
    write_geojson(out, described, format);
}

void write_vg(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  std::uint32_t count;
  const std::vector<std::uint32_t> position = positions_in_vg(points, count);
  write_vg_points(out, points, shapes, count);
  out << "num_groups: " << shapes.number_of_shapes() << '\n';
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    write_vg_group(out, shapes, s, position);
}

} // namespace program
