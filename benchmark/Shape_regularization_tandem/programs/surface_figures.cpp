// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the closed surface of the planes of a cloud is.
//   surface_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE
// The house of the manual is that of make_scene house house.ply --points N --noise .0004 --normals exact.

#include "clouds/read_ply.h"
#include "testing/measure.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Tandem::benchmark;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cloud = std::vector<std::pair<Kernel::Point_3, Kernel::Vector_3>>;
using Point_map = CGAL::First_of_pair_property_map<Cloud::value_type>;
using Normal_map = CGAL::Second_of_pair_property_map<Cloud::value_type>;
using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;
using Surface = CGAL::Tandem::Closed_surface_3<Kernel>;

void print(const Surface& surface, const Cloud& cloud, const Shapes& shapes, double seconds)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(surface.points, surface.faces, mesh);
  PMP::triangulate_faces(mesh);
  const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(mesh.faces_begin(), mesh.faces_end(), mesh);
  const double unit = shapes.parameters().maximum_distance;
  double all = 0, within = 0, sum = 0;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t i : shapes.points(s)) {
      const double distance = std::sqrt(tree.squared_distance(cloud[i].first)) / unit;
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
  if(argc != 5)
    throw std::invalid_argument("usage: CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE");
  const Ply_cloud input = read_ply(argv[1]);
  const Cloud cloud = points_with_normals<Kernel>(input.points, input.normals);
  const auto map = CGAL::Tandem::parameters::point_map(Point_map());
  const auto np =
    map.maximum_distance(std::stod(argv[2])).maximum_angle(std::stod(argv[3])).minimum_region_size(std::stoul(argv[4]));
  const Shapes shapes = input.has_normals() ? CGAL::Tandem::detect_planes(cloud, np.normal_map(Normal_map()))
                                            : CGAL::Tandem::detect_planes(cloud, np);
  Meter meter;
  const Surface surface = CGAL::Tandem::closed_surface(shapes, cloud, map);
  const double seconds = meter.lap();
  if(surface.is_empty())
    std::cout << "no volume is enclosed\n";
  else
    print(surface, cloud, shapes, seconds);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "surface_figures: " << e.what() << "\n";
  return 1;
}
