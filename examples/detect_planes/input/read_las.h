// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_READ_LAS_H
#define DETECT_PLANES_READ_LAS_H

#include "input/Byte_source.h"
#include "input/input_settings.h"
#include "input/point_set.h"

namespace program {

// LAS or LAZ. `path` is for LASzip, which opens a LAZ file itself.
void read_las(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
              Input_notes& notes);

} // namespace program

#endif // DETECT_PLANES_READ_LAS_H
