// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_READ_LAZ_H
#define DETECT_PLANES_READ_LAZ_H

#include "input/Cloud_builder.h"
#include "input/las_header.h"

namespace program {

// Rounded after each operation, also where the processor could do both at once.
double place_of_integer(std::int32_t integer, const Las_frame& frame, std::size_t axis);

// The points that LASzip reads. An exception where the program was built without it.
void read_laz_points(const std::string& path, const Las_header& header, Cloud_builder& builder);

} // namespace program

#endif // DETECT_PLANES_READ_LAZ_H
