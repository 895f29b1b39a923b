// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The labels and the planes, and what the writers share. Everything is written exactly, so that the guarantees can be
// checked from the files.

#ifndef DETECT_PLANES_WRITE_RESULTS_H
#define DETECT_PLANES_WRITE_RESULTS_H

#include "formats.h"
#include "input/point_set.h"
#include "output/Binary_writer.h"
#include "output/shape_color.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <ostream>
#include <string>

namespace program {

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

template <class Points, class Get_vector>
bool needs_double(const Points& points, Get_vector get_vector)
{
  return std::any_of(points.begin(), points.end(), [&](Point_set::Index i) {
    const auto& v = get_vector(i);
    return !fits_float(v.x()) || !fits_float(v.y()) || !fits_float(v.z());
  });
}

inline Kernel::Vector_3 normal_used(const Point_set& points, const Shapes& shapes, Point_set::Index i)
{
  return shapes.has_estimated_normals() ? shapes.estimated_normal(i) : points.normal(i);
}

inline void write_labels(std::ostream& out, const Shapes& shapes)
{
  Binary_writer binary(out);
  for(std::int32_t shape : shapes.shape_indices())
    binary.write(shape);
}

inline void write_planes(std::ostream& out, const Shapes& shapes)
{
  out << std::setprecision(17);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto& c = shapes.coefficients(s);
    out << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3] << '\n';
  }
}

} // namespace program

#endif // DETECT_PLANES_WRITE_RESULTS_H
