// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_PLY_ATTRIBUTES_H
#define DETECT_PLANES_PLY_ATTRIBUTES_H

#include "input/point_set.h"

namespace program {

// Of the properties that CGAL's reader makes of a PLY file: color, intensity and classification get the names and types
// of point_set.h, others are removed, but for the normals.
void convert_attributes(Point_set& points);

} // namespace program

#endif // DETECT_PLANES_PLY_ATTRIBUTES_H
