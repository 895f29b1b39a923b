// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"
#include "errors.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <chrono>
#include <limits>
#include <set>

namespace program {

namespace {

using Surface = CGAL::Tandem::Closed_surface_3<Kernel>;

// Of as many planes as there is time for: all of them in half of it, a quarter of them in half of the rest, and so on.
Surface make_surface(const Point_set& points, const Shapes& shapes, const Options& o,
                     const CGAL::Tandem::Callback& show)
{
  using Clock = std::chrono::steady_clock;
  const std::array<double, 3> d = o.symmetry_direction.value_or(std::array<double, 3>{0, 0, 1});
  std::chrono::duration<double> left(o.mesh_seconds.value_or(std::numeric_limits<double>::infinity()));
  long long planes = o.mesh_planes.value_or((std::numeric_limits<int>::max)());
  while(planes >= fewest_mesh_planes) {
    const Clock::time_point start = Clock::now();
    bool is_late = false;
    const auto callback = [&](double progress) {
      is_late = 2 * (Clock::now() - start) > left;
      return show(progress) && !is_late;
    };
    Surface surface = CGAL::Tandem::closed_surface(shapes, points,
                                                   CGAL::Tandem::parameters::maximum_number_of_planes(int(planes))
                                                     .maximum_number_of_components(int(o.mesh_components.value_or(0)))
                                                     .symmetry_direction(Kernel::Vector_3(d[0], d[1], d[2]))
                                                     .callback(callback));
    if(!is_late)
      return surface;
    left -= Clock::now() - start;
    planes = (std::min)(planes, (long long)(shapes.statistics().number_of_planes)) / 4;
  }
  throw_error("--mesh: there is no surface within the ", *o.mesh_seconds, " seconds of --mesh-seconds");
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

Mesh_facts write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const Options& o,
                      const CGAL::Tandem::Callback& show)
{
  const Surface surface = make_surface(points, shapes, o, show);
  const std::size_t planes = surface.number_of_planes;
  if(surface.is_empty() && planes < std::size_t(fewest_mesh_planes)) // walls may enclose a volume with fewer
    throw_error("--mesh: a closed surface needs four planes, but there are ", planes);
  if(surface.is_empty())
    throw_error("--mesh: no volume was found that ", planes, " planes enclose");
  write_surface(out, surface, lower_case_extension(o.mesh));
  const std::set<int> with_faces(surface.plane_of_face.begin(), surface.plane_of_face.end());
  return {with_faces.size() - with_faces.count(-1), surface.faces.size(),     planes + surface.number_of_omitted_planes,
          surface.number_of_omitted_planes,         surface.number_of_points, surface.supported};
}

} // namespace program
