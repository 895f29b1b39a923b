// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the writers share. Everything is written exactly, so that the guarantees can be checked from the files.

#ifndef DETECT_PLANES_WRITE_RESULTS_H
#define DETECT_PLANES_WRITE_RESULTS_H

#include "file_names.h"
#include "input/point_set.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <charconv>
#include <iomanip>
#include <ostream>

namespace program {

// The bytes of a number, little-endian on every machine.
template <class T>
void write_binary(std::ostream& out, T value)
{
  const T ordered = little_endian(value);
  out.write(reinterpret_cast<const char*>(&ordered), sizeof(T));
}

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
    const double fraction = (std::max)(0.0, (std::min)({x, 4 - x, 1.0}));
    return std::uint8_t(std::lround(255 * value * (1 - saturation * fraction)));
  };
  return {channel(5), channel(3), channel(1)};
}

using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;

// The shortest digits that give the number again, and a character behind them.
template <class Real>
void write_shortest(std::ostream& out, Real x, char end)
{
  char text[40];
  char* last = std::to_chars(text, text + sizeof text - 1, x).ptr;
  *last++ = end;
  out.write(text, last - text);
}

inline bool fits_float(double x) { return !std::isfinite(x) || double(float(x)) == x; }

// Estimated normals that were turned to a side are those of the points. Without normals, as known planes need none, null.
inline Kernel::Vector_3 normal_used(const Point_set& points, const Shapes& shapes, Point_set::Index i)
{
  if(points.has_normal_map())
    return points.normal(i);
  return shapes.has_estimated_normals() ? shapes.estimated_normal(i) : Kernel::Vector_3(CGAL::NULL_VECTOR);
}

} // namespace program

#endif // DETECT_PLANES_WRITE_RESULTS_H
