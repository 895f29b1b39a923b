// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes as polygons and as vertex groups.

#include "../shape_columns.h"
#include "output/writers.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

namespace program {

Shapes joined_shapes(const Point_set& points, const Shapes& shapes)
{
  return CGAL::Tandem::join_coplanar_shapes(shapes, points);
}

namespace {

auto upward(const std::array<double, 3>& up)
{
  return CGAL::Tandem::parameters::symmetry_direction(Kernel::Vector_3(up[0], up[1], up[2]));
}

// With the places of the sensors, where they are known.
template <class... Areas>
std::vector<CGAL::Tandem::Shape_facts> facts_of(const Shapes& shapes, const Point_set& points,
                                                const std::array<double, 3>& up, const Areas&... areas)
{
  if(const auto places = find_property<Kernel::Point_3>(points, viewpoint_name))
    return CGAL::Tandem::shape_facts(shapes, points, areas..., upward(up).viewpoint_map(*places));
  return CGAL::Tandem::shape_facts(shapes, points, areas..., upward(up));
}

// By size, curvature and class.
Shapes measured_shapes(const Shapes& shapes, const Point_set& points, const Options& o)
{
  if(!o.minimum_area && !o.minimum_extent && !o.minimum_width && !o.is_flat_only && o.shape_classes.empty())
    return shapes;
  const auto facts = CGAL::Tandem::shape_facts(shapes, points, upward(*o.up));
  std::vector<std::size_t> kept;
  for(std::size_t s = 0; s < facts.size(); ++s)
    if(facts[s].area >= o.minimum_area.value_or(0) && facts[s].length >= o.minimum_extent.value_or(0) &&
       facts[s].width >= o.minimum_width.value_or(0) &&
       !(o.is_flat_only && facts[s].curved > tandem_examples::most_curved_face) &&
       (o.shape_classes.empty() || is_in(CGAL::Tandem::shape_class_name(facts[s].shape_class), o.shape_classes)))
      kept.push_back(s);
  return CGAL::Tandem::select_shapes(shapes, kept);
}

} // namespace

Shapes without_veils(const Shapes& shapes, const Point_set& points)
{
  const auto places = *find_property<Kernel::Point_3>(points, viewpoint_name);
  return CGAL::Tandem::select_shapes(shapes, points, CGAL::Tandem::parameters::viewpoint_map(places));
}

Shapes selected_shapes(const Shapes& all, const Point_set& points, const Options& o)
{
  namespace np = CGAL::Tandem::parameters;
  const Shapes shapes = measured_shapes(all, points, o);
  const std::size_t largest = (std::max)(shapes.number_of_shapes(), std::size_t(1));
  const auto list = np::largest(o.largest ? std::size_t(*o.largest) : largest);
  if(!o.near_direction)
    return CGAL::Tandem::select_shapes(shapes, points, list);
  const Direction_choice& choice = *o.near_direction;
  const std::array<double, 3>& d = choice.of == Direction_choice::direction ? choice.normal : *o.up;
  const Kernel::Vector_3 direction(d[0], d[1], d[2]);
  const auto near = list.near_angle(choice.degrees.value_or(10)); // the default of the library
  return choice.of == Direction_choice::vertical
           ? CGAL::Tandem::select_shapes(shapes, points, near.orthogonal_direction(direction))
           : CGAL::Tandem::select_shapes(shapes, points, near.near_direction(direction));
}

const Shape_areas& Described_shapes::areas() const
{
  if(!areas_)
    areas_ = CGAL::Tandem::polygons(shapes, points);
  return *areas_;
}

const Json& Described_shapes::table() const
{
  if(table_)
    return *table_;
  auto facts = facts_of(shapes, points, up, areas());
  if(all != nullptr) {
    const auto before = facts_of(*all, points, up);
    for(std::size_t s = 0; s < facts.size(); ++s)
      if(!shapes.points(s).empty()) {
        const auto& f = before[std::size_t(all->shape_index(shapes.points(s)[0]))];
        facts[s].curved = f.curved;
        facts[s].shape_class = f.shape_class;
        if(f.behind >= 0) // a shape that is not selected has no number
          facts[s].behind = shapes.shape_index(all->points(std::size_t(f.behind))[0]);
      }
  }
  table_.emplace();
  const bool is_seen = points.has_property_map<Kernel::Point_3>(viewpoint_name);
  tandem_examples::for_each_shape_column(shapes, facts, is_seen, [&](const std::string& name, const auto& number_of) {
    Json& column = (*table_)[name] = Json::array();
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
      const Json value = number_of(s);
      column.push_back(value == "" || (value.is_number_integer() && value < 0) ? Json() : value);
    }
  });
  return *table_;
}

