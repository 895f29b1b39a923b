// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why a result is empty or poor, as far as its figures tell: a sentence each, with the option to change.

#ifndef DETECT_PLANES_RESULT_WARNINGS_H
#define DETECT_PLANES_RESULT_WARNINGS_H

#include "output/write_results.h"
#include "ranks/Ranks.h"

#include <CGAL/Shape_regularization_tandem/estimate_noise.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <new>
#include <sstream>
#include <string>
#include <vector>

namespace program {

constexpr double poor_coverage = .2;
constexpr double largest_share_of_extent = .1; // of the maximum distance
constexpr double smallest_share_of_noise = .1;
// Points that are thicker than the maximum distance fill it, so that their mean distance is half of it.
constexpr double full_share = .4;

// The longest side of the box of all points; negative if there are none.
inline double extent_of(const Point_set& points, const Ranks& ranks)
{
  const double infinity = std::numeric_limits<double>::infinity();
  double high[3] = {-infinity, -infinity, -infinity}, low[3] = {infinity, infinity, infinity}, extent = -1;
  for(Point_set::Index i : points)
    if(is_finite(points.point(i)))
      for(int c = 0; c < 3; ++c) {
        high[c] = (std::max)(high[c], points.point(i)[c]);
        low[c] = (std::min)(low[c], points.point(i)[c]);
      }
  for(int c = 0; c < 3; ++c)
    extent = (std::max)(extent, ranks.largest(high[c]) + ranks.largest(-low[c]));
  return extent;
}

// measure(): the noise of the own points. The smallest of the ranks, infinite where there is no memory to measure it, as
// the shapes are worth more, and where all points are one.
template <class Measure>
double smallest_noise(const Measure& measure, const Ranks& ranks)
{
  double own = 0;
  try {
    own = measure();
  } catch(const std::bad_alloc&) {
  }
  return -ranks.largest(own > 0 ? -own : -std::numeric_limits<double>::infinity());
}

// Infinite where planes explain the points, which need not be measured then.
inline double noise_of(const Point_set& points, const Shapes& shapes, const Ranks& ranks)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  const bool is_thin = s.number_of_shapes > 0 && s.coverage >= poor_coverage &&
                       s.mean_distance < full_share * shapes.parameters().maximum_distance;
  return smallest_noise([&] { return is_thin || points.empty() ? 0. : CGAL::Tandem::estimate_noise(points); }, ranks);
}

template <class... Words>
std::string sentence(const Words&... words)
{
  std::ostringstream text;
  text << std::setprecision(4);
  (text << ... << words);
  return text.str();
}

inline std::string why_empty(const CGAL::Tandem::Statistics& s, const CGAL::Tandem::Parameters& p)
{
  const std::size_t points = s.number_of_points - s.number_of_ignored_points();
  if(points < p.minimum_region_size)
    return sentence("no shape was found: the number of points is ", points, ", and a shape has at least ",
                    p.minimum_region_size, " (--minimum-region-size)");
  return sentence("no shape was found: no ", p.minimum_region_size,
                  " connected points (--minimum-region-size), other than on a line or in one place, are within ",
                  p.maximum_distance, " of a plane (--maximum-distance) and ", p.maximum_angle,
                  " degrees (--maximum-angle)");
}

// Of the whole run, on all ranks.
inline std::vector<std::string> result_warnings(const Point_set& points, const Shapes& shapes, bool is_distance_given,
                                                const Ranks& ranks)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const double extent = extent_of(points, ranks);
  const double noise = is_distance_given ? noise_of(points, shapes, ranks) : 0; // else the distance is twice the noise
  std::vector<std::string> warnings;
  if(s.number_of_shapes == 0)
    warnings.push_back(why_empty(s, p));
  else if(s.coverage < poor_coverage)
    warnings.push_back(sentence("only ", 100 * s.coverage,
                                " % of the points are in shapes: a larger --maximum-distance "
                                "than ",
                                p.maximum_distance, ", or a smaller --minimum-region-size than ", p.minimum_region_size,
                                ", takes more"));
  if(extent > 0 && p.maximum_distance > largest_share_of_extent * extent)
    warnings.push_back(sentence("the maximum distance ", p.maximum_distance,
                                " is more than a tenth of the extent of the points, ", extent,
                                ": a smaller --maximum-distance keeps planes apart"));
  if(p.maximum_distance < smallest_share_of_noise * noise && std::isfinite(noise))
    warnings.push_back(sentence("the maximum distance ", p.maximum_distance,
                                " is less than a tenth of the noise of the points, ", noise,
                                ": --maximum-distance should be two to three times the noise"));
  return warnings;
}

} // namespace program

#endif // DETECT_PLANES_RESULT_WARNINGS_H
