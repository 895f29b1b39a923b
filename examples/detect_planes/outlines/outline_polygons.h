// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Straightens the outline of a shape, and makes polygons with holes of it.

#ifndef DETECT_PLANES_OUTLINE_POLYGONS_H
#define DETECT_PLANES_OUTLINE_POLYGONS_H

#include "outlines/Outline_triangulation.h"
#include "outlines/shape_polygons.h"

namespace program {

// Lines and what they become: polygons whose lines are simple and have no common points, as they are written. False if
// the lines, written or straightened, are not like that: then nothing is changed.
bool make_polygons(const std::vector<Outline_loop>& loops, double tolerance, std::vector<Outline_vertex>& vertices,
                   std::vector<Polygon>& polygons);

} // namespace program

#endif // DETECT_PLANES_OUTLINE_POLYGONS_H
