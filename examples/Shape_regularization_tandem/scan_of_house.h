// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The generated house as a driver of a scanner may deliver it.

#ifndef TANDEM_EXAMPLES_SCAN_OF_HOUSE_H
#define TANDEM_EXAMPLES_SCAN_OF_HOUSE_H

#include "house_cloud.h"

#include <cmath>
#include <cstdint>
#include <vector>

// Millimeters, a normal of bytes, and more.
struct Scan_point {
  std::int32_t position_in_mm[3];
  std::int8_t normal[3];
  std::uint16_t intensity;
};

inline std::vector<Scan_point> scan_of_house()
{
  std::vector<Scan_point> scan;
  for(const auto& [p, n] : house::make_cloud()) {
    Scan_point s = {};
    for(int c = 0; c < 3; ++c) {
      s.position_in_mm[c] = std::int32_t(std::lround(1000 * p[c]));
      s.normal[c] = std::int8_t(std::lround(100 * n[c]));
    }
    scan.push_back(s);
  }
  return scan;
}

#endif // TANDEM_EXAMPLES_SCAN_OF_HOUSE_H
