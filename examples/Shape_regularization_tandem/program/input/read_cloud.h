// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads clouds, and reports in one line what is wrong with a file that cannot be read, or would be misread without a
// word.

#ifndef DETECT_PLANES_READ_CLOUD_H
#define DETECT_PLANES_READ_CLOUD_H

#include "input/input_settings.h"
#include "input/point_set.h"

#include <string>
#include <vector>

namespace program {

void read_cloud(const std::string& path, const Input_settings& settings, Point_set& points, Input_notes& notes);

// One cloud of several files, in their order. It has what all of them have.
Input_notes read_clouds(const std::vector<std::string>& paths, const Input_settings& settings, Point_set& points);

} // namespace program

#endif // DETECT_PLANES_READ_CLOUD_H
