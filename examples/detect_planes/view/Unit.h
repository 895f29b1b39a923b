// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_UNIT_H
#define DETECT_PLANES_UNIT_H

#include "output/write_results.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace program {

// A power of two, in which the largest coordinate of the shapes is between 1/2 and 1, so that squares and products of
// lengths are far from the bounds of doubles. Numbers that are not close to these bounds keep all their bits.
class Unit {
public:
  Unit(const Point_set& points, const Shapes& shapes)
  {
    double largest = 0;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s)) {
        const Kernel::Point_3& p = points.point(*(points.begin() + std::ptrdiff_t(i)));
        largest = (std::max)({largest, std::fabs(p.x()), std::fabs(p.y()), std::fabs(p.z())});
      }
    std::frexp(largest, &exponent);
  }

  double in(double length) const { return std::ldexp(length, -exponent); }
  Kernel::Point_3 in(const Kernel::Point_3& p) const { return Kernel::Point_3(in(p.x()), in(p.y()), in(p.z())); }
  Shapes::Coefficients in(const Shapes::Coefficients& c) const { return {c[0], c[1], c[2], in(c[3])}; }
  double out(double length) const { return std::ldexp(length, exponent); }

private:
  int exponent = 0;
};

} // namespace program

#endif // DETECT_PLANES_UNIT_H
