// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/write_mesh.h"
#include "formats.h"
#include "mesh/mesh_methods.h"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <stdexcept>
#include <string>

namespace program {

namespace {

constexpr std::size_t fewest_planes = 4;
constexpr int longest_seconds = 60;

struct Method {
  const char* name;
  std::size_t by_default, on_demand; // planes; more take minutes, and those not even Ctrl-C ends soon
};
constexpr Method kinetic = {"kinetic", 100, 1000}, polygonal = {"polygonal", 16, 60};

// The one that takes more planes, if it is there.
const Method& method_of(const Options& o)
{
  const bool is_kinetic = o.mesh_method.empty() ? missing_for_kinetic_mesh().empty() : o.mesh_method == kinetic.name;
  return is_kinetic ? kinetic : polygonal;
}

std::string missing_for(const Method& method)
{
  return &method == &kinetic ? missing_for_kinetic_mesh() : missing_for_polygonal_mesh();
}

std::string limits_of(const Method& method)
{
  return std::string("the method ") + method.name + " takes " + std::to_string(method.by_default) +
         " by default, and up to " + std::to_string(method.on_demand) + " by --mesh-planes";
}

struct Made_surface {
  Surface surface;
  std::size_t planes = 0;
  std::string warning;
};

std::string number_of(std::size_t planes, std::size_t all)
{
  return std::to_string(planes) + (planes < all ? " of " + std::to_string(all) : "") + " planes";
}

// Of as many planes as the method takes.
Made_surface make_surface(const Mesh_input& all, const Options& o)
{
  const Method& method = method_of(o);
  const int seconds = int(o.mesh_seconds.value_or(longest_seconds));
  Made_surface made;
  made.planes = (std::min)(all.planes.size(), o.mesh_planes ? std::size_t(*o.mesh_planes) : method.by_default);
  while(true) {
    const Mesh_input input = largest_planes(all, made.planes);
    try {
      made.surface = &method == &kinetic ? kinetic_mesh(input) : polygonal_mesh(input, seconds);
      return made;
    } catch(const Too_many_faces& e) {
      if(made.planes == fewest_planes)
        throw;
      made.warning = e.what();
      made.planes = (std::max)(made.planes * 3 / 4, fewest_planes);
    }
  }
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
  const Method& method = method_of(o);
  const std::string missing = missing_for(method);
  if(!missing.empty())
    throw Usage_error((o.mesh_method.empty() ? "--mesh" : "--mesh-method " + o.mesh_method) + " needs " + missing +
                      ": this program was built without it");
  if(o.mesh_seconds && (&method == &kinetic || !has_time_limit()))
    throw Usage_error("--mesh-seconds is for the solver GLPK of --mesh-method polygonal");
  const long long fewest = fewest_planes, most = (long long)(method.on_demand);
  if(o.mesh_planes && (*o.mesh_planes < fewest || *o.mesh_planes > most))
    throw Usage_error("--mesh-planes is " + std::to_string(*o.mesh_planes) + ", must be in [" + std::to_string(fewest) +
                      ", " + std::to_string(most) + "] for the method " + method.name);
}

std::string limits_of_planes()
{
  std::string text;
  for(const Method* method : {&kinetic, &polygonal})
    if(missing_for(*method).empty())
      text += (text.empty() ? "" : "; ") + limits_of(*method);
  return text;
}

// What fails here fails again when the mesh is made, after the other files.
std::string warning_of_planes(const Point_set& points, const Shapes& shapes, const Options& o)
try {
  const Method& method = method_of(o);
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
  const Mesh_input input = mesh_input(points, shapes);
  const std::size_t usable = input.planes.size();
  if(usable < fewest_planes)
    throw std::runtime_error("--mesh: a closed surface needs four planes, " + std::to_string(usable) + " were found");
  const Made_surface made = make_surface(input, o);
  const Surface& surface = made.surface;
  if(surface.faces.empty())
    throw std::runtime_error("--mesh: no volume was found that " + number_of(made.planes, usable) + " enclose" +
                             (made.planes < usable ? " (" + limits_of(method_of(o)) + ")" : ""));
  const std::string extension = lower_case_extension(o.mesh);
  out << std::setprecision(17);
  if(extension == ".off")
    write_off(out, surface);
  else if(extension == ".obj")
    write_obj(out, surface);
  else
    write_ply(out, surface);
  Mesh_facts facts{made.planes, surface.faces.size(), usable, {}};
  if(!made.warning.empty())
    facts.warning = o.mesh + ": has " + number_of(made.planes, usable) + ", those with most points: " + made.warning;
  return facts;
}

} // namespace program
