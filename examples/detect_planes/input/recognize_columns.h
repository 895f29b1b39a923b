// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_RECOGNIZE_COLUMNS_H
#define DETECT_PLANES_RECOGNIZE_COLUMNS_H

#include "input/table_columns.h"

#include <string>
#include <vector>

namespace program {

// The first rows of a table, all with as many values; NaN for what is no number.
using Sample = std::vector<std::vector<double>>;

constexpr double largest_error_of_length = .1; // of a normal, which should have length 1

// Most of the normals in the columns from `first` on have length 1.
bool are_normals(const Sample& rows, std::size_t first);

// Channels from 0 to 1, at least one of which is between.
bool are_real_colors(const Sample& rows, std::size_t first);

// The columns of a line of names, or none if it does not name x, y and z.
std::vector<Column> columns_of_header(const std::string& line);

// The columns of a table without a line of names. In a .pts file the intensity comes before the colors, a
// .pwn file has normals.
std::vector<Column> recognize_columns(const Sample& rows, const std::string& extension);

} // namespace program

#endif // DETECT_PLANES_RECOGNIZE_COLUMNS_H
