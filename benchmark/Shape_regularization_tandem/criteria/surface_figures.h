// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good a surface made of the planes of shapes is.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SURFACE_FIGURES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SURFACE_FIGURES_H

#include "clouds/outline_cloud.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Surface_figures {
  std::size_t planes = 0; // that have a face
  std::size_t faces = 0, border_edges = 0;
  double share_within = 0;  // of the points of shapes, within maximum_distance of the surface
  double mean_distance = 0; // of these points, in maximum_distance
  double volume = 0;
  bool cuts_itself = false;
};

// The planes that a face is on, up to a millionth of the extent of the points.
template <class Faces>
std::size_t number_of_planes(const std::vector<Outline_kernel::Point_3>& points, const Faces& faces,
                             const std::vector<Outline_kernel::Plane_3>& planes)
{
  const CGAL::Bbox_3 box = CGAL::bbox_3(points.begin(), points.end());
  const double size = (std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
  const double tolerance = 1e-12 * size * size;
  return std::size_t(std::count_if(planes.begin(), planes.end(), [&](const auto& plane) {
    return std::any_of(faces.begin(), faces.end(), [&](const auto& face) {
      return std::all_of(face.begin(), face.end(),
                         [&](std::size_t corner) { return CGAL::squared_distance(points[corner], plane) < tolerance; });
    });
  }));
}

template <class Faces>
Surface_figures surface_figures(const std::vector<Outline_kernel::Point_3>& points, const Faces& faces,
                                const std::vector<Outline_kernel::Plane_3>& planes, const Cloud_with_shapes& input)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  using Mesh = CGAL::Surface_mesh<Outline_kernel::Point_3>;
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  Surface_figures f;
  f.faces = faces.size();
  f.planes = number_of_planes(points, faces, planes);
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
  for(const auto e : mesh.edges())
    f.border_edges += mesh.is_border(e);
  PMP::triangulate_faces(mesh);
  f.volume = f.border_edges == 0 ? PMP::volume(mesh) : 0;
  f.cuts_itself = PMP::does_self_intersect(mesh);
  const CGAL::AABB_tree<CGAL::AABB_traits<Outline_kernel, Primitive>> tree(mesh.faces_begin(), mesh.faces_end(), mesh);
  const double unit = input.shapes.parameters().maximum_distance;
  std::size_t all = 0;
  for(std::size_t s = 0; s < input.shapes.number_of_shapes(); ++s)
    for(std::size_t i : input.shapes.points(s)) {
      const double distance = std::sqrt(tree.squared_distance(input.cloud[i].first)) / unit;
      f.share_within += distance <= 1;
      f.mean_distance += distance;
      ++all;
    }
  f.share_within /= double(all);
  f.mean_distance /= double(all);
  return f;
}

inline void print(const Surface_figures& f)
{
  std::cout << "planes with faces " << f.planes << " faces " << f.faces << " border edges " << f.border_edges
            << " share of points within maximum_distance " << f.share_within << " mean distance " << f.mean_distance
            << " volume " << f.volume << (f.cuts_itself ? " cuts itself" : "");
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SURFACE_FIGURES_H
