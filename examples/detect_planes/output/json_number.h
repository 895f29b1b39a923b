// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_JSON_NUMBER_H
#define DETECT_PLANES_JSON_NUMBER_H

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace program {

// All numbers of JSON are written by this. 0.15 rather than 0.14999999999999999, if both stand for the same double;
// null for what is no finite number, as JSON knows no other.
inline std::string json_number(double value)
{
  if(!std::isfinite(value))
    return "null";
  char text[40];
  for(int digits = 15; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if(std::strtod(text, nullptr) == value)
      break;
  }
  return text;
}

} // namespace program

#endif // DETECT_PLANES_JSON_NUMBER_H
