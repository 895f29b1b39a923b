// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A table with a row for each shape: that of --shapes, which the page of --view has, too.

#ifndef DETECT_PLANES_SHAPE_TABLE_H
#define DETECT_PLANES_SHAPE_TABLE_H

#include "output/report.h"
#include "output/shape_areas.h"

#include <ostream>

namespace program {

// A list for each column: a number of each shape.
Json shape_table(const Point_set& points, const Shapes& shapes, const Shape_areas& areas);

// As CSV, with a line of names, and the number of the shape in front.
void write_shape_table(std::ostream& out, const Json& table);

} // namespace program

#endif // DETECT_PLANES_SHAPE_TABLE_H
