// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Coordinates in the plane of a shape.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_PLANE_FRAME_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_PLANE_FRAME_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;
using Position = std::array<double, 3>;

// Of the angle between lines, or planes, that are intersected, about 15 degrees: flatter ones do not tell well where.
constexpr double smallest_sine = .25;

// Without the coordinate along which the plane is steepest, seen from where the normal points to. Nothing is rounded:
// what lines are here, simple for example, they are as they are written. Areas shrink by `shrinkage()`.
class Projection {
public:
  explicit Projection(const Shapes::Coefficients& plane) : plane(plane)
  {
    for(std::size_t k = 1; k < 3; ++k)
      if(std::fabs(plane[k]) > std::fabs(plane[steepest]))
        steepest = k;
    axes = {(steepest + 1) % 3, (steepest + 2) % 3};
    if(plane[steepest] < 0)
      std::swap(axes[0], axes[1]);
  }

  Kernel::Point_2 projected(const Position& p) const { return Kernel::Point_2(p[axes[0]], p[axes[1]]); }

  // The position that is projected to `p`.
  Position on_plane(const Kernel::Point_2& p) const
  {
    Position x;
    x[axes[0]] = p.x();
    x[axes[1]] = p.y();
    const long double rest =
      static_cast<long double>(plane[axes[0]]) * p.x() + static_cast<long double>(plane[axes[1]]) * p.y() + plane[3];
    x[steepest] = double(-rest / plane[steepest]);
    return x;
  }

  double shrinkage() const { return std::fabs(plane[steepest]); }
  std::size_t steepest_axis() const { return steepest; }

private:
  Shapes::Coefficients plane;
  std::size_t steepest = 0;
  std::array<std::size_t, 2> axes;
};

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

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_PLANE_FRAME_H
