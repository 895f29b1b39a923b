// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of closed_surface() share, whatever cuts space into cells.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_CLOSED_SURFACE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_CLOSED_SURFACE_H

#include "box_cloud.h"
#include "property_case.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <string>
#include <vector>

namespace np = CGAL::Tandem::parameters;
using Surface = CGAL::Tandem::Closed_surface_3<Epick>;
using Found_shapes = CGAL::Tandem::Planar_shapes_3<Epick>;

// The volume, of a surface that is closed, oriented outward, a two-manifold, and does not cut itself.
inline double checked_volume(const Surface& surface, const std::string& name)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  CHECK_AT(surface.plane_of_face.size() == surface.faces.size(), name);
  CHECK_AT(PMP::is_polygon_soup_a_polygon_mesh(surface.faces), name + ": no two-manifold");
  CGAL::Surface_mesh<Epick::Point_3> mesh;
  std::vector<Epick::Point_3> points; // about the origin, as volumes are summed from there
  for(const Epick::Point_3& p : surface.points)
    points.push_back(CGAL::ORIGIN + (p - surface.points.front()));
  PMP::polygon_soup_to_polygon_mesh(points, surface.faces, mesh);
  CHECK_AT(CGAL::is_closed(mesh), name + ": not closed");
  CHECK_AT(PMP::triangulate_faces(mesh), name + ": a face that has no triangles");
  CHECK_AT(!PMP::does_self_intersect(mesh), name + ": cuts itself");
  for(const auto& face : surface.faces)
    for(std::size_t i = 0; i < face.size(); ++i)
      CHECK_AT(surface.points[face[i]] != surface.points[face[(i + 1) % face.size()]], name + ": an edge of no length");
  const double volume = surface.is_empty() ? 0 : PMP::volume(mesh);
  CHECK_AT(volume > 0 || surface.is_empty(), name + ": the volume is " + std::to_string(volume));
  return volume;
}

// The list has the map to points.
template <class Kernel, class Named_parameters>
CGAL::Tandem::Closed_surface_3<Kernel> surface_of_box(double scale, const Named_parameters& list)
{
  Pairs<Kernel> cloud = make_pairs<Kernel>(make_box_cloud(400));
  for(auto& item : cloud)
    item.first = item.first.transform(CGAL::Aff_transformation_3<Kernel>(CGAL::SCALING, typename Kernel::FT(scale)));
  const auto shapes = CGAL::Tandem::detect_planes(
    cloud,
    np::maximum_distance(.02 * scale).minimum_region_size(50).point_map(First<Kernel>()).normal_map(Second<Kernel>()));
  return CGAL::Tandem::closed_surface(shapes, cloud, list);
}

// Whatever the points are, it ends and is closed.
template <class Named_parameters>
void check_random_scenes(unsigned count, const Named_parameters& list)
{
  int enclosed = 0;
  for(unsigned seed = 1; seed <= count; ++seed) {
    const Property_case c = Case_maker(seed).make();
    std::vector<Epick::Point_3> points;
    for(std::size_t i = 0; i < c.cloud.size() && i < 20000; ++i)
      points.emplace_back(c.cloud[i].first.x(), c.cloud[i].first.y(), c.cloud[i].first.z());
    Found_shapes shapes;
    try {
      shapes = CGAL::Tandem::detect_planes(points, np::settings(c.parameters));
    } catch(const std::exception&) {
      continue;
    }
    const Surface surface = CGAL::Tandem::closed_surface(shapes, points, list);
    enclosed += checked_volume(surface, c.name) > 0;
    for(const Epick::Point_3& p : surface.points)
      CHECK_AT(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()), c.name);
  }
  CHECK_AT(enclosed > 0, "random scenes enclose nothing");
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_CLOSED_SURFACE_H
