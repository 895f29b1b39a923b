// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the methods of --mesh share: the points of the planes, and the surface that comes out.

#ifndef DETECT_PLANES_MESH_INPUT_H
#define DETECT_PLANES_MESH_INPUT_H

#include "outlines/shape_polygons.h"

#include <CGAL/Shape_regularization_tandem/adapters.h>

#include <cstddef>
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
};

// Six times that between the faces and the first point; positive if they are counterclockwise, seen from outside.
double signed_volume(const Surface& surface, const std::vector<Surface::Face>& faces);

void reverse(std::vector<Surface::Face>& faces);

// Each edge has as many faces to its left as to its right.
bool is_closed(const Surface& surface);

} // namespace program

#endif // DETECT_PLANES_MESH_INPUT_H
