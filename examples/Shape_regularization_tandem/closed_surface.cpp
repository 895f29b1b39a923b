// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface of the planes, as a mesh of CGAL.
//   closed_surface [CLOUD [maximum_distance]]

#include "house_cloud.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <cstdio>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
namespace np = CGAL::Tandem::parameters;
namespace PMP = CGAL::Polygon_mesh_processing;

int main(int argc, char* argv[])
{
  const std::vector<Point_with_normal> points = example_cloud(argc, argv);
  const auto shapes = CGAL::Tandem::detect_planes(
    points, np::point_map(Point_map()).normal_map(Normal_map()).maximum_distance(argc > 2 ? std::stod(argv[2]) : .05));
  const auto surface = CGAL::Tandem::closed_surface(shapes, points, np::point_map(Point_map()));
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  PMP::polygon_soup_to_polygon_mesh(surface.points, surface.triangles, mesh);
  std::printf("%zu corners, %zu faces in %zu planes, closed: %d\n", surface.points.size(), surface.faces.size(),
              surface.number_of_planes, int(CGAL::is_closed(mesh)));
  std::printf("volume: %.1f\n", PMP::volume(mesh));
  return surface.is_empty() ? 1 : 0;
}
