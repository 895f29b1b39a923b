// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_UNIT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_UNIT_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// A power of two, in which the largest coordinate of the shapes is between 1/2 and 1, so that squares and products of
// lengths are far from the bounds of doubles. Numbers that are not close to these bounds keep all their bits.
class Unit {
public:
  template <class Point>
  Unit(const std::vector<Point>& points, const Shapes& shapes)
  {
    double largest = 0;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s))
        for(int k = 0; k < 3; ++k)
          largest = (std::max)(largest, std::fabs(points[i][k]));
    std::frexp(largest, &exponent);
  }

  double in(double length) const { return std::ldexp(length, -exponent); }
  Kernel::Point_3 in(const Kernel::Point_3& p) const { return Kernel::Point_3(in(p.x()), in(p.y()), in(p.z())); }
  Kernel::Point_3 in(const Position& p) const { return Kernel::Point_3(in(p[0]), in(p[1]), in(p[2])); }
  Shapes::Coefficients in(const Shapes::Coefficients& c) const { return {c[0], c[1], c[2], in(c[3])}; }

  double out(double length) const { return std::ldexp(length, exponent); }
  double area_out(double area) const { return out(out(area)); }
  Position out(const Position& p) const { return {out(p[0]), out(p[1]), out(p[2])}; }

  // As it is after it was written, in this unit.
  Position written(const Position& p) const
  {
    const Position q = out(p);
    return {in(q[0]), in(q[1]), in(q[2])};
  }

private:
  int exponent = 0;
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_UNIT_H
