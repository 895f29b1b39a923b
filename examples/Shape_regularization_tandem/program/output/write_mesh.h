// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface made of the planes of the shapes, by CGAL::Polygonal_surface_reconstruction.

#ifndef DETECT_PLANES_WRITE_MESH_H
#define DETECT_PLANES_WRITE_MESH_H

#include "output/shape_polygons.h"

#include <iosfwd>
#include <optional>
#include <string>

namespace program {

// What is missing in this program; empty if meshes can be made.
std::string missing_for_mesh();

// The format is that of the extension: .off, .obj or .ply. The time and the memory grow with the cube of the number of
// planes, so there is a limit. With a number, the planes with most points are taken.
void write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& path,
                std::optional<long long> number_of_planes);

} // namespace program

#endif // DETECT_PLANES_WRITE_MESH_H
