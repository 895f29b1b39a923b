// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a shape against its plane, and against the plane that fits them best.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SHAPE_MEASURES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SHAPE_MEASURES_H

#include <CGAL/Shape_regularization_tandem/models/facts/Level_frame.h>
#include <CGAL/Shape_regularization_tandem/models/facts/smallest_rectangle.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Unit.h>
#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace facts {

// Lengths are in the unit.
class Shape_measures {
public:
  Shape_measures(const std::vector<Position>& points, const outlines::Shapes& shapes,
                 const outlines::Unit& unit, std::size_t s)
    : plane(unit.in(shapes.coefficients(s))), frame(shapes, s, unit.in(points[shapes.points(s)[0]]))
  {
    members.reserve(shapes.points(s).size());
    for(std::uint32_t i : shapes.points(s))
      members.push_back(unit.in(points[i]));
    measure();
  }

  Vector normal() const { return {plane[0], plane[1], plane[2]}; }
  Vector centroid() const { return vector(members[0]) + scatter.centroid; }

  // Of the points to the plane.
  double mean_distance() const { return sum / scatter.count; }
  double rms_distance() const { return std::sqrt(squares / scatter.count); }

  // Of the centroid, through which the least-squares plane passes.
  double shifted() const { return std::fabs(height(centroid())); }

  // The angle with the least-squares plane. There are many where the two smallest eigenvalues are equal, as of points on
  // a line: the plane is as close to the closest of them.
  double turned_deg() const
  {
    const Eigen_system e = eigen_system(scatter.matrix);
    const double rounding =
      e.value[0] + tuning::exactness::squared_distance_margin * e.value[2] + scatter.count * coordinate_rounding2;
    Vector outside = {0, 0, 0};
    for(int i = 1; i < 3; ++i)
      if(e.value[i] > rounding)
        outside = add_scaled(outside, dot(normal(), e.vector[i]), e.vector[i]);
    return degrees(std::asin((std::min)(length(outside), 1.)));
  }

  Rectangle_sides rectangle() const
  {
    std::vector<Flat_point> flat;
    flat.reserve(members.size());
    for(const outlines::Kernel::Point_3& p : members)
      flat.push_back(frame.flat(p));
    return smallest_rectangle(flat);
  }

  // The smallest and the largest height of a point above the level through the origin.
  std::array<double, 2> heights(const Level_frame& level) const
  {
    std::array<double, 2> range = {level.height(vector(members[0])), level.height(vector(members[0]))};
    for(const outlines::Kernel::Point_3& p : members) {
      range[0] = (std::min)(range[0], level.height(vector(p)));
      range[1] = (std::max)(range[1], level.height(vector(p)));
    }
    return range;
  }

private:
  static constexpr double coordinate_rounding2 = 0x1p-104; // the square of the last bit of coordinates below 1

  static Vector vector(const outlines::Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

  double height(const Vector& p) const
  {
    return std::fma(plane[0], p.x, std::fma(plane[1], p.y, std::fma(plane[2], p.z, plane[3])));
  }

  // The moments are those about the first point, as coordinates may be large.
  void measure()
  {
    const Vector origin = vector(members[0]);
    scatter = {double(members.size()), {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
    for(const outlines::Kernel::Point_3& p : members) {
      scatter.centroid = scatter.centroid + (vector(p) - origin);
      const double h = height(vector(p));
      sum += std::fabs(h);
      squares = std::fma(h, h, squares);
    }
    scatter.centroid = (1 / scatter.count) * scatter.centroid;
    for(const outlines::Kernel::Point_3& p : members) {
      const Vector v = vector(p) - origin - scatter.centroid;
      scatter.matrix =
        scatter.matrix + Symmetric_matrix{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
    }
  }

  outlines::Shapes::Coefficients plane;
  outlines::Plane_frame frame;
  std::vector<outlines::Kernel::Point_3> members;
  Scatter scatter;
  double sum = 0, squares = 0; // of distances
};

} // namespace facts
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SHAPE_MEASURES_H
