// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A plane with the part that its points cover: the squares of a grid that have points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_PLANE_COVERAGE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_PLANE_COVERAGE_H

#include <CGAL/Shape_regularization_tandem/internal/surface/Cells.h>
#include <CGAL/Tandem/Shapes_data.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>

#include <cstdint>
#include <iterator>
#include <unordered_set>
#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Plane_coverage {
public:
  // The points are close to the plane.
  Plane_coverage(const Coefficients& plane, std::vector<Point> points) : Plane_coverage(plane)
  {
    set_hull(points);
    points_ = std::move(points);
    std::vector<Kernel::Point_2> flat_points;
    for(const Point& p : points_)
      flat_points.push_back(flat(p));
    side_ = largest_extent(flat_points) / 8;
    for(int round = 0; round < rounds && side_ > 0; ++round) {
      mark(flat_points);
      side_ = std::sqrt(points_in_a_square * double(squares_.size()) * side_ * side_ / double(points_.size()));
    }
    if(side_ > 0)
      mark(flat_points);
    for(const Square square : squares_) {
      const double x = double(std::int32_t(square >> 32)) * side_, y = double(std::int32_t(square)) * side_;
      box_ += CGAL::Bbox_2(x, y, x + side_, y + side_);
    }
  }

  // A plane that no point covers: it may only be a boundary between these corners.
  static Plane_coverage without_points(const Coefficients& plane, const std::vector<Point>& corners)
  {
    Plane_coverage result(plane);
    result.set_hull(corners);
    return result;
  }

  const Coefficients& plane() const { return plane_; }
  const std::vector<Point>& points() const { return points_; }
  const std::vector<Kernel::Point_2>& hull() const { return hull_; }

  // Points on a line have none.
  bool has_area() const { return hull_.size() > 2 && CGAL::polygon_area_2(hull_.begin(), hull_.end(), Kernel()) > 0; }

  Kernel::Point_2 flat(const Point& p) const
  {
    return Kernel::Point_2((p - origin_) * first_, (p - origin_) * second_);
  }

  double height(const Point& p) const { return normal_ * (p - CGAL::ORIGIN) + plane_[3]; }

  bool is_covered(const Point& p) const
  {
    const Kernel::Point_2 q = flat(p);
    return q.x() >= box_.xmin() && q.x() <= box_.xmax() && q.y() >= box_.ymin() && q.y() <= box_.ymax() &&
           squares_.count(square_of(q)) > 0;
  }

  bool is_in_hull(const Point& p) const
  {
    return CGAL::bounded_side_2(hull_.begin(), hull_.end(), flat(p)) != CGAL::ON_UNBOUNDED_SIDE;
  }

  // Of a ray with the plane.
  bool is_crossed_where_covered(const Point& start, const Vector& direction) const
  {
    const double slope = normal_ * direction, h = height(start);
    return slope * h < 0 && is_covered(start - h / slope * direction);
  }

  // Squares stand out at the edges of the points: those whose center is beyond the convex hull do not count.
  double covered_area() const
  {
    const auto is_in = [&](Square s) {
      const Kernel::Point_2 center((double(std::int32_t(s >> 32)) + .5) * side_,
                                   (double(std::int32_t(s)) + .5) * side_);
      return CGAL::bounded_side_2(hull_.begin(), hull_.end(), center) != CGAL::ON_UNBOUNDED_SIDE;
    };
    return double(std::count_if(squares_.begin(), squares_.end(), is_in)) * side_ * side_;
  }

private:
  using Square = std::uint64_t; // row and column
  static constexpr int rounds = 4;
  static constexpr double points_in_a_square = 8; // on average: where the points are sparse there is one, too

  explicit Plane_coverage(const Coefficients& plane) : plane_(plane), normal_(plane[0], plane[1], plane[2])
  {
    const Vector axis = Kernel::Plane_3(plane[0], plane[1], plane[2], plane[3]).base1();
    first_ = axis / std::sqrt(axis.squared_length());
    second_ = CGAL::cross_product(normal_, first_);
  }

  void set_hull(const std::vector<Point>& corners)
  {
    origin_ = corners.front() - height(corners.front()) * normal_;
    std::vector<Kernel::Point_2> flat_corners;
    for(const Point& p : corners)
      flat_corners.push_back(flat(p));
    CGAL::convex_hull_2(flat_corners.begin(), flat_corners.end(), std::back_inserter(hull_));
  }

  static double largest_extent(const std::vector<Kernel::Point_2>& points)
  {
    CGAL::Bbox_2 box;
    for(const Kernel::Point_2& p : points)
      box += p.bbox();
    return (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  }

  Square square_of(const Kernel::Point_2& p) const
  {
    const double largest = 1 << 30; // of what is far away
    const auto index = [&](double x) {
      return std::uint32_t(std::int32_t((std::max)(-largest, (std::min)(largest, std::floor(x / side_)))));
    };
    return Square(index(p.x())) << 32 | index(p.y());
  }

  void mark(const std::vector<Kernel::Point_2>& points)
  {
    squares_.clear();
    for(const Kernel::Point_2& p : points)
      squares_.insert(square_of(p));
  }

  Coefficients plane_;
  Vector normal_, first_, second_;
  Point origin_;
  double side_ = 0; // of a square
  std::vector<Point> points_;
  std::unordered_set<Square> squares_;
  CGAL::Bbox_2 box_; // of the squares
  std::vector<Kernel::Point_2> hull_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_PLANE_COVERAGE_H
