// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a plane that its points cover: the squares of a grid that have points.

#ifndef DETECT_PLANES_PLANE_COVERAGE_H
#define DETECT_PLANES_PLANE_COVERAGE_H

#include "output/write_results.h"

#include <CGAL/Bbox_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <unordered_set>
#include <vector>

namespace program {

class Plane_coverage {
public:
  // The points are on the plane.
  Plane_coverage(const Kernel::Plane_3& plane, const std::vector<Kernel::Point_3>& points) : plane(plane)
  {
    const Kernel::Vector_3 normal = plane.orthogonal_vector();
    first = plane.base1() / std::sqrt(plane.base1().squared_length());
    second = CGAL::cross_product(normal, first) / std::sqrt(normal.squared_length());
    origin = points.front();
    std::vector<Kernel::Point_2> flat_points;
    for(const Kernel::Point_3& p : points)
      flat_points.push_back(flat(p));
    side = largest_extent(flat_points) / 8;
    for(int round = 0; round < rounds && side > 0; ++round) {
      mark(flat_points);
      side = std::sqrt(points_in_a_square * double(squares.size()) * area_of_square() / double(points.size()));
    }
    mark(flat_points);
    CGAL::convex_hull_2(flat_points.begin(), flat_points.end(), std::back_inserter(hull));
  }

  Kernel::Point_2 flat(const Kernel::Point_3& p) const
  {
    return Kernel::Point_2((p - origin) * first, (p - origin) * second);
  }

  bool is_covered(const Kernel::Point_3& p) const { return squares.count(square_of(flat(p))) > 0; }

  // Of a ray with the plane.
  bool is_crossed_where_covered(const Kernel::Point_3& start, const Kernel::Vector_3& direction) const
  {
    const double slope = plane.orthogonal_vector() * direction;
    const double height = plane.a() * start.x() + plane.b() * start.y() + plane.c() * start.z() + plane.d();
    return slope * height < 0 && is_covered(start - height / slope * direction);
  }

  double area_of_square() const { return side * side; }

  // Of those that are not beyond the convex hull of the points: squares stand out at the edges.
  std::vector<Kernel::Point_2> centers_of_squares() const
  {
    std::vector<Kernel::Point_2> result;
    for(const Square square : squares) {
      const Kernel::Point_2 center((double(std::int32_t(square >> 32)) + .5) * side,
                                   (double(std::int32_t(square)) + .5) * side);
      if(CGAL::bounded_side_2(hull.begin(), hull.end(), center) != CGAL::ON_UNBOUNDED_SIDE)
        result.push_back(center);
    }
    return result;
  }

private:
  using Square = std::uint64_t; // row and column
  static constexpr int rounds = 4;
  static constexpr double points_in_a_square = 8; // on average: where the points are sparse there is one, too

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
      return std::uint32_t(std::int32_t((std::max)(-largest, (std::min)(largest, std::floor(x / side)))));
    };
    return Square(index(p.x())) << 32 | index(p.y());
  }

  void mark(const std::vector<Kernel::Point_2>& points)
  {
    squares.clear();
    for(const Kernel::Point_2& p : points)
      squares.insert(square_of(p));
  }

  Kernel::Plane_3 plane;
  Kernel::Point_3 origin;
  Kernel::Vector_3 first, second;
  double side = 0;
  std::unordered_set<Square> squares;
  std::vector<Kernel::Point_2> hull;
};

} // namespace program

#endif // DETECT_PLANES_PLANE_COVERAGE_H
