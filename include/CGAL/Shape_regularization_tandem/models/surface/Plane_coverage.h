// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A plane with the part that outlines of shapes cover, and the part that a wall without points is assumed to cover.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_PLANE_COVERAGE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_PLANE_COVERAGE_H

#include <CGAL/Tandem/Parameters.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Flat_polygon = std::vector<Kernel::Point_2>;

// Of a point above a plane.
inline double height(const Coefficients& c, const Point& p)
{
  return std::fma(c[0], p.x(), std::fma(c[1], p.y(), std::fma(c[2], p.z(), c[3])));
}

// Where a linear function is 0 that is a at p and b, of the other sign, at q.
template <class Any_point>
Any_point zero_between(const Any_point& p, double a, const Any_point& q, double b)
{
  return p + a / (a - b) * (q - p);
}

inline double extent_of(const CGAL::Bbox_3& box)
{
  return (std::max)({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()});
}

// Places in a box that are closer are one.
inline double resolution_of(const CGAL::Bbox_3& box) { return 1e-7 * extent_of(box); }

// --- Convex polygons, counterclockwise

// Of the point to the left of an edge.
inline double distance_to_left(const Kernel::Point_2& first, const Kernel::Point_2& last, const Kernel::Point_2& p)
{
  const Kernel::Vector_2 edge = last - first;
  return CGAL::determinant(edge, p - first) / std::sqrt(edge.squared_length());
}

// Whether an edge of one separates the other one by more than a distance.
inline bool separates(const Flat_polygon& a, const Flat_polygon& b, double distance)
{
  for(std::size_t i = 0; i < a.size(); ++i) {
    const auto is_beyond = [&](const Kernel::Point_2& p) {
      return distance_to_left(a[i], a[(i + 1) % a.size()], p) < -distance;
    };
    if(std::all_of(b.begin(), b.end(), is_beyond))
      return true;
  }
  return false;
}

// What they have in common; empty if that has no area.
inline Flat_polygon common_part(Flat_polygon part, const Flat_polygon& other)
{
  for(std::size_t i = 0; i < other.size() && part.size() > 2; ++i) {
    Flat_polygon left;
    for(std::size_t j = 0; j < part.size(); ++j) {
      const Kernel::Point_2 &p = part[j], &q = part[(j + 1) % part.size()];
      const double a = distance_to_left(other[i], other[(i + 1) % other.size()], p),
                   b = distance_to_left(other[i], other[(i + 1) % other.size()], q);
      if(a >= 0)
        left.push_back(p);
      if((a < 0) != (b < 0))
        left.push_back(zero_between(p, a, q, b));
    }
    part = std::move(left);
  }
  return part.size() > 2 ? part : Flat_polygon();
}

inline double area_of(const Flat_polygon& polygon)
{
  return CGAL::polygon_area_2(polygon.begin(), polygon.end(), Kernel());
}

// --- A plane

class Plane_coverage {
public:
  using Corners = std::vector<Point>; // of a convex polygon

  // A plane that no points are close to.
  explicit Plane_coverage(const Coefficients& plane) : plane_(plane)
  {
    const Vector axis = Kernel::Plane_3(plane[0], plane[1], plane[2], plane[3]).base1();
    first_ = axis / std::sqrt(axis.squared_length());
    second_ = CGAL::cross_product(normal(), first_);
  }

  // With the points that are close to it. Their order does not matter.
  Plane_coverage(const Coefficients& plane, std::vector<Point> points) : Plane_coverage(plane)
  {
    points_ = std::move(points);
    reach(points_);
  }

  // The hull of these points, too, which are close to the plane.
  void reach(const std::vector<Point>& points)
  {
    if(hull_.empty())
      origin_ = *std::min_element(points.begin(), points.end());
    Flat_polygon all = hull_, hull;
    for(const Point& p : points)
      all.push_back(flat(p));
    CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(hull));
    hull_ = std::move(hull);
  }

  // Points cover this part of the plane.
  void cover(const Corners& part) { covered_.push_back(part); }
  // There is a wall without points in this part of the hull.
  void assume(const Corners& part) { assumed_.push_back(part); }

  const Coefficients& plane() const { return plane_; }
  Vector normal() const { return Vector(plane_[0], plane_[1], plane_[2]); }
  const std::vector<Point>& points() const { return points_; }
  const Flat_polygon& hull() const { return hull_; }
  // Of what is within a distance of the hull.
  CGAL::Bbox_3 box(double distance) const
  {
    CGAL::Bbox_3 result;
    for(const Kernel::Point_2& p : hull_)
      result += lifted(p).bbox();
    return {result.xmin() - distance, result.ymin() - distance, result.zmin() - distance,
            result.xmax() + distance, result.ymax() + distance, result.zmax() + distance};
  }
  const std::vector<Corners>& covered() const { return covered_; }
  const std::vector<Corners>& assumed() const { return assumed_; }

  // Points on a line have none.
  bool has_area() const { return hull_.size() > 2 && area_of(hull_) > 0; }

  Kernel::Point_2 flat(const Point& p) const
  {
    return Kernel::Point_2((p - origin_) * first_, (p - origin_) * second_);
  }

  // Of a convex polygon in the plane; counterclockwise.
  Flat_polygon flat(const Corners& corners) const
  {
    Flat_polygon result;
    for(const Point& p : corners)
      result.push_back(flat(p));
    if(area_of(result) < 0)
      std::reverse(result.begin(), result.end());
    return result;
  }

  Point lifted(const Kernel::Point_2& p) const
  {
    const Point q = origin_ + p.x() * first_ + p.y() * second_;
    return q - height(q) * normal();
  }

  double height(const Point& p) const { return surface::height(plane_, p); }

  bool is_covered(const Point& p) const
  {
    const Kernel::Point_2 q = flat(p);
    return std::any_of(covered_.begin(), covered_.end(),
                       [&](const Corners& part) { return !separates(flat(part), {q}, 0); });
  }

  bool is_near_hull(const Point& p, double distance) const { return !separates(hull_, {flat(p)}, distance); }

private:
  Coefficients plane_;
  Vector first_, second_;
  Point origin_ = CGAL::ORIGIN;
  std::vector<Point> points_;
  std::vector<Corners> covered_, assumed_;
  Flat_polygon hull_;
};

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_PLANE_COVERAGE_H
