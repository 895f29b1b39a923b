// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads clouds, and reports in one line what is wrong with a file that cannot be read, or would be misread without a
// word.

#ifndef DETECT_PLANES_READ_CLOUD_H
#define DETECT_PLANES_READ_CLOUD_H

#include "input/input_settings.h"
#include "input/point_set.h"

namespace program {

void read_cloud(const std::string& path, const Input_settings& settings, bool may_be_empty, Point_set& points,
                Input_notes& notes);

// What points may have beside coordinates: a bit for each.
using Attributes = unsigned;
constexpr Attributes normals_bit = 1, colors_bit = 2, intensity_bit = 4, classification_bit = 8;
constexpr Attributes all_attributes = normals_bit | colors_bit | intensity_bit | classification_bit;

// The words for them.
std::string names_of(Attributes attributes);

// Removes the others. A cloud without points gets those that are kept.
void keep_attributes(Attributes kept, Point_set& points);

// What one of the inputs has given.
struct Input_part {
  std::size_t input;       // its place among the inputs
  std::size_t first, last; // its points in the cloud
  Input_notes notes;
};

// One cloud of several files, in their order. It has what all of them have.
struct Input_cloud {
  Point_set points;
  std::vector<Input_part> parts;
  Attributes of_all = all_attributes, of_some = 0;
};

// Finds what is wrong before any file is read. `chosen`: the places of the files to read, in increasing order.
void check_inputs(const std::vector<std::string>& paths, const std::vector<std::size_t>& chosen,
                  const Input_settings& settings);

// Of several inputs some may have no points, which is a warning.
void read_clouds(const std::vector<std::string>& paths, const std::vector<std::size_t>& chosen,
                 const Input_settings& settings, Input_cloud& cloud);

} // namespace program

#endif // DETECT_PLANES_READ_CLOUD_H
