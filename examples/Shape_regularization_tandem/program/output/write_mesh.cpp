// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/write_mesh.h"
#include "formats.h"
#include "output/mesh_methods.h"

#include <iomanip>
#include <ostream>
#include <stdexcept>
#include <string>

namespace program {

namespace {

// Of the planes: more take minutes, and those not even Ctrl-C ends soon.
struct Limits {
  std::size_t by_default, on_demand;
};
constexpr Limits polygonal_limits = {16, 60}, kinetic_limits = {100, 1000};
constexpr int longest_seconds = 60;

// The one that takes more planes, if it is there.
std::string method_of(const Options& o)
{
  if(!o.mesh_method.empty())
    return o.mesh_method;
  return missing_for_kinetic_mesh().empty() ? "kinetic" : "polygonal";
}

void check_number_of_planes(const std::string& method, std::size_t number, const Options& o)
{
  if(number < 4)
    throw std::runtime_error("--mesh: a closed surface needs four planes, " + std::to_string(number) + " were found");
  const Limits& limits = method == "kinetic" ? kinetic_limits : polygonal_limits;
  if(number > (o.mesh_planes ? limits.on_demand : limits.by_default))
    throw std::runtime_error("--mesh: the method " + method + " takes too long for " + std::to_string(number) +
                             " planes: take fewer by --mesh-planes or by a larger --minimum-region-size");
}

Surface make_surface(const Point_set& points, const Shapes& shapes, const Options& o)
{
  const std::string method = method_of(o);
  const std::size_t found = shapes.number_of_coplanar_groups();
  const Mesh_input input = mesh_input(points, shapes, o.mesh_planes ? std::size_t(*o.mesh_planes) : found);
  check_number_of_planes(method, input.planes.size(), o);
  Surface surface =
    method == "kinetic" ? kinetic_mesh(input) : polygonal_mesh(input, int(o.mesh_seconds.value_or(longest_seconds)));
  if(surface.faces.empty())
    throw std::runtime_error("--mesh: no volume was found that the planes enclose");
  return surface;
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

void check_mesh_method(const Options& o)
{
  const std::string method = method_of(o);
  const std::string missing = method == "kinetic" ? missing_for_kinetic_mesh() : missing_for_polygonal_mesh();
  if(!missing.empty())
    throw Usage_error((o.mesh_method.empty() ? "--mesh" : "--mesh-method " + method) + " needs " + missing +
                      ": this program was built without it");
  if(o.mesh_seconds && (method == "kinetic" || !has_time_limit()))
    throw Usage_error("--mesh-seconds is for the solver GLPK of --mesh-method polygonal");
}

void write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const Options& o)
{
  const Surface surface = make_surface(points, shapes, o);
  const std::string extension = lower_case_extension(o.mesh);
  out << std::setprecision(17);
  if(extension == ".off")
    write_off(out, surface);
  else if(extension == ".obj")
    write_obj(out, surface);
  else
    write_ply(out, surface);
}

} // namespace program
