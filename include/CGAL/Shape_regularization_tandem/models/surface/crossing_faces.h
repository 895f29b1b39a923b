// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles of a surface, and whether it crosses itself, as its coordinates are written: decided by exact predicates.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CROSSING_FACES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CROSSING_FACES_H

#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

using Surface_mesh = CGAL::Surface_mesh<Point>;

// Knows of which face a triangle is.
class Keep_face : public CGAL::Polygon_mesh_processing::Triangulate_faces::Default_visitor<Surface_mesh> {
public:
  using Face_index = Surface_mesh::Face_index;
  using Number = Surface_mesh::Property_map<Face_index, std::size_t>;

  explicit Keep_face(const Number& number) : number_(number) {}
  void before_subface_creations(Face_index f) { of_face_ = number_[f]; }
  void after_subface_created(Face_index triangle) { number_[triangle] = of_face_; }

private:
  Number number_;
  std::size_t of_face_ = 0;
};

// The triangles of all faces, face by face, and pairs of faces that have more than their corners and edges in common; a
// face twice that has no triangulation.
struct Checked_triangles {
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::size_t> face_of_triangle;
  std::vector<std::pair<std::size_t, std::size_t>> crossing_faces;
};

// Of a closed two-manifold.
inline Checked_triangles checked_triangles(const std::vector<Point>& points,
                                           const std::vector<std::vector<std::size_t>>& faces)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  Surface_mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
  Keep_face::Number number = mesh.add_property_map<Keep_face::Face_index, std::size_t>("f:number", 0).first;
  for(const auto f : mesh.faces())
    number[f] = std::size_t(f);
  PMP::triangulate_faces(mesh, CGAL::parameters::visitor(Keep_face(number)));
  std::vector<Keep_face::Face_index> by_face(mesh.faces().begin(), mesh.faces().end());
  std::stable_sort(by_face.begin(), by_face.end(), [&](auto f, auto g) { return number[f] < number[g]; });
  Checked_triangles result;
  for(const auto f : by_face) {
    if(mesh.degree(f) != 3 || PMP::is_degenerate_triangle_face(f, mesh))
      result.crossing_faces.emplace_back(number[f], number[f]);
    const auto h = mesh.halfedge(f);
    result.triangles.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
    result.face_of_triangle.push_back(number[f]);
  }
  if(!result.crossing_faces.empty())
    return result;
  std::vector<std::pair<Keep_face::Face_index, Keep_face::Face_index>> crossing;
  PMP::self_intersections(mesh, std::back_inserter(crossing));
  for(const auto& [f, g] : crossing)
    result.crossing_faces.emplace_back((std::min)(number[f], number[g]), (std::max)(number[f], number[g]));
  std::sort(result.crossing_faces.begin(), result.crossing_faces.end());
  return result;
}

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_CROSSING_FACES_H