Json Described_shapes::surface() const
{
  if(!table_)
    return {};
  double area = 0, curved_area = 0;
  std::size_t curved_shapes = 0;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const bool is_facet = table()["curved"][s].get<double>() > tandem_examples::most_curved_face;
    area += areas().area(s);
    curved_area += is_facet ? areas().area(s) : 0;
    curved_shapes += is_facet ? 1 : 0;
  }
  return {{"area", area}, {"curved_area", curved_area}, {"curved_shapes", curved_shapes}};
}

void write_shape_table(std::ostream& out, const Json& table)
{
  out << "shape";
  for(const auto& column : table.items())
    out << ',' << column.key();
  out << '\n';
  for(std::size_t s = 0; s < table.begin()->size(); ++s) {
    out << s;
    for(const Json& column : table) {
      const std::string text = column[s].is_string() ? column[s].get<std::string>() : column[s].dump();
      out << ',' << (text == "null" ? "" : text);
    }
    out << '\n';
  }
}

namespace {

using Polygon = CGAL::Tandem::Indexed_polygon;

struct Face {
  std::size_t shape;
  Polygon::Loop corners;
};
using Faces = std::vector<Face>;

// Without holes, counterclockwise as seen from the outward side.
Faces faces_of(const Shape_areas& areas, const Shapes& shapes, bool has_triangles_only)
{
  Faces result;
  const auto add = [&](std::size_t s, Polygon::Loop corners) {
    if(shapes.is_flipped(s))
      std::reverse(corners.begin(), corners.end());
    result.push_back({s, std::move(corners)});
  };
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const Polygon& polygon : areas.polygons(s)) {
      if(!has_triangles_only && polygon.holes.empty())
        add(s, polygon.outer);
      else
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
  for(const Kernel::Point_3& p : areas.points())
    for(int k = 0; k < 3; ++k)
      write_binary(out, p[k]);
  for(const Face& face : faces) {
    if(is_small)
      write_binary(out, std::uint8_t(face.corners.size()));
    else
      write_binary(out, std::int32_t(face.corners.size()));
    for(std::uint32_t corner : face.corners)
      write_binary(out, std::int32_t(corner));
    for(std::uint8_t channel : color_of_shape(int(face.shape)))
      write_binary(out, channel);
    write_binary(out, std::int32_t(face.shape));
  }
}

void write_obj(std::ostream& out, const Shape_areas& areas, const Faces& faces)
{
  out << "# detect_planes of Tandem\n";
  write_vertices(out, areas.points(), "v ");
  auto face = faces.begin();
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
    out << "g shape_" << s << '\n';
    for(; face != faces.end() && face->shape == s; ++face)
      write_corners(out << 'f', face->corners, 1) << '\n';
  }
}

void write_off(std::ostream& out, const Shape_areas& areas, const Faces& faces)
{
  out << "OFF\n# detect_planes of Tandem\n" << areas.points().size() << ' ' << faces.size() << " 0\n";
  write_vertices(out, areas.points(), "");
  for(const Face& face : faces) {
    write_corners(out << face.corners.size(), face.corners, 0);
    for(std::uint8_t channel : color_of_shape(int(face.shape)))
      out << ' ' << int(channel);
    out << '\n';
  }
}

