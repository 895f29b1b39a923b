// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the command line that are about the reading of clouds, checked.

#ifndef DETECT_PLANES_INPUT_OPTIONS_H
#define DETECT_PLANES_INPUT_OPTIONS_H

#include "formats.h"
#include "input/input_settings.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// The value of --classes: numbers from 0 to 255, separated by commas or blanks.
inline std::vector<int> parse_classes(const std::string& text)
{
  std::vector<int> classes;
  for(auto first = std::find_if_not(text.begin(), text.end(), is_separator); first != text.end();) {
    const auto last = std::find_if(first, text.end(), is_separator);
    const std::string word(first, last);
    first = std::find_if_not(last, text.end(), is_separator);
    const bool is_number = word.size() <= 3 && word.find_first_not_of("0123456789") == word.npos;
    if(!is_number || std::stoi(word) > 255)
      throw std::invalid_argument("--classes has '" + word + "', must be numbers from 0 to 255, as in 2,6");
    classes.push_back(std::stoi(word));
  }
  if(classes.empty())
    throw std::invalid_argument("--classes has no number, must be numbers from 0 to 255, as in 2,6");
  return classes;
}

// Throws std::invalid_argument where the options are wrong, or cannot be meant.
inline Input_settings input_settings(const std::vector<std::string>& inputs, const std::string& columns,
                                     const std::string& classes)
{
  Input_settings settings;
  if(!columns.empty()) {
    settings.columns = parse_columns(columns);
    if(std::none_of(inputs.begin(), inputs.end(), is_table))
      throw std::invalid_argument("--columns is for text tables (.xyz, .txt, .csv, .pts or .pwn)");
  }
  if(!classes.empty())
    settings.classes = parse_classes(classes);
  return settings;
}

} // namespace program

#endif // DETECT_PLANES_INPUT_OPTIONS_H
