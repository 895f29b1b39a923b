// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coordinates in the plane of a shape.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_FRAME_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_FRAME_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>

#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;

// Of the angle between lines, or planes, that are intersected, about 15 degrees: flatter ones do not tell well where.
constexpr double smallest_sine = .25;

// Coordinates in the plane of a shape, with the lengths and angles in space. They decide what is connected how; vertices
// are computed in space.
class Plane_frame {
public:
  Plane_frame(const Shapes& shapes, std::size_t s, const Kernel::Point_3& origin) : origin(origin)
  {
    const Shapes::Coefficients& c = shapes.coefficients(s);
    const Kernel::Vector_3 normal(c[0], c[1], c[2]);
    const std::size_t steepest = Projection(c).steepest_axis();
    const Kernel::Vector_3 across =
      CGAL::cross_product(Kernel::Vector_3(steepest == 1, steepest == 2, steepest == 0), normal);
    first = across / std::sqrt(across.squared_length());
    second = CGAL::cross_product(normal, first);
  }

  Kernel::Point_2 flat(const Kernel::Point_3& p) const
  {
    const Kernel::Vector_3 v = p - origin;
    return Kernel::Point_2(first * v, second * v);
  }

  Kernel::Vector_2 flat(const Kernel::Vector_3& v) const { return Kernel::Vector_2(first * v, second * v); }

  Kernel::Point_3 lifted(const Kernel::Point_2& p) const { return origin + p.x() * first + p.y() * second; }

private:
  Kernel::Point_3 origin;
  Kernel::Vector_3 first, second;
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_FRAME_H