// --- GeoJSON, of which no more than a polygon is in memory at once

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
                       bool has_triangles_only)
{
  // Exterior rings are counterclockwise as seen from above, as RFC 7946 wants it. Upright ones are so about the normal of
  // the written plane.
  constexpr double rounding = 1e-9; // of unit normals; it is far less than that
  const bool is_reversed = shapes.coefficients(s)[2] < -rounding;
  const char* before = "\n   ";
  const auto write_polygon = [&](const Polygon::Loop& outer, const std::vector<Polygon::Loop>& holes) {
    Json json = Json::array({json_of_ring(areas, outer, is_reversed)});
    for(const Polygon::Loop& hole : holes)
      json.push_back(json_of_ring(areas, hole, is_reversed));
    out << before << json;
    before = ",\n   ";
  };
  for(const Polygon& polygon : areas.polygons(s))
    if(has_triangles_only)
      for(const auto& triangle : polygon.triangles)
        write_polygon({triangle.begin(), triangle.end()}, {});
    else
      write_polygon(polygon.outer, polygon.holes);
}

// The properties of a shape are its row of the table of shapes, with the plane as one list.
void write_geojson(std::ostream& out, const Described_shapes& described, const Options& o)
{
  const Shape_areas& areas = described.areas();
  const Shapes& shapes = described.shapes;
  begin_geojson(out, o);
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s) {
    Json properties = {{"shape", s}, {"plane", shapes.coefficients(s)}};
    for(const auto& column : described.table().items())
      if(std::string("abcd").find(column.key()) == std::string::npos)
        properties[column.key()] = column.value()[s];
    out << (s == 0 ? "\n" : ",\n") << R"( {"type": "Feature", "id": )" << s << R"(, "properties": )" << properties
        << R"(, "geometry": {"type": "MultiPolygon", "coordinates": [)";
    write_coordinates(out, areas, shapes, s, o.has_triangles_only);
    out << "]}}";
  }
  out << "\n]}\n";
}

// --- Vertex groups

// Colors of points are left out: groups have one.
void write_vg_points(std::ostream& out, const Point_set& points, const Shapes& shapes, std::uint32_t count)
{
  out << "num_points: " << count << '\n';
  const bool are_floats = std::all_of(points.begin(), points.end(), [&](Point_set::Index i) {
    const Kernel::Point_3& p = points.point(i);
    return fits_float(p.x()) && fits_float(p.y()) && fits_float(p.z());
  });
  // The readers take numbers of single precision: digits for that are enough where the input has no more.
  for(Point_set::Index i : points)
    for(int k = 0; k < 3 && is_finite(points.point(i)); ++k)
      if(const double x = points.point(i)[k]; are_floats)
        write_shortest(out, float(x), "  \n"[k]);
      else
        write_shortest(out, x, "  \n"[k]);
  out << "num_colors: 0\nnum_normals: " << count << '\n';
  // Of length 1, to a hundredth of a degree. The null vector, where a point has none.
  const auto rounded = [](double x) { return std::round(1e4 * x) / 1e4 + 0.; }; // no -0
  for(Point_set::Index i : points)
    if(is_finite(points.point(i))) {
      const Kernel::Vector_3 n = normal_used(points, shapes, i);
      const double length = is_usable_normal(n) ? std::sqrt(n.squared_length()) : 0;
      const Kernel::Vector_3 unit = length > 0 ? n / length : Kernel::Vector_3(CGAL::NULL_VECTOR);
      for(int k = 0; k < 3; ++k)
        write_shortest(out, rounded(unit[k]), "  \n"[k]);
    }
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

void write_polygons(std::ostream& out, const Described_shapes& described, const Options& o)
{
  if(is_geojson(o.polygons))
    return write_geojson(out, described, o);
  const Shape_areas& areas = described.areas();
  const std::string extension = lower_case_extension(o.polygons);
  const auto write = extension == ".obj" ? write_obj : extension == ".ply" ? write_ply : write_off;
  write(out, areas, faces_of(areas, described.shapes, o.has_triangles_only));
}

void write_vg(std::ostream& out, const Point_set& points, const Shapes& shapes)
{
  // The position of each point in the file. The readers know no NaN and no infinity, so such points are left out.
  std::uint32_t count = 0;
  std::vector<std::uint32_t> position;
  for(Point_set::Index i : points)
    position.push_back(is_finite(points.point(i)) ? count++ : std::uint32_t(-1));
  write_vg_points(out, points, shapes, count);
  out << "num_groups: " << shapes.number_of_shapes() << '\n';
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    write_vg_group(out, shapes, s, position);
}

} // namespace program
