// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface made of the planes of the shapes.

#ifndef DETECT_PLANES_WRITE_MESH_H
#define DETECT_PLANES_WRITE_MESH_H

#include "Options.h"
#include "output/write_results.h"

#include <cstddef>
#include <iosfwd>
#include <string>

namespace program {

struct Mesh_facts {
  std::size_t planes = 0, faces = 0; // of the surface
  std::size_t usable_planes = 0;     // those that have an area
  std::size_t points = 0;            // of shapes, whose plane is the surface there
};

// Empty, if --mesh takes all planes that have an area.
std::string warning_of_planes(const Point_set& points, const Shapes& shapes, const Options& o);

// The format is that of the extension of --mesh: .off, .obj or .ply.
Mesh_facts write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const Options& o);

} // namespace program

#endif // DETECT_PLANES_WRITE_MESH_H
