// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"
#include "errors.h"

#include "../Shape_regularization_tandem/convex_polygons.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <set>

namespace program {

namespace {

using Surface = CGAL::Tandem::Closed_surface_3<Kernel>;

std::string limits()
{
  return "--mesh takes " + std::to_string(mesh_planes_by_default) + " by default, and up to " +
         std::to_string(most_mesh_planes) + " by --mesh-planes";
}

std::string number_of(std::size_t planes, std::size_t all)
{
  return std::to_string(planes) + (planes < all ? " of " + std::to_string(all) : "") + " planes";
}

// Those that have an area: the points of others are on a line.
std::size_t number_of_usable_planes(const Point_set& points, const Shapes& shapes)
{
  return convex_polygons<Kernel>(CGAL::Tandem::projected_points(points, shapes), CGAL::Tandem::distinct_planes(shapes))
    .planes.size();
}

// Of at most so many planes.
Surface make_surface(const Point_set& points, const Shapes& shapes, std::size_t planes, const Options& o)
{
  const std::array<double, 3>& up = *o.up;
  Surface surface = CGAL::Tandem::closed_surface(shapes, points,
                                                 CGAL::Tandem::parameters::maximum_number_of_planes(int(planes))
                                                   .maximum_number_of_components(int(o.mesh_components.value_or(0)))
                                                   .symmetry_direction(Kernel::Vector_3(up[0], up[1], up[2])));
  check_signals();
  if(surface.is_empty() &&
     surface.number_of_planes < std::size_t(fewest_mesh_planes)) // walls may enclose a volume with fewer
    throw_error("--mesh: a closed surface needs four planes, but there are ", surface.number_of_planes);
  return surface;
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

} // namespace

// What fails here fails again when the mesh is made, after the other files.
std::string warning_of_planes(const Point_set& points, const Shapes& shapes, const Options& o)
try {
  constexpr std::size_t most = mesh_planes_by_default;
  if(o.mesh.empty() || o.mesh_planes || shapes.statistics().number_of_planes <= most)
    return {};
  const std::size_t usable = number_of_usable_planes(points, shapes);
  if(usable <= most)
    return {};
  return o.mesh + ": has " + number_of(most, usable) + ", those with most points: " + limits();
} catch(const std::exception&) {
  return {};
}

Mesh_facts write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const Options& o)
{
  const std::size_t most = std::size_t(o.mesh_planes.value_or(mesh_planes_by_default));
  const Surface surface = make_surface(points, shapes, most, o);
  std::size_t usable = surface.number_of_planes;
  if(usable == most && shapes.statistics().number_of_planes > most)
    usable = (std::max)(most, number_of_usable_planes(points, shapes));
  if(surface.is_empty())
    throw_error("--mesh: no volume was found that ", number_of(surface.number_of_planes, usable), " enclose",
                (surface.number_of_planes < usable ? " (" + limits() + ")" : ""));
  write_surface(out, surface, lower_case_extension(o.mesh));
  const std::set<int> with_faces(surface.plane_of_face.begin(), surface.plane_of_face.end());
  return {with_faces.size() - with_faces.count(-1), surface.faces.size(), usable, surface.number_of_points,
          surface.supported};
}

} // namespace program
