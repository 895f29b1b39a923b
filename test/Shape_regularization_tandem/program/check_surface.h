// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed surface of --mesh, where its solver is there.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_SURFACE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_SURFACE_H

#include "testing/checks.h"

#include "output/mesh_methods.h"

#include <map>
#include <stdexcept>

// Each edge has as many faces to its left as to its right, and coordinates are finite.
inline void check_surface(const program::Surface& surface, const std::string& name)
{
  std::map<std::pair<std::size_t, std::size_t>, int> balance;
  for(const auto& face : surface.faces)
    for(std::size_t i = 0; i < face.size(); ++i) {
      const std::size_t a = face[i], b = face[(i + 1) % face.size()];
      balance[{(std::min)(a, b), (std::max)(a, b)}] += a < b ? 1 : -1;
    }
  for(const auto& edge : balance)
    CHECK_AT(edge.second == 0, name + ": an edge that is open");
  for(const auto& p : surface.points)
    CHECK_AT(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()), name + ": a corner of the mesh");
}

// Returns whether there is one. A scene may have none: that is an exception, which says so.
inline bool check_mesh(const program::Point_set& points, const program::Shapes& shapes, const std::string& name)
{
  constexpr std::size_t largest_number_of_planes = 8;
  if(!program::missing_for_polygonal_mesh().empty())
    return false;
  const program::Mesh_input input = program::mesh_input(points, shapes, largest_number_of_planes);
  if(input.planes.size() < 4)
    return false;
  try {
    const program::Surface surface = program::polygonal_mesh(input, 1);
    check_surface(surface, name);
    return !surface.faces.empty();
  } catch(const std::runtime_error&) {
    return false;
  }
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_SURFACE_H
