// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The methods that make a closed surface of planes. It is empty if they enclose nothing; other failures are exceptions.

#ifndef DETECT_PLANES_MESH_METHODS_H
#define DETECT_PLANES_MESH_METHODS_H

#include "Built_with.h"
#include "output/write_results.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// Points on their planes, which are numbered from 0 by their number of points.
struct Mesh_input {
  using Item = CGAL::Tandem::Point_with_plane<Kernel>;
  std::vector<Item> items;
  std::vector<Kernel::Plane_3> planes;
};

// Planes whose points are on a line are left out.
Mesh_input mesh_input(const Point_set& points, const Shapes& shapes);

// Those with most points.
Mesh_input largest_planes(const Mesh_input& all, std::size_t number);

// Its faces are oriented alike.
struct Surface {
  using Face = std::vector<std::size_t>; // positions of the corners in the points
  std::vector<Kernel::Point_3> points;
  std::vector<Face> faces;
  std::size_t number_of_planes = 0;            // that it could be made of: they have an area
  std::optional<std::size_t> number_of_points; // of shapes, whose plane is the surface there; if it is known
};

// Six times that between the faces and the first point; positive if they are counterclockwise, seen from outside.
double signed_volume(const Surface& surface, const std::vector<Surface::Face>& faces);

void reverse(std::vector<Surface::Face>& faces);

// Each edge has as many faces to its left as to its right.
bool is_closed(const Surface& surface);

// Fewer planes may do.
struct Too_many_faces : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// By CGAL::Tandem::closed_surface(), of the planes with most points: they cut space into cells ...
Surface cells_mesh(const Point_set& points, const Shapes& shapes, std::size_t number_of_planes,
                   const Kernel::Vector_3& up);

// ... or CGAL::Kinetic_space_partition_3 does.
Surface kinetic_mesh(const Point_set& points, const Shapes& shapes, std::size_t number_of_planes,
                     const Kernel::Vector_3& up);

// By CGAL::Polygonal_surface_reconstruction. It chooses from all faces that the planes cut each other into: time and
// memory grow with the cube of the number of planes. The solver has `seconds` of processor time.
Surface polygonal_mesh(const Mesh_input& input, int seconds);

} // namespace program

#endif // DETECT_PLANES_MESH_METHODS_H
