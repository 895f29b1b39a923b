// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A direction on the command line: three numbers with commas between them.

#ifndef DETECT_PLANES_DIRECTION_OPTION_H
#define DETECT_PLANES_DIRECTION_OPTION_H

#include "Options.h"

#include <array>
#include <istream>
#include <locale>
#include <sstream>
#include <string>

namespace program {

// Whether the text is a direction, and nothing else.
inline bool read_direction(const std::string& text, std::array<double, 3>& d)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  char first = 0, second = 0;
  if(!(in >> d[0] >> first >> d[1] >> second >> d[2]) || first != ',' || second != ',')
    return false;
  in >> std::ws;
  return in.eof() && (d[0] != 0 || d[1] != 0 || d[2] != 0);
}

inline std::array<double, 3> parse_direction(const std::string& option, const std::string& text)
{
  std::array<double, 3> direction = {};
  if(!read_direction(text, direction))
    throw Usage_error("--" + option + " is '" + text +
                      "', must be three numbers with commas between them, not all 0, as in 0,0,1");
  return direction;
}

} // namespace program

#endif // DETECT_PLANES_DIRECTION_OPTION_H
