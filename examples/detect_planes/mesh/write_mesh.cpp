// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/write_mesh.h"
#include "Built_with.h"
#include "file_names.h"
#include "mesh/mesh_methods.h"
#include "signals.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <ostream>
#include <stdexcept>
#include <string>

namespace program {

namespace {

constexpr std::size_t fewest_planes = 4;
constexpr int longest_seconds = 60;

const Mesh_method& method_of(const Options& o)
{
  if(o.mesh_method.empty() || o.mesh_method == cells_method.name)
    return cells_method;
  return o.mesh_method == kinetic_method.name ? kinetic_method : polygonal_method;
}

std::string number_of(std::size_t planes, std::size_t all)
{
  return std::to_string(planes) + (planes < all ? " of " + std::to_string(all) : "") + " planes";
}

void check_number_of_planes(std::size_t planes)
{
  if(planes < fewest_planes)
    throw std::runtime_error("--mesh: a closed surface needs four planes, and there are " + std::to_string(planes));
}

struct Made_surface {
  Surface surface;
  std::size_t usable_planes = 0; // those that have an area
  std::string warning;           // if it has fewer planes than it was to have
};

// Of at most so many planes. With too many faces for the solver, it is of fewer.
Made_surface make_polygonal(const Mesh_input& all, std::size_t planes, int seconds)
{
  check_number_of_planes(all.planes.size());
  Made_surface made = {{}, all.planes.size(), {}};
  while(true)
    try {
      if constexpr(has_polygonal_mesh)
        made.surface = polygonal_mesh(largest_planes(all, planes), seconds);
      return made;
    } catch(const Too_many_faces& e) {
      planes = (std::min)(planes, all.planes.size());
      if(planes == fewest_planes)
        throw;
      made.warning = e.what();
      planes = (std::max)(planes * 3 / 4, fewest_planes);
    }
}

// Of as many planes as the method takes.
Made_surface make_surface(const Point_set& points, const Shapes& shapes, const Options& o)
{
  const Mesh_method& method = method_of(o);
  const std::size_t planes = o.mesh_planes ? std::size_t(*o.mesh_planes) : method.by_default;
  const std::array<double, 3> d = o.symmetry_direction.value_or(std::array<double, 3>{0, 0, 1});
  const Kernel::Vector_3 up(d[0], d[1], d[2]);
  Made_surface made;
  if(&method == &polygonal_method)
    return make_polygonal(mesh_input(points, shapes), planes, int(o.mesh_seconds.value_or(longest_seconds)));
  if constexpr(has_kinetic_mesh)
    if(&method == &kinetic_method)
      made.surface = kinetic_mesh(points, shapes, planes, up);
  if(&method == &cells_method)
    made.surface = cells_mesh(points, shapes, planes, up);
  if(is_interrupted())
    throw Interrupted();
  made.usable_planes = made.surface.number_of_planes;
  if(made.surface.faces.empty()) // otherwise walls without points are among them
    check_number_of_planes(made.usable_planes);
  if(made.usable_planes == planes && shapes.statistics().number_of_planes > planes)
    made.usable_planes = (std::max)(planes, mesh_input(points, shapes).planes.size());
  return made;
}

// Points and faces, as .off and .ply have them.
void write_rows(std::ostream& out, const Surface& surface)
{
  for(const Kernel::Point_3& p : surface.points)
    out << p << '\n';
  for(const auto& face : surface.faces) {
    out << face.size();
    for(std::size_t corner : face)
      out << ' ' << corner;
    out << '\n';
  }
}

void write_off(std::ostream& out, const Surface& surface)
{
  out << "OFF\n" << surface.points.size() << ' ' << surface.faces.size() << " 0\n";
  write_rows(out, surface);
}

void write_obj(std::ostream& out, const Surface& surface)
{
  out << "# detect_planes of Tandem\n";
  for(const Kernel::Point_3& p : surface.points)
    out << "v " << p << '\n';
  for(const auto& face : surface.faces) {
    out << 'f';
    for(std::size_t corner : face)
      out << ' ' << corner + 1;
    out << '\n';
  }
}

void write_ply(std::ostream& out, const Surface& surface)
{
  out << "ply\nformat ascii 1.0\ncomment detect_planes of Tandem\nelement vertex " << surface.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << surface.faces.size()
      << "\nproperty list int int vertex_indices\nend_header\n";
  write_rows(out, surface);
}

} // namespace

void check_mesh_options(const Options& o)
{
  const Mesh_method& method = method_of(o);
  if(!method.is_built)
    throw Usage_error("--mesh-method " + o.mesh_method + " needs " + method.needs +
                      ": this program was built without it");
  if(o.mesh_seconds && (&method != &polygonal_method || !has_time_limit))
    throw Usage_error("--mesh-seconds is for the solver GLPK of --mesh-method polygonal");
  const long long fewest = fewest_planes, most = (long long)(method.on_demand);
  if(o.mesh_planes && (*o.mesh_planes < fewest || *o.mesh_planes > most))
    throw Usage_error("--mesh-planes is " + std::to_string(*o.mesh_planes) + ", must be in [" + std::to_string(fewest) +
                      ", " + std::to_string(most) + "] for the method " + method.name);
}

// What fails here fails again when the mesh is made, after the other files.
std::string warning_of_planes(const Point_set& points, const Shapes& shapes, const Options& o)
try {
  const Mesh_method& method = method_of(o);
  if(o.mesh.empty() || o.mesh_planes || shapes.statistics().number_of_planes <= method.by_default)
    return {};
  const std::size_t usable = mesh_input(points, shapes).planes.size();
  if(usable <= method.by_default)
    return {};
  return o.mesh + ": has " + number_of(method.by_default, usable) + ", those with most points: " + limits_of(method);
} catch(const std::exception&) {
  return {};
}

Mesh_facts write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const Options& o)
{
  const Made_surface made = make_surface(points, shapes, o);
  const Surface& surface = made.surface;
  const std::string planes = number_of(surface.number_of_planes, made.usable_planes);
  if(surface.faces.empty())
    throw std::runtime_error(
      "--mesh: no volume was found that " + planes + " enclose" +
      (surface.number_of_planes < made.usable_planes ? " (" + limits_of(method_of(o)) + ")" : ""));
  const std::string extension = lower_case_extension(o.mesh);
  out << std::setprecision(17);
  if(extension == ".off")
    write_off(out, surface);
  else if(extension == ".obj")
    write_obj(out, surface);
  else
    write_ply(out, surface);
  Mesh_facts facts{surface.number_of_planes, surface.faces.size(), made.usable_planes, surface.number_of_points, {}};
  if(!made.warning.empty())
    facts.warning = o.mesh + ": has " + planes + ", those with most points: " + made.warning;
  return facts;
}

} // namespace program
