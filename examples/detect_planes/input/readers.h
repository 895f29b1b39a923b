// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What reads the formats, but for those that CGAL reads.

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

// A text table: a point in each row. `path` is for the extension and for messages.
void read_table(Byte_source& file, const std::string& path, const Input_settings& settings, Point_set& points,
                Input_notes& notes);

// Of the properties that CGAL's reader makes of a PLY file: color, intensity, classification and tolerance get the names
// and types of point_set.h, others are removed, but for the normals.
void convert_attributes(const Input_settings& settings, Point_set& points);

} // namespace program

#endif // DETECT_PLANES_READERS_H
