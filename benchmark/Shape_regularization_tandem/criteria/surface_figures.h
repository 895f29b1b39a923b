// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good the closed surface of shapes is.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SURFACE_FIGURES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SURFACE_FIGURES_H

#include "criteria/outline_figures.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <chrono>
#include <iostream>
#include <set>

namespace CGAL {
namespace Tandem {
namespace benchmark {

using Surface_triangles = CGAL::Surface_mesh<Outline_kernel::Point_3>;

// Of the points of shapes, those that are within maximum_distance of the surface.
inline double share_within(const Outline_cloud& cloud, const Outline_shapes& shapes, const Surface_triangles& mesh)
{
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface_triangles>;
  const CGAL::AABB_tree<CGAL::AABB_traits<Outline_kernel, Primitive>> tree(mesh.faces_begin(), mesh.faces_end(), mesh);
  const double distance = shapes.parameters().maximum_distance;
  std::size_t within = 0, all = 0;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(std::size_t i : shapes.points(s)) {
      within += tree.squared_distance(cloud[i].first) <= distance * distance;
      ++all;
    }
  return double(within) / double(all);
}

inline void print_surface(const Outline_cloud& cloud, const Outline_shapes& shapes)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const auto start = std::chrono::steady_clock::now();
  const auto surface = closed_surface(shapes, cloud, parameters::point_map(Outline_point_map()));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::set<int> planes(surface.plane_of_face.begin(), surface.plane_of_face.end());
  planes.erase(-1);
  std::cout << "surface: " << surface.faces.size() << " faces in " << planes.size() << " of "
            << shapes.number_of_coplanar_groups() << " planes, " << seconds << " s";
  if(!surface.is_empty()) {
    Surface_triangles mesh;
    PMP::polygon_soup_to_polygon_mesh(surface.points, surface.faces, mesh);
    PMP::triangulate_faces(mesh);
    std::cout << ", volume " << PMP::volume(mesh) << ", " << 100 * share_within(cloud, shapes, mesh)
              << " % of the points within maximum_distance" << (CGAL::is_closed(mesh) ? "" : ", not closed")
              << (PMP::does_self_intersect(mesh) ? ", cuts itself" : "");
  }
  std::cout << "\n";
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SURFACE_FIGURES_H
