// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_SHAPE_COLOR_H
#define DETECT_PLANES_SHAPE_COLOR_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace program {

using Color = std::array<std::uint8_t, 3>;

// Steps of the golden ratio around the color wheel keep shapes of close indices apart.
inline Color color_of_shape(int shape)
{
  if(shape < 0)
    return {110, 110, 110};
  const double hue = 6 * std::fmod(0.13 + 0.61803398874989485 * shape, 1.0);
  const double saturation = shape % 3 == 1 ? 0.55 : 0.8;
  const double value = shape % 2 == 1 ? 0.8 : 1.0;
  const auto channel = [&](double shift) {
    const double x = std::fmod(shift + hue, 6.0);
    const double share = (std::max)(0.0, (std::min)({x, 4 - x, 1.0}));
    return std::uint8_t(std::lround(255 * value * (1 - saturation * share)));
  };
  return {channel(5), channel(3), channel(1)};
}

} // namespace program

#endif // DETECT_PLANES_SHAPE_COLOR_H
