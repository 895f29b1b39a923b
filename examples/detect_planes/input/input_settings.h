// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_INPUT_SETTINGS_H
#define DETECT_PLANES_INPUT_SETTINGS_H

#include "input/Input_box.h"
#include "input/table_columns.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace program {

// How inputs are read.
struct Input_settings {
  std::vector<Column> columns;   // of text tables; empty: recognized
  std::vector<int> classes;      // only these points; empty: all
  std::optional<Input_box> crop; // only the points in it
  std::string tolerance;         // the column, property or field that has the tolerance of each point; empty: none has
  std::string format;            // the extension that tells the format; empty: that of each file
  bool has_decimal_commas = false;   // numbers of text tables
  std::optional<std::size_t> sample; // points to put on the faces of a mesh; 0: their corners
};

// `what` ends in the word that has no attributes but those of its format, as "is OFF, whose points".
inline void check_no_attributes(const Input_settings& settings, const std::string& what)
{
  if(!settings.classes.empty())
    throw std::runtime_error(what + " have no 'classification', which --classes needs");
  if(!settings.tolerance.empty())
    throw std::runtime_error(what + " have no '" + settings.tolerance + "', which --tolerance-column names");
}

// Of degrees in place of lengths.
constexpr const char* advice_on_degrees = "project such coordinates first, to UTM, for example";

// How a LAS file describes its coordinate system.
enum class Projection { none, geotiff, wkt };

// The coordinates of a LAS file are integers times a scale, plus an offset.
struct Las_frame {
  std::array<double, 3> scale, offset;
  std::vector<std::string> records; // of the coordinate system, with their headers
  Projection projection = Projection::none;
};

// Where the points of a file were seen from.
struct Viewpoint {
  std::array<double, 3> place;
  bool is_default; // what writers put there that know none
};

// What the reading found out, for people and for the outputs.
struct Input_notes {
  std::vector<std::pair<std::string, std::string>> lines; // a word, and what there is to say about it
  std::vector<std::string> warnings;
  std::optional<Las_frame> las_frame; // of the first LAS file
  std::optional<Viewpoint> viewpoint; // of a PCD file
  Input_box box;                      // of all points, where some are cropped
};

} // namespace program

#endif // DETECT_PLANES_INPUT_SETTINGS_H
