// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What reads the formats.

#ifndef DETECT_PLANES_READERS_H
#define DETECT_PLANES_READERS_H

#include "input/Input_buffer.h"
#include "input/input_settings.h"
#include "input/point_set.h"

namespace program {

// LAS or LAZ. `path` is for LASzip, which opens a LAZ file itself.
void read_las(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
              Input_notes& notes);

void read_pcd(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);

// A text table: a point in each row.
void read_table(Byte_source& file, const std::string& extension, const Input_settings& settings, Point_set& points,
                Input_notes& notes);

// Scans of a scanner, each with its place.
void read_ptx(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);

// PLY and OFF may be meshes, whose faces have points where the settings say so.
void read_off(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);
void read_ply(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes);

} // namespace program

#endif // DETECT_PLANES_READERS_H
