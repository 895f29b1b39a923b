// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a plane that points cover: the squares of a grid that have points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_COVERED_SQUARES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_COVERED_SQUARES_H

#include <CGAL/Shape_regularization_tandem/models/surface/Cells.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

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
    side_ = (std::max)(resolution, extent / most_squares_across);
    mark(points);
    const double places = double(squares_.size());
    side_ = extent / 8;
    for(int round = 0; round < rounds; ++round) {
      mark(points);
      side_ = std::sqrt(places_in_a_square * double(squares_.size()) * side_ * side_ / places);
    }
    mark(points);
    box_ = CGAL::Bbox_2(box_.xmin() - side_, box_.ymin() - side_, box_.xmax() + side_, box_.ymax() + side_);
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
    if(!(side_ > 0))
      return 0;
    const auto square = squares_.find(square_of(p));
    const Kernel::Point_2 center((std::floor(p.x() / side_) + .5) * side_, (std::floor(p.y() / side_) + .5) * side_);
    if(square == squares_.end() || CGAL::bounded_side_2(hull.begin(), hull.end(), center) == CGAL::ON_UNBOUNDED_SIDE)
      return 0;
    return side_ * side_ / square->second;
  }

private:
  using Square = std::uint64_t; // column and row
  static constexpr int rounds = 4;
  static constexpr double places_in_a_square = 8; // on average, so that a square between sparse points has one, too
  static constexpr double most_squares_across = 1 << 30;

  Square square_of(const Kernel::Point_2& p) const
  {
    const auto index = [&](double x) { return std::uint32_t(std::int32_t(std::floor(x / side_))); };
    return Square(index(p.x())) << 32 | index(p.y());
  }

  void mark(const std::vector<Kernel::Point_2>& points)
  {
    squares_.clear();
    for(const Kernel::Point_2& p : points)
      ++squares_[square_of(p)];
  }

  double side_ = 0;
  std::unordered_map<Square, int> squares_; // with the number of their points
  CGAL::Bbox_2 box_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_COVERED_SQUARES_H
