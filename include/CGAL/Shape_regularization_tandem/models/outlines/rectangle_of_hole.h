// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Holes of windows and doors as rectangles.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_RECTANGLE_OF_HOLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_RECTANGLE_OF_HOLE_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Border_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// A rectangle with sides of a given direction, at the medians of the points that are closest to each.
class Fitted_rectangle {
public:
  Fitted_rectangle(const Border_points& border, const Kernel::Vector_2& direction)
    : border(border), axes{direction, direction.perpendicular(CGAL::COUNTERCLOCKWISE)}
  {
    for(const Outline_vertex& v : border.all_points())
      for(std::size_t k = 0; k < 2; ++k)
        ranges[k].add((v.point - CGAL::ORIGIN) * axes[k]);
    for(int round = 0; round < rounds; ++round)
      fit();
  }

  // The points are as close to it as to edges of other outlines.
  bool fits() const
  {
    double sum = 0;
    for(const Outline_vertex& v : border.all_points()) {
      const double d = distance(v.point) / v.spacing;
      if(!(d <= largest_distance))
        return false;
      sum += d;
    }
    return sum <= border.tolerance / 2 * double(border.all_points().size()) && ranges[0].low < ranges[0].high &&
           ranges[1].low < ranges[1].high;
  }

  // Clockwise.
  Outline_loop loop() const
  {
    const Range &x = ranges[0], &y = ranges[1];
    Outline_loop result;
    for(const auto& [a, b] :
        {std::array<double, 2>{x.low, y.low}, {x.low, y.high}, {x.high, y.high}, {x.high, y.low}}) {
      const Kernel::Point_2 p = CGAL::ORIGIN + a * axes[0] + b * axes[1];
      result.push_back({p, border.vertex(0).spacing, false, {}, p});
    }
    return result;
  }

private:
  using Range = Border_points::Range;
  static constexpr int rounds = 3;
  static constexpr double largest_distance = 1.5; // of a point, in spacings

  std::array<double, 4> distances_to_sides(const Kernel::Point_2& p) const
  {
    const double x = (p - CGAL::ORIGIN) * axes[0], y = (p - CGAL::ORIGIN) * axes[1];
    return {x - ranges[0].low, ranges[0].high - x, y - ranges[1].low, ranges[1].high - y};
  }

  void fit()
  {
    std::array<std::vector<double>, 4> of_sides;
    for(const Outline_vertex& v : border.all_points()) {
      const std::array<double, 4> d = distances_to_sides(v.point);
      const std::size_t side = std::size_t(
        std::min_element(d.begin(), d.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
        d.begin());
      of_sides[side].push_back((v.point - CGAL::ORIGIN) * axes[side / 2]);
    }
    for(std::size_t side = 0; side < 4; ++side) {
      std::vector<double>& all = of_sides[side];
      if(all.empty())
        continue;
      std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
      (side % 2 == 0 ? ranges[side / 2].low : ranges[side / 2].high) = all[all.size() / 2];
    }
  }

  double distance(const Kernel::Point_2& p) const
  {
    const std::array<double, 4> d = distances_to_sides(p);
    const double inside = *std::min_element(d.begin(), d.end());
    if(inside >= 0)
      return inside;
    return std::hypot((std::max)({-d[0], -d[1], 0.}), (std::max)({-d[2], -d[3], 0.}));
  }

  const Border_points& border;
  std::array<Kernel::Vector_2, 2> axes;
  Range ranges[2];
};

// Empty if there is none. Directions come in pairs.
inline Outline_loop rectangle_of_hole(const Border_points& border, const std::vector<Kernel::Vector_2>& directions)
{
  const Outline_loop& hole = border.loop();
  if(twice_area(hole) >= 0 || std::any_of(hole.begin(), hole.end(), [](const Outline_vertex& v) { return v.stays(); }))
    return {};
  for(std::size_t d = 0; d < directions.size(); d += 2) {
    const Fitted_rectangle rectangle(border, directions[d]);
    if(rectangle.fits())
      return rectangle.loop();
  }
  return {};
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_RECTANGLE_OF_HOLE_H
