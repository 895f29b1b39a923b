// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the closed surface of the planes of a cloud is.
//   surface_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE
//   surface_figures house [POINTS [NOISE, a fraction of the diagonal]]

#include "clouds/outline_cloud.h"
#include "testing/measure.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <iostream>
#include <set>

using namespace CGAL::Tandem::benchmark;

namespace {

using Surface = CGAL::Tandem::Closed_surface_3<Outline_kernel>;

void print(const Surface& surface, const Cloud_with_shapes& input, double seconds)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Mesh = CGAL::Surface_mesh<Outline_kernel::Point_3>;
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(surface.points, surface.faces, mesh);
  PMP::triangulate_faces(mesh);
  const CGAL::AABB_tree<CGAL::AABB_traits<Outline_kernel, Primitive>> tree(mesh.faces_begin(), mesh.faces_end(), mesh);
  const double unit = input.shapes.parameters().maximum_distance;
  double all = 0, within = 0, sum = 0;
  for(std::size_t s = 0; s < input.shapes.number_of_shapes(); ++s)
    for(std::size_t i : input.shapes.points(s)) {
      const double distance = std::sqrt(tree.squared_distance(input.cloud[i].first)) / unit;
      within += distance <= 1;
      sum += distance;
      ++all;
    }
  std::set<int> used(surface.plane_of_face.begin(), surface.plane_of_face.end());
  used.erase(-1);
  std::cout << "planes " << surface.number_of_planes << " used " << used.size() << " faces " << surface.faces.size()
            << " share of points within maximum_distance " << within / all << " mean distance " << sum / all
            << " volume " << PMP::volume(mesh) << " seconds " << seconds << "\n";
}

} // namespace

int main(int argc, char** argv)
try {
  const Cloud_with_shapes input = cloud_with_shapes(std::vector<std::string>(argv + 1, argv + argc));
  Meter meter;
  const Surface surface =
    CGAL::Tandem::closed_surface(input.shapes, input.cloud, CGAL::Tandem::parameters::point_map(Outline_point_map()));
  const double seconds = meter.lap();
  if(surface.is_empty())
    std::cout << "no volume is enclosed\n";
  else
    print(surface, input, seconds);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "surface_figures: " << e.what() << "\n";
  return 1;
}
