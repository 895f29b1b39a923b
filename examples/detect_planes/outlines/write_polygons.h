// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polygons of the shapes as a file: binary PLY with the shape of each face, OBJ with a group for each shape, or
// GeoJSON with a feature for each shape. Shapes share no vertices.

#ifndef DETECT_PLANES_WRITE_POLYGONS_H
#define DETECT_PLANES_WRITE_POLYGONS_H

#include "outlines/shape_polygons.h"

#include <iosfwd>
#include <string>

namespace program {

// The format is that of the extension, in any case. Faces of PLY and OBJ have no holes: polygons with holes are
// written as triangles there, and all polygons are where `is_triangulated`.
void write_polygons(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& path,
                    bool is_triangulated);

} // namespace program

#endif // DETECT_PLANES_WRITE_POLYGONS_H
