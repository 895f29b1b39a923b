// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A plane with the part that its points cover, and the part that a wall without points is assumed to cover.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_PLANE_COVERAGE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_PLANE_COVERAGE_H

#include <CGAL/Shape_regularization_tandem/internal/surface/Covered_squares.h>
#include <CGAL/Tandem/Shapes_data.h>

#include <CGAL/convex_hull_2.h>

#include <array>
#include <iterator>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Plane_coverage {
public:
  using Quadrangle = std::array<Point, 4>;

  // No point covers it yet.
  explicit Plane_coverage(const Coefficients& plane) : plane_(plane), normal_(plane[0], plane[1], plane[2])
  {
    const Vector axis = Kernel::Plane_3(plane[0], plane[1], plane[2], plane[3]).base1();
    first_ = axis / std::sqrt(axis.squared_length());
    second_ = CGAL::cross_product(normal_, first_);
  }

  // The points are close to the plane. What is nearer to each other than the resolution is one place.
  Plane_coverage(const Coefficients& plane, std::vector<Point> points, double resolution) : Plane_coverage(plane)
  {
    points_ = std::move(points);
    origin_ = points_.front() - height(points_.front()) * normal_;
    std::vector<Kernel::Point_2> flat_points;
    for(const Point& p : points_)
      flat_points.push_back(flat(p));
    squares_ = Covered_squares(flat_points, resolution);
    CGAL::convex_hull_2(flat_points.begin(), flat_points.end(), std::back_inserter(hull_));
    for(const Kernel::Point_2& p : flat_points)
      areas_.push_back(squares_.area_of_point(p, hull_));
  }

  // The hull has these corners, too, which are close to the plane.
  void reach(const Quadrangle& corners)
  {
    if(hull_.empty())
      origin_ = corners.front() - height(corners.front()) * normal_;
    std::vector<Kernel::Point_2> all = hull_, hull;
    for(const Point& p : corners)
      all.push_back(flat(p));
    CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(hull));
    hull_ = std::move(hull);
  }

  // There is a wall without points in this part of the hull.
  void assume(const Quadrangle& part)
  {
    assumed_.emplace_back();
    for(const Point& p : part)
      assumed_.back().push_back(flat(p));
  }

  const Coefficients& plane() const { return plane_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Kernel::Point_2>& hull() const { return hull_; }
  bool has_assumed_part() const { return !assumed_.empty(); }

  // Points on a line have none.
  bool has_area() const { return hull_.size() > 2 && CGAL::polygon_area_2(hull_.begin(), hull_.end(), Kernel()) > 0; }

  Kernel::Point_2 flat(const Point& p) const
  {
    return Kernel::Point_2((p - origin_) * first_, (p - origin_) * second_);
  }

  double height(const Point& p) const { return normal_ * (p - CGAL::ORIGIN) + plane_[3]; }

  bool is_in_hull(const Point& p) const { return is_in(hull_, flat(p)); }
  bool is_near_hull(const Point& p, double distance) const
  {
    const Kernel::Point_2 q = flat(p);
    for(std::size_t i = 0; i < hull_.size(); ++i) {
      const Kernel::Vector_2 edge = hull_[(i + 1) % hull_.size()] - hull_[i];
      if(CGAL::determinant(edge, q - hull_[i]) < -distance * std::sqrt(edge.squared_length()))
        return false;
    }
    return true;
  }

  bool is_assumed(const Point& p) const { return is_assumed(flat(p)); }
  double area_of_point(std::size_t i) const { return areas_[i]; } // its share of the covered area

  // Where a ray meets the plane.
  enum class Crossing { none, covered, assumed };
  Crossing crossing(const Point& start, const Vector& direction) const
  {
    const double slope = normal_ * direction, h = height(start);
    if(slope * h >= 0)
      return Crossing::none;
    const Kernel::Point_2 p = flat(start - h / slope * direction);
    return squares_.has(p) ? Crossing::covered : is_assumed(p) ? Crossing::assumed : Crossing::none;
  }

private:
  static bool is_in(const std::vector<Kernel::Point_2>& polygon, const Kernel::Point_2& p)
  {
    return CGAL::bounded_side_2(polygon.begin(), polygon.end(), p) != CGAL::ON_UNBOUNDED_SIDE;
  }

  bool is_assumed(const Kernel::Point_2& p) const
  {
    return std::any_of(assumed_.begin(), assumed_.end(), [&](const auto& part) { return is_in(part, p); });
  }

  Coefficients plane_;
  Vector normal_, first_, second_;
  Point origin_ = CGAL::ORIGIN;
  std::vector<Point> points_;
  std::vector<double> areas_; // of the points
  Covered_squares squares_;
  std::vector<std::vector<Kernel::Point_2>> assumed_;
  std::vector<Kernel::Point_2> hull_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_PLANE_COVERAGE_H
