// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"
#include "errors.h"
#include "mesh/Mesh.h"

#include <CGAL/Shape_regularization_tandem/select_shapes.h>

#include <boost/pending/disjoint_sets.hpp>

#include <chrono>
#include <limits>
#include <map>
#include <set>

namespace program {

namespace {

using Surface = CGAL::Tandem::Closed_surface_3<Kernel>;

// Of length 1.
Kernel::Vector_3 upward(const Options& o)
{
  const std::array<double, 3>& up = *o.up;
  return Kernel::Vector_3(up[0], up[1], up[2]) / std::hypot(up[0], up[1], up[2]);
}

constexpr std::uint8_t ground_class = 2; // of LAS

using Classes = std::optional<Point_set::Property_map<std::uint8_t>>;

// Those of which most points are not classified as ground.
std::vector<std::size_t> shapes_on_ground(const Point_set& points, const Shapes& shapes)
{
  const Classes classes = find_property<std::uint8_t>(points, classification_name);
  std::vector<std::size_t> result;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    std::size_t of_ground = 0;
    for(std::size_t k = 0; classes && k < shapes.size(s); ++k)
      of_ground += (*classes)[*(points.begin() + shapes.points(s)[k])] == ground_class;
    if(2 * of_ground <= shapes.size(s))
      result.push_back(s);
  }
  return result;
}

// The height of the lowest point of class 2, or, if there is none, of a shape.
double ground(const Point_set& points, const Shapes& shapes, const Kernel::Vector_3& up)
{
  const Classes classes = find_property<std::uint8_t>(points, classification_name);
  double of_class = std::numeric_limits<double>::infinity(), of_shapes = of_class;
  for(Point_set::Index i : points) {
    const double height = (points.point(i) - CGAL::ORIGIN) * up;
    if(classes && (*classes)[i] == ground_class)
      of_class = (std::min)(of_class, height);
    if(shapes.shape_index(i) >= 0)
      of_shapes = (std::min)(of_shapes, height);
  }
  return std::isfinite(of_class) ? of_class : of_shapes;
}

// Of as many planes as there is time for after the outlines: all of them in half of it, a quarter of them in half of the
// rest, and so on.
Surface make_surface(const Described_shapes& described, const std::optional<double>& base, const Options& o,
                     const CGAL::Tandem::Callback& show)
{
  using Clock = std::chrono::steady_clock;
  Clock::time_point start = Clock::now();
  const Shape_areas& areas = described.areas();
  const Shapes& shapes = described.shapes;
  std::chrono::duration<double> left(o.mesh_seconds.value_or(std::numeric_limits<double>::infinity()));
  left -= Clock::now() - start;
  long long planes = o.mesh_planes.value_or((std::numeric_limits<int>::max)());
  while(planes >= fewest_mesh_planes && left.count() > 0) {
    start = Clock::now();
    bool is_late = false;
    const auto callback = [&](double progress) {
      is_late = 2 * (Clock::now() - start) > left;
      return show(progress) && !is_late;
    };
    const auto all = CGAL::Tandem::parameters::maximum_number_of_planes(int(planes))
                       .maximum_number_of_components(int(o.mesh_components.value_or(0)))
                       .symmetry_direction(upward(o))
                       .footprints(o.footprints)
                       .callback(callback);
    Surface surface = base ? closed_surface(shapes, described.points, areas, all.base_height(*base))
                           : closed_surface(shapes, described.points, areas, all);
    if(!is_late)
      return surface;
    left -= Clock::now() - start;
    planes = (std::min)(planes, (long long)(shapes.statistics().number_of_planes)) / 4;
  }
  throw_error("--mesh: there is no surface within ", *o.mesh_seconds,
              " seconds; pass a larger number to --mesh-seconds");
}

void write_surface(std::ostream& out, const Surface& surface, const std::string& extension)
{
  const std::size_t points = surface.points.size(), faces = surface.faces.size();
  const bool is_obj = extension == ".obj";
  if(is_obj)
    out << "# detect_planes of Tandem\n";
  else if(extension == ".off")
    out << "OFF\n" << points << ' ' << faces << " 0\n";
  else
    out << "ply\nformat ascii 1.0\ncomment detect_planes of Tandem\nelement vertex " << points
        << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << faces
        << "\nproperty list int int vertex_indices\nproperty double supported\nend_header\n";
  write_vertices(out, surface.points, is_obj ? "v " : "");
  for(std::size_t f = 0; f < faces; ++f) {
    const auto& face = surface.faces[f];
    write_corners(out << (is_obj ? "f" : std::to_string(face.size())), face, is_obj ? 1 : 0);
    if(extension == ".ply")
      out << ' ' << surface.supported_of_face[f];
    out << '\n';
  }
}

// --- CityJSON 2.0: a building for each component of the surface.

// Twice the area, outward.
Kernel::Vector_3 area_vector(const Surface& surface, std::size_t face)
{
  const auto& corners = surface.faces[face];
  const auto from_first = [&](std::size_t i) { return surface.points[corners[i]] - surface.points[corners[0]]; };
  Kernel::Vector_3 sum = CGAL::NULL_VECTOR;
  for(std::size_t i = 2; i < corners.size(); ++i)
    sum = sum + CGAL::cross_product(from_first(i - 1), from_first(i));
  return sum;
}

// Faces that have corners in common.
struct Component {
  std::vector<std::size_t> faces;
  double volume = 0; // times six: negative for a cavity
  Box box;
};

// In the order of their first faces.
std::vector<Component> components_of(const Surface& surface)
{
  boost::disjoint_sets_with_storage<> sets(surface.points.size());
  for(const auto& face : surface.faces)
    for(std::size_t corner : face)
      sets.union_set(face[0], corner);
  std::map<std::size_t, std::size_t> number_of;
  std::vector<Component> result;
  for(std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto& corners = surface.faces[f];
    const std::size_t number = number_of.emplace(sets.find_set(corners[0]), number_of.size()).first->second;
    result.resize(number_of.size());
    Component& component = result[number];
    component.faces.push_back(f);
    component.volume += (surface.points[corners[0]] - surface.points[0]) * area_vector(surface, f);
    for(std::size_t corner : corners)
      component.box += surface.points[corner].bbox();
  }
  return result;
}

bool contains(const Box& outer, const Box& inner) { return outer + inner == outer; }

// The component whose cavity it is: the smallest one around it.
const Component* around(const Component& cavity, const std::vector<Component>& all)
{
  const Component* result = nullptr;
  for(const Component& c : all)
    if(c.volume > 0 && contains(c.box, cavity.box) && (result == nullptr || c.volume < result->volume))
      result = &c;
  return result;
}

// Faces within 10 degrees of upright are walls.
const char* semantics_of(const Kernel::Vector_3& area, const Kernel::Vector_3& up)
{
  const double sine = std::sin(10 * CGAL_PI / 180);
  const double height = area * up / std::sqrt(area.squared_length());
  return std::fabs(height) <= sine ? "WallSurface" : height > 0 ? "RoofSurface" : "GroundSurface";
}

// Cavities are further shells, whose faces have no meaning.
Json building_of(const Surface& surface, const Component& component, const std::vector<Component>& all,
                 const Kernel::Vector_3& up)
{
  Json shells = Json::array(), surfaces = Json::array(), values = Json::array();
  const auto add_shell = [&](const Component& part, bool is_exterior) {
    Json shell = Json::array(), value = Json::array();
    for(std::size_t f : part.faces) {
      shell.push_back(Json::array({surface.faces[f]}));
      value.push_back(is_exterior ? Json(surfaces.size()) : Json());
      if(is_exterior)
        surfaces.push_back(
          {{"type", semantics_of(area_vector(surface, f), up)}, {"supported", surface.supported_of_face[f]}});
    }
    shells.push_back(shell);
    values.push_back(value);
  };
  add_shell(component, true);
  for(const Component& cavity : all)
    if(cavity.volume < 0 && around(cavity, all) == &component)
      add_shell(cavity, false);
  const Json solid = {{"type", "Solid"},
                      {"lod", "2.2"},
                      {"boundaries", shells},
                      {"semantics", {{"surfaces", surfaces}, {"values", values}}}};
  return {{"type", "Building"}, {"geometry", Json::array({solid})}};
}

// Corners are multiples of a power of ten, between 1e-9 and 1e-8 of the extent, from the smallest coordinates on: no
// edge of the surface is as short as that.
void write_city_json(std::ostream& out, const Surface& surface, const Options& o)
{
  Box box;
  for(const Kernel::Point_3& p : surface.points)
    box += p.bbox();
  const double extent = (std::max)({box.x_span(), box.y_span(), box.z_span()});
  const double scale = std::stod("1e" + std::to_string(int(std::ceil(std::log10(extent))) - 9));
  const std::array<double, 3> origin = {box.xmin(), box.ymin(), box.zmin()};
  Json vertices = Json::array();
  for(const Kernel::Point_3& p : surface.points) {
    vertices.emplace_back();
    for(int k = 0; k < 3; ++k)
      vertices.back().push_back(std::llround((p[k] - origin[std::size_t(k)]) / scale));
  }
  Json buildings = Json::object();
  const std::vector<Component> components = components_of(surface);
  for(const Component& component : components)
    if(component.volume > 0)
      buildings["building_" + std::to_string(buildings.size())] =
        building_of(surface, component, components, upward(o));
  Json json = {{"type", "CityJSON"}, {"version", "2.0"}};
  if(!o.crs.empty())
    json["metadata"] = {{"referenceSystem", url_of_crs(o.crs)}};
  json["transform"] = {{"scale", {scale, scale, scale}}, {"translate", origin}};
  json["CityObjects"] = buildings;
  json["vertices"] = vertices;
  write_json(out, json);
  out << '\n';
}

// Why there is none.
[[noreturn]] void fail(std::size_t planes, const std::optional<double>& base, const Options& o)
{
  if(!o.footprints.empty())
    throw_error(
      "--mesh: no footprint has a volume: are its coordinates those of the cloud, and is the base below its roofs?");
  if(base)
    throw_error("--mesh: no volume was found that ", planes, " planes enclose with the ground at ", *base,
                ": is --base below the roofs?");
  if(planes < std::size_t(fewest_mesh_planes)) // walls may enclose a volume with fewer
    throw_error("--mesh: a closed surface needs four planes, but there are ", planes, "; --base HEIGHT closes roofs");
  throw_error("--mesh: no volume was found that ", planes, " planes enclose; --base HEIGHT closes roofs");
}

// Why the mesh lacks planes.
const char* limit_of_planes(const Options& o)
{
  return o.mesh_seconds  ? "--mesh-seconds"
         : o.mesh_planes ? "--mesh-planes"
                         : "they would cut space into too many cells";
}

} // namespace

