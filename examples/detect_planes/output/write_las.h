// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_WRITE_LAS_H
#define DETECT_PLANES_WRITE_LAS_H

#include "output/Output_points.h"

namespace program {

// LAS 1.4 with the shape as extra bytes. Coordinates are rounded to the grid of the input, or to one that is fine for
// the distances within shapes. Points that are not finite are left out.
void write_las(std::ostream& out, const Output_points& cloud, const std::optional<Las_frame>& frame_of_input);

// The same, compressed. Nothing where the program was built without LASzip.
void write_laz(std::ostream& out, const Output_points& cloud, const std::optional<Las_frame>& frame_of_input);

} // namespace program

#endif // DETECT_PLANES_WRITE_LAS_H
