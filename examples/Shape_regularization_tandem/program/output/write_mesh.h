// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface made of the planes of the shapes.

#ifndef DETECT_PLANES_WRITE_MESH_H
#define DETECT_PLANES_WRITE_MESH_H

#include "Options.h"
#include "output/shape_polygons.h"

#include <iosfwd>

namespace program {

// Throws if --mesh-method is not there, or does not use --mesh-seconds.
void check_mesh_method(const Options& o);

// The format is that of the extension of --mesh: .off, .obj or .ply.
void write_mesh(std::ostream& out, const Point_set& points, const Shapes& shapes, const Options& o);

} // namespace program

#endif // DETECT_PLANES_WRITE_MESH_H
