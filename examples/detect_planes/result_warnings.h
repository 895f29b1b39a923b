// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why a result is empty or poor, as far as its figures tell: a sentence each, with the option to change.

#ifndef DETECT_PLANES_RESULT_WARNINGS_H
#define DETECT_PLANES_RESULT_WARNINGS_H

#include "cloud_warnings.h"
#include "output/free_points.h"
#include "output/write_results.h"
#include "ranks/Ranks.h"
#include "sentence.h"
#include "tolerance/Tolerances.h"

#include <CGAL/Shape_regularization_tandem/estimate_noise.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <vector>

namespace program {

constexpr double poor_coverage = .2;
constexpr double largest_share_of_extent = .1; // of the maximum distance
constexpr double smallest_share_of_noise = .1;
// Points that are thicker than the maximum distance fill it, so that their mean distance is half of it.
constexpr double full_share = .4;

// Of the points that could be in shapes. Pixels without a measurement could not. These are all at one place, so they are
// valid, or all are ignored for one reason, as far points are, and no other has as many points.
inline double share_in_shapes(const CGAL::Tandem::Statistics& s, const Cloud_box& box)
{
  const auto zeros = std::size_t(box.zeros);
  const bool are_valid =
    zeros > (std::max)({s.number_of_ignored_normals, s.number_of_ignored_tolerances, s.number_of_far_points});
  const std::size_t none = s.number_of_ignored_points() + (are_zeros_strange(box) && are_valid ? zeros : 0);
  return s.number_of_points > none ? double(s.number_of_assigned_points) / double(s.number_of_points - none) : 1;
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

inline std::string why_empty(const CGAL::Tandem::Statistics& s, const CGAL::Tandem::Parameters& p)
{
  const std::size_t points = s.number_of_points - s.number_of_ignored_points();
  if(points == 0 && s.number_of_ignored_tolerances > 0)
    return sentence("no shape was found: none of ", s.number_of_ignored_tolerances,
                    " points has a positive tolerance (--tolerance-column, --noise)");
  if(points < p.minimum_region_size)
    return sentence("no shape was found: the number of points is ", points, ", and a shape has at least ",
                    p.minimum_region_size, " (--minimum-region-size)");
  return sentence("no shape was found: no ", p.minimum_region_size,
                  " connected points (--minimum-region-size), other than on a line or in one place, are within ",
                  p.maximum_distance, " of a plane (--maximum-distance) and ", p.maximum_angle,
                  " degrees (--maximum-angle)");
}

// There are free points. Shares of all points, as those of the summary are.
inline std::string why_poor(const CGAL::Tandem::Statistics& s)
{
  const Free_reason reason = free_reasons(s.free_points).at(0);
  const auto percent = [&](std::size_t points) { return 100 * double(points) / double(s.number_of_points); };
  return sentence("only ", percent(s.number_of_assigned_points), " % of the points are in shapes, and ",
                  percent(reason.points), " % are ", reason.name, ": ", reason.advice);
}

// Of the whole run, on all ranks.
inline std::vector<std::string> result_warnings(const Point_set& points, const Shapes& shapes, const Cloud_box& box,
                                                bool is_distance_given, const Ranks& ranks)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const double extent = box.extent(), share = share_in_shapes(s, box);
  const double noise = is_distance_given ? noise_of(points, shapes, ranks) : 0; // estimates cover the noise
  std::vector<std::string> warnings;
  if(s.number_of_shapes == 0)
    warnings.push_back(why_empty(s, p));
  else if(share < poor_coverage && s.number_of_rounds > 0) // known planes may be a few of many
    warnings.push_back(why_poor(s));
  if(extent > 0 && p.maximum_distance > largest_share_of_extent * extent)
    warnings.push_back(sentence("the maximum distance ", p.maximum_distance,
                                " is more than a tenth of the extent of the points, ", extent,
                                ": a smaller --maximum-distance keeps planes apart"));
  if(p.maximum_distance < smallest_share_of_noise * noise && std::isfinite(noise))
    warnings.push_back(sentence("the maximum distance ", p.maximum_distance,
                                " is less than a tenth of the noise of the points, ", noise,
                                ": --maximum-distance should be two to three times the noise"));
  if(!s.angle_note.empty())
    warnings.push_back(with_options(s.angle_note));
  return warnings;
}

} // namespace program

#endif // DETECT_PLANES_RESULT_WARNINGS_H
