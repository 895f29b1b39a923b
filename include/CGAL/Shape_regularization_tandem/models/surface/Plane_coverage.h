// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A plane with the part that its points cover, and the part that a wall without points is assumed to cover.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_PLANE_COVERAGE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_PLANE_COVERAGE_H

#include <CGAL/Tandem/Parameters.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;

// Of a point above a plane.
inline double height(const Coefficients& c, const Point& p)
{
  return c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3];
}

// --- The part of a plane that points cover: the squares of a grid that have points

class Covered_squares {
public:
  Covered_squares() = default;

  // What is nearer to each other than the resolution is one place, so that copies of points change nothing.
  Covered_squares(const std::vector<Kernel::Point_2>& points, double resolution)
  {
    for(const Kernel::Point_2& p : points)
      box_ += p.bbox();
    const double extent = (std::max)(box_.xmax() - box_.xmin(), box_.ymax() - box_.ymin());
    if(!(extent > 0))
      return;
    size_ = (std::max)(resolution, extent / most_squares_across);
    mark(points);
    const double places = double(squares_.size());
    size_ = extent / 8;
    for(int round = 0; round < rounds; ++round) {
      mark(points);
      size_ = std::sqrt(places_in_a_square * double(squares_.size()) * size_ * size_ / places);
    }
    mark(points);
    box_ = CGAL::Bbox_2(box_.xmin() - size_, box_.ymin() - size_, box_.xmax() + size_, box_.ymax() + size_);
  }

  bool has(const Kernel::Point_2& p) const
  {
    return p.x() >= box_.xmin() && p.x() <= box_.xmax() && p.y() >= box_.ymin() && p.y() <= box_.ymax() &&
           squares_.count(square_of(p)) > 0;
  }

  // The points of a square share its area. Squares stand out at the edges of the points: those whose center is beyond
  // the convex hull have none.
  double area_of_point(const Kernel::Point_2& p, const std::vector<Kernel::Point_2>& hull) const
  {
    if(!(size_ > 0))
      return 0;
    const auto square = squares_.find(square_of(p));
    const Kernel::Point_2 center((std::floor(p.x() / size_) + .5) * size_, (std::floor(p.y() / size_) + .5) * size_);
    if(square == squares_.end() || CGAL::bounded_side_2(hull.begin(), hull.end(), center) == CGAL::ON_UNBOUNDED_SIDE)
      return 0;
    return size_ * size_ / square->second;
  }

private:
  using Square = std::uint64_t; // column and row
  static constexpr int rounds = 4;
  static constexpr double places_in_a_square = 8; // on average, so that a square between sparse points has one, too
  static constexpr double most_squares_across = 1 << 30;

  Square square_of(const Kernel::Point_2& p) const
  {
    const auto index = [&](double x) { return std::uint32_t(std::int32_t(std::floor(x / size_))); };
    return Square(index(p.x())) << 32 | index(p.y());
  }

  void mark(const std::vector<Kernel::Point_2>& points)
  {
    squares_.clear();
    for(const Kernel::Point_2& p : points)
      ++squares_[square_of(p)];
  }

  double size_ = 0;                         // width of a square
  std::unordered_map<Square, int> squares_; // with the number of their points
  CGAL::Bbox_2 box_;
};

// Whether an edge of one convex polygon, which is counterclockwise, separates the other one by more than a distance.
inline bool separates(const std::vector<Kernel::Point_2>& a, const std::vector<Kernel::Point_2>& b, double distance)
{
  for(std::size_t i = 0; i < a.size(); ++i) {
    const Kernel::Vector_2 edge = a[(i + 1) % a.size()] - a[i];
    const auto is_beyond = [&](const Kernel::Point_2& p) {
      return CGAL::determinant(edge, p - a[i]) < -distance * std::sqrt(edge.squared_length());
    };
    if(std::all_of(b.begin(), b.end(), is_beyond))
      return true;
  }
  return false;
}

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

  double height(const Point& p) const { return surface::height(plane_, p); }

  bool is_in_hull(const Point& p) const { return is_in(hull_, flat(p)); }
  bool is_near_hull(const Point& p, double distance) const { return !separates(hull_, {flat(p)}, distance); }

  bool is_assumed(const Point& p) const { return is_assumed(flat(p)); }
  double area_of_point(std::size_t i) const { return areas_[i]; } // its part of the covered area

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

// --- Which side of an area is inside. A ray that leaves the area upwards crosses what points cover an odd number of times
// if it leaves to the inside, an even number of times if to the outside. So normals need no orientation, and neither
// floors nor the ground below a building need points. A ray that crosses a wall without points says nothing.

class Ray_votes {
public:
  explicit Ray_votes(const Vector& up)
  {
    const Vector axis = Kernel::Plane_3(CGAL::ORIGIN, up).base1();
    const Vector first = axis / std::sqrt(axis.squared_length()), second = CGAL::cross_product(up, first);
    constexpr double golden_angle = 2.399963; // neighbors on the spiral are far apart
    for(int i = 0; i < number_of_rays; ++i) { // evenly over the upper half of the sphere, on a spiral, along no axis
      const double z = 1 - (i + .5) / number_of_rays, radius = std::sqrt(1 - z * z), angle = golden_angle * i;
      directions_.push_back(radius * std::cos(angle) * first + radius * std::sin(angle) * second + z * up);
    }
  }

  // Rays that leave one of them do not cross it.
  void add_obstacles(const std::vector<Plane_coverage>& planes)
  {
    for(const Plane_coverage& plane : planes)
      planes_.push_back(&plane);
  }

  // Of rays from these places of one of the planes, the ratio that says that the front is outside and what is behind
  // inside, less the ratio that says the opposite.
  double balance(const std::vector<Point>& places, const Vector& to_front, const Plane_coverage& plane) const
  {
    constexpr std::size_t step = 97; // odd, so that all directions occur, and in no order
    if(places.empty())
      return 0;
    int sum = 0;
    for(std::size_t r = 0; r < directions_.size(); ++r) {
      const Vector& direction = directions_[r * step % directions_.size()];
      const int inside = votes(places[r * places.size() / directions_.size()], direction, plane);
      sum += direction * to_front > 0 ? -inside : inside;
    }
    return sum / double(directions_.size());
  }

private:
  static constexpr int number_of_rays = 256;

  // Where a ray leaves to: 1 is inside, -1 outside, 0 unknown.
  int votes(const Point& start, const Vector& direction, const Plane_coverage& own) const
  {
    int result = -1;
    for(const Plane_coverage* plane : planes_) {
      if(plane == &own)
        continue;
      const Plane_coverage::Crossing crossing = plane->crossing(start, direction);
      if(crossing == Plane_coverage::Crossing::assumed)
        return 0;
      if(crossing == Plane_coverage::Crossing::covered)
        result = -result;
    }
    return result;
  }

  std::vector<const Plane_coverage*> planes_;
  std::vector<Vector> directions_;
};

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_PLANE_COVERAGE_H
