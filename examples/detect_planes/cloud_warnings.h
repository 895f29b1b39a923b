// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is wrong with the coordinates of a cloud, as far as they tell: a sentence each, with what to do.

#ifndef DETECT_PLANES_CLOUD_WARNINGS_H
#define DETECT_PLANES_CLOUD_WARNINGS_H

#include "coordinate_steps.h"
#include "input/input_settings.h"
#include "input/point_set.h"
#include "output/report.h"
#include "ranks/Ranks.h"
#include "sentence.h"
#include "tolerance/zeros.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace program {

// More points than few_zeros at 0 0 0 where nothing else is near, or than many_zeros there anyway, are no measurements.
constexpr long long few_zeros = 3, many_zeros = 100;
// What is near 0 0 0, as a share of the extent.
constexpr double near_zero = .01;
// A degree has 111 km: heights are larger, compared with an extent in degrees, wherever the ground rises by 1 in 1000.
constexpr double smallest_height_in_degrees = 100;
// Steps that are a larger share of the tolerance of points cut surfaces into strips.
constexpr double largest_step_in_tolerance = .25;

// The box of the points that are finite and not at 0 0 0, and the number of those at 0 0 0; of all ranks.
struct Cloud_box {
  std::array<double, 3> low, high; // infinite, with low > high, where there are no points
  long long zeros = 0;

  double side(std::size_t c) const { return high[c] - low[c]; }
  double extent() const { return (std::max)({side(0), side(1), side(2)}); }
};

inline Cloud_box box_of(const Point_set& points, const Ranks& ranks)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Cloud_box box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for(Point_set::Index i : points) {
    const Kernel::Point_3& p = points.point(i);
    if(is_zero(p))
      ++box.zeros;
    for(int c = 0; c < 3 && is_finite(p) && !is_zero(p); ++c) {
      box.low[std::size_t(c)] = (std::min)(box.low[std::size_t(c)], p[c]);
      box.high[std::size_t(c)] = (std::max)(box.high[std::size_t(c)], p[c]);
    }
  }
  for(std::size_t c = 0; c < 3; ++c) {
    box.low[c] = -ranks.largest(-box.low[c]);
    box.high[c] = ranks.largest(box.high[c]);
  }
  box.zeros = ranks.sums({box.zeros})[0];
  return box;
}

inline bool are_zeros_strange(const Cloud_box& box)
{
  const double margin = near_zero * box.extent();
  bool is_outside = false;
  for(std::size_t c = 0; c < 3; ++c)
    is_outside = is_outside || box.low[c] > margin || box.high[c] < -margin;
  return box.zeros > (is_outside ? few_zeros : many_zeros);
}

inline std::string advice_on_zeros(const Cloud_box& box)
{
  return sentence(box.zeros, " points are exactly at 0 0 0, as invalid pixels are: --ignore-zeros leaves them out");
}

inline bool look_like_degrees(const Cloud_box& box)
{
  const bool are_in_range = box.low[0] >= -180 && box.high[0] <= 180 && box.low[1] >= -90 && box.high[1] <= 90;
  const double side = (std::max)(box.side(0), box.side(1));
  return are_in_range && box.side(0) > 0 && box.side(1) > 0 && side < 1 &&
         box.side(2) > smallest_height_in_degrees * side;
}

inline std::string warning_of_degrees(const Cloud_box& box)
{
  return sentence("the coordinates look like degrees of longitude and latitude (x, y and z extend over ", box.side(0),
                  ", ", box.side(1), " and ", box.side(2), "): ", advice_on_degrees);
}

inline std::string warning_of_steps(const Point_set& points, double tolerance, const Ranks& ranks)
{
  const Coordinate_steps steps = find_steps(points, largest_step_in_tolerance * tolerance, ranks);
  std::string axes;
  for(std::size_t c = 0; c < 3; ++c)
    if(steps.of_axis[c] > 0)
      axes += sentence(axes.empty() ? "" : ", ", "xyz"[c], " in steps of ", steps.of_axis[c]);
  if(axes.empty())
    return {};
  return sentence("the coordinates are rounded, ", axes, ", while the tolerance of points is ", tolerance,
                  steps.are_floats
                    ? ": write doubles, or subtract an offset before they become floats, which have 24 bits"
                    : ": write more digits");
}

// tolerance: the mean of those of points.
inline std::vector<std::string> cloud_warnings(const Point_set& points, const Cloud_box& box, double tolerance,
                                               const Ranks& ranks)
{
  std::vector<std::string> warnings;
  if(are_zeros_strange(box))
    warnings.push_back(advice_on_zeros(box));
  if(look_like_degrees(box))
    warnings.push_back(warning_of_degrees(box));
  const std::string steps = tolerance > 0 ? warning_of_steps(points, tolerance, ranks) : "";
  if(!steps.empty())
    warnings.push_back(steps);
  return warnings;
}

} // namespace program

#endif // DETECT_PLANES_CLOUD_WARNINGS_H
