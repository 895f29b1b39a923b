// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_INPUT_BOX_H
#define DETECT_PLANES_INPUT_BOX_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>

namespace program {

// A box in the coordinates of the inputs, with its sides. It starts empty.
struct Input_box {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low = {infinity, infinity, infinity}, high = {-infinity, -infinity, -infinity};

  // No point that is not finite is within, also where a side is open.
  bool has(const double* p) const
  {
    for(std::size_t c = 0; c < 3; ++c)
      if(!(p[c] >= low[c] && p[c] <= high[c]) || p[c] - p[c] != 0)
        return false;
    return true;
  }

  // Leaves out points that are not finite.
  void add(const double* p)
  {
    const double sum = p[0] + p[1] + p[2];
    for(std::size_t c = 0; c < 3 && sum - sum == 0; ++c) {
      low[c] = (std::min)(low[c], p[c]);
      high[c] = (std::max)(high[c], p[c]);
    }
  }

  // As the option --crop takes it.
  std::string text() const
  {
    std::ostringstream out;
    out.precision(10);
    for(std::size_t c = 0; c < 6; ++c)
      out << (c > 0 ? "," : "") << (c < 3 ? low[c] : high[c - 3]);
    return out.str();
  }
};

} // namespace program

#endif // DETECT_PLANES_INPUT_BOX_H
