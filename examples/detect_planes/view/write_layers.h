// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the page of the view shows beside the points: outlines and triangles of the shapes, and colors of the input.

#ifndef DETECT_PLANES_WRITE_LAYERS_H
#define DETECT_PLANES_WRITE_LAYERS_H

#include "output/shape_areas.h"
#include "output/write_results.h"

#include <cstdint>
#include <iosfwd>
#include <vector>

namespace program {

// Three elements, which layers.js reads: the corners, three floats each, relative to the center of the page; then for
// each shape the number of its loops, and for each loop its number of corners and these; then for each shape the number
// of its triangles, and their corners. Corners are positions in the first element, of 32 bits.
void write_areas(std::ostream& out, const Shape_areas& areas, const Kernel::Point_3& center);

// Three bytes for each of the positions, if the input has colors; else the element is empty.
void write_input_colors(std::ostream& out, const Point_set& points, const std::vector<std::uint32_t>& positions);

} // namespace program

#endif // DETECT_PLANES_WRITE_LAYERS_H
