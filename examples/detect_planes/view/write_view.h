// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page that shows a result in three dimensions: one file, which a browser opens from the disk. three.js and the
// page around the data are parts of the program.

#ifndef DETECT_PLANES_WRITE_VIEW_H
#define DETECT_PLANES_WRITE_VIEW_H

#include "output/report.h"

#include <ostream>

namespace program {

// Whether the program was built with three.js.
bool has_view();

void write_view(std::ostream& out, const Point_set& points, const Shapes& shapes, const Run& run);

} // namespace program

#endif // DETECT_PLANES_WRITE_VIEW_H