std::shared_ptr<const Mesh> make_mesh(const Described_shapes& all, const Options& o, const CGAL::Tandem::Callback& show)
{
  const Point_set& points = all.points;
  Mesh mesh;
  mesh.base = o.is_base_ground ? ground(points, all.shapes, upward(o)) : o.base_height;
  std::vector<std::size_t> kept;
  if(mesh.base || !o.footprints.empty())
    kept = shapes_on_ground(points, all.shapes);
  const bool is_part = !kept.empty() && kept.size() < all.shapes.number_of_shapes();
  const Shapes& shapes = is_part ? select_shapes(all.shapes, kept) : all.shapes;
  mesh.surface = make_surface(is_part ? Described_shapes(points, shapes, *o.up) : all, mesh.base, o, show);
  const Surface& surface = mesh.surface;
  if(surface.is_empty())
    fail(surface.number_of_planes, mesh.base, o);
  std::vector<int> shape_of_plane(shapes.statistics().number_of_planes);
  for(std::size_t s = shapes.number_of_shapes(); s-- > 0;)
    shape_of_plane[shapes.coplanar_group(s)] = int(is_part ? kept[s] : s);
  for(int plane : surface.plane_of_face)
    mesh.shape_of_face.push_back(plane < 0 ? -1 : shape_of_plane[std::size_t(plane)]);
  return std::make_shared<Mesh>(std::move(mesh));
}

