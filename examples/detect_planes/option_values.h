// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of options that are lists: directions, a place, and how clouds are read.

#ifndef DETECT_PLANES_OPTION_VALUES_H
#define DETECT_PLANES_OPTION_VALUES_H

#include "Options.h"
#include "file_names.h"
#include "input/input_settings.h"
#include "input/table_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// Whether the text is three finite numbers with commas between them, and nothing else.
inline bool read_three(const std::string& text, std::array<double, 3>& d)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  char first = 0, second = 0;
  if(!(in >> d[0] >> first >> d[1] >> second >> d[2]) || first != ',' || second != ',')
    return false;
  in >> std::ws;
  return in.eof();
}

inline std::array<double, 3> parse_direction(const std::string& option, const std::string& text)
{
  std::array<double, 3> direction = {};
  if(!read_three(text, direction) || direction == std::array<double, 3>())
    throw Usage_error("--" + option + " is '" + text +
                      "', must be three numbers with commas between them, not all 0, as in 0,0,1");
  return direction;
}

inline std::array<double, 3> parse_place(const std::string& option, const std::string& text)
{
  std::array<double, 3> place = {};
  if(!read_three(text, place))
    throw Usage_error("--" + option + " is '" + text +
                      "', must be three numbers with commas between them, as in 2.5,-1,1.6");
  return place;
}

constexpr int no_class = -1;

inline int class_of(const std::string& word)
{
  const bool is_number = !word.empty() && word.size() <= 3 && word.find_first_not_of("0123456789") == word.npos;
  return is_number && std::stoi(word) <= 255 ? std::stoi(word) : no_class;
}

// The value of --classes: numbers from 0 to 255 with commas or blanks between them.
inline std::vector<int> parse_classes(const std::string& text)
{
  std::vector<int> classes;
  std::istringstream parts(text + ','); // with a part after the last comma, too
  for(std::string part, word; std::getline(parts, part, ',');) {
    std::istringstream words(part);
    words >> word;
    classes.push_back(words ? class_of(word) : no_class);
    while(words >> word)
      classes.push_back(class_of(word));
  }
  if(std::count(classes.begin(), classes.end(), no_class) > 0)
    throw std::invalid_argument("--classes is '" + text +
                                "', must be numbers from 0 to 255 with commas between them, as in 2,6");
  return classes;
}

// The numbers with commas between them, which may be infinite; none if something else is there.
inline std::vector<double> read_numbers(const std::string& text)
{
  std::vector<double> numbers;
  std::istringstream parts(text + ','); // with a part after the last comma, too
  for(std::string part; std::getline(parts, part, ',');) {
    part.erase(std::remove(part.begin(), part.end(), ' '), part.end());
    const std::optional<double> number = parse_number(part);
    if(!number || std::isnan(*number))
      return {};
    numbers.push_back(*number);
  }
  return numbers;
}

// The value of --crop.
inline Input_box parse_box(const std::string& text)
{
  const std::vector<double> sides = read_numbers(text);
  Input_box box;
  bool is_box = sides.size() == 6;
  for(std::size_t c = 0; c < 3 && is_box; ++c) {
    box.low[c] = sides[c];
    box.high[c] = sides[c + 3];
    is_box = box.low[c] <= box.high[c];
  }
  if(!is_box)
    throw std::invalid_argument("--crop is '" + text +
                                "', must be XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX: six numbers, no minimum above its maximum");
  return box;
}

// The value of --format, as an extension.
inline std::string parse_format(const std::string& text)
{
  std::string extension = "." + text;
  if(!is_input_extension(extension))
    throw Usage_error("--format is '" + text + "', must be ply, las, laz, pcd, off, ptx or that of a text table (" +
                      table_names() + ") without the point");
  return extension;
}

// Throws std::invalid_argument where the options are wrong, or cannot be meant.
inline Input_settings input_settings(const Options& o)
{
  Input_settings settings;
  settings.tolerance = o.tolerance_column;
  settings.has_decimal_commas = o.has_decimal_commas;
  if(!o.columns.empty())
    settings.columns = parse_columns(o.columns, o.tolerance_column);
  if(!o.format.empty())
    settings.format = parse_format(o.format);
  const auto has_input_of = [&](auto is_right) {
    return std::any_of(o.inputs.begin(), o.inputs.end(),
                       [&](const std::string& path) { return is_right(input_format(path, settings.format)); });
  };
  if(!o.columns.empty() && !has_input_of(is_table))
    throw Usage_error("--columns is for text tables (" + table_names() + ")");
  if(o.has_decimal_commas && !has_input_of([](const std::string& f) { return is_table(f) || f == ".ptx"; }))
    throw Usage_error("--decimal-comma is for text tables (" + table_names() + ") and .ptx");
  if(o.sample && !has_input_of([](const std::string& f) { return f == ".ply" || f == ".off"; }))
    throw Usage_error("--sample is for meshes (.ply, .off)");
  if(o.sample)
    settings.sample = std::size_t(*o.sample);
  if(!o.classes.empty())
    settings.classes = parse_classes(o.classes);
  if(!o.crop.empty())
    settings.crop = parse_box(o.crop);
  return settings;
}

} // namespace program

#endif // DETECT_PLANES_OPTION_VALUES_H
