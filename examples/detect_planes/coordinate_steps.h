// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps that coordinates come in, where digits of them were lost.

#ifndef DETECT_PLANES_COORDINATE_STEPS_H
#define DETECT_PLANES_COORDINATE_STEPS_H

#include "input/point_set.h"
#include "output/write_results.h"
#include "ranks/Ranks.h"
#include "tolerance/zeros.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace program {

// Points that are looked at for steps that are no powers of two.
constexpr std::size_t sampled_for_steps = std::size_t(1) << 16;
// Fewer different coordinates may be those of a few planes.
constexpr std::size_t least_values = 6;
// Cells as wide as a step have as many points where those were rounded. On a raster they have one.
constexpr std::size_t least_points_in_cell = 4;

struct Coordinate_steps {
  std::array<double, 3> of_axis = {0, 0, 0}; // 0: finer than asked for, or none
  bool are_floats = false;                   // all that are found are those of floats
};

inline bool is_measured(const Kernel::Point_3& p) { return is_finite(p) && !is_zero(p); }

// The largest power of two of which x is a multiple; x is not 0.
inline double unit_of(double x)
{
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  while(mantissa != std::floor(mantissa)) {
    mantissa *= 2;
    --exponent;
  }
  return std::ldexp(1., exponent);
}

// The step of floats, where all coordinates are some and have no finer step than the largest of them has; 0 if that
// is not above `least`. Integers and rasters have larger ones.
inline double step_of_floats(const Point_set& points, int axis, double least, const Ranks& ranks)
{
  double step = std::numeric_limits<double>::infinity(), largest = 0;
  std::optional<double> first;
  for(auto i = points.begin(); i != points.end() && step > 0; ++i) {
    if(!is_measured(points.point(*i)))
      continue;
    const double x = points.point(*i)[axis];
    first = first.value_or(x);
    if(x != *first)
      step = (std::min)(step, unit_of(x - *first));
    if(!fits_float(x) || step <= least)
      step = 0;
    largest = (std::max)(largest, std::fabs(x));
  }
  step = -ranks.largest(-step);
  largest = ranks.largest(largest);
  const double unit = largest > 0 ? std::ldexp(1., std::ilogb(largest) - 23) : 0;
  return step > least && step <= unit ? step : 0;
}

// The common step of sorted, different coordinates, 0 if there is none above `least`.
inline double common_step(const std::vector<double>& values, double least)
{
  constexpr double largest_error = .01; // of numbers that are written with decimal digits
  double step = std::numeric_limits<double>::infinity();
  for(std::size_t i = 1; i < values.size(); ++i)
    step = (std::min)(step, values[i] - values[i - 1]);
  if(values.size() < least_values || step <= least)
    return 0;
  for(double x : values)
    if(std::fabs((x - values[0]) / step - std::round((x - values[0]) / step)) > largest_error)
      return 0;
  return step;
}

template <class T>
std::size_t remove_copies(std::vector<T>& values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values.size();
}

// How many different points a cell of that width has.
inline std::size_t points_in_cell(const std::array<std::vector<double>, 3>& values, double width)
{
  std::vector<std::array<double, 3>> points, cells;
  for(std::size_t i = 0; i < values[0].size(); ++i) {
    points.push_back({values[0][i], values[1][i], values[2][i]});
    cells.push_back(points.back());
    for(double& x : cells.back())
      x = std::floor(x / width);
  }
  return points.empty() ? 0 : remove_copies(points) / remove_copies(cells);
}

// Steps above `least`: those of floats, and others where points lie closer to each other than that.
inline Coordinate_steps find_steps(const Point_set& points, double least, const Ranks& ranks)
{
  Coordinate_steps steps;
  for(int c = 0; c < 3; ++c)
    steps.of_axis[std::size_t(c)] = step_of_floats(points, c, least, ranks);
  steps.are_floats = steps.of_axis != std::array<double, 3>{0, 0, 0};
  if(steps.are_floats)
    return steps;
  std::array<std::vector<double>, 3> values;
  for(auto i = points.begin(); i != points.end() && values[0].size() < sampled_for_steps; ++i)
    for(int c = 0; c < 3 && is_measured(points.point(*i)); ++c)
      values[std::size_t(c)].push_back(points.point(*i)[c]);
  for(std::size_t c = 0; c < 3; ++c) {
    std::vector<double> sorted = values[c];
    remove_copies(sorted);
    const double step = common_step(sorted, least);
    const bool is_lost = step > 0 && points_in_cell(values, step) >= least_points_in_cell;
    steps.of_axis[c] = ranks.largest(is_lost ? step : 0);
  }
  return steps;
}

} // namespace program

#endif // DETECT_PLANES_COORDINATE_STEPS_H