std::string text_of_mesh(const Mesh& mesh, const Shapes& shapes, const Options& o)
{
  const Surface& surface = mesh.surface;
  const std::size_t points = (std::max)(shapes.statistics().number_of_assigned_points, std::size_t(1));
  const std::size_t omitted = surface.number_of_omitted_planes;
  const std::set<int> with_faces(surface.plane_of_face.begin(), surface.plane_of_face.end());
  const bool is_part = 3 * surface.number_of_points < 2 * points && o.footprints.empty() && !o.mesh_components;
  return text_of(surface.faces.size(), " faces, of ", with_faces.size() - with_faces.count(-1), " of ",
                 surface.number_of_planes + omitted, " planes",
                 omitted > 0 ? text_of(" (without ", omitted, " with fewer points: ", limit_of_planes(o), ")") : "",
                 ", with ", 100 * surface.number_of_points / points, " % of the points of shapes",
                 is_part
                   ? text_of(" (the others enclose no volume: ", mesh.base ? "" : "--base HEIGHT closes roofs; or ",
                             "scan the missing sides, or --crop a part)")
                   : "",
                 mesh.base ? text_of("; on the ground at ", *mesh.base) : "", "; ",
                 std::lround(100 * surface.supported), " % of its area has points");
}

void write_mesh(std::ostream& out, const Mesh& mesh, const Options& o)
{
  if(ends_in(o.mesh, city_json))
    write_city_json(out, mesh.surface, o);
  else
    write_surface(out, mesh.surface, lower_case_extension(o.mesh));
}

} // namespace program
