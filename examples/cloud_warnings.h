// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is wrong with a cloud or its result, as far as the figures tell: a sentence each, with what to do. Parameters have
// the names of the options of the program.

#ifndef TANDEM_EXAMPLES_CLOUD_WARNINGS_H
#define TANDEM_EXAMPLES_CLOUD_WARNINGS_H

#include "sentences.h"

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/Statistics.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <vector>

namespace tandem_examples {

// --- The steps that coordinates come in, where digits of them were lost.

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

template <class Point>
bool is_at_zero(const Point& p)
{
  return p.x() == 0 && p.y() == 0 && p.z() == 0;
}

template <class Point>
bool is_measured(const Point& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()) && !is_at_zero(p);
}

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
template <class Points, class Processes>
double step_of_floats(const Points& points, int axis, double least, const Processes& processes)
{
  double step = std::numeric_limits<double>::infinity(), largest = 0;
  std::optional<double> first;
  for(auto i = points.begin(); i != points.end() && step > 0; ++i) {
    if(!is_measured(*i))
      continue;
    const double x = (*i)[axis];
    first = first.value_or(x);
    if(x != *first)
      step = (std::min)(step, unit_of(x - *first));
    if(double(float(x)) != x || step <= least)
      step = 0;
    largest = (std::max)(largest, std::fabs(x));
  }
  step = -processes.largest(-step);
  largest = processes.largest(largest);
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
template <class Points, class Processes>
Coordinate_steps find_steps(const Points& points, double least, const Processes& processes)
{
  Coordinate_steps steps;
  for(int c = 0; c < 3; ++c)
    steps.of_axis[std::size_t(c)] = step_of_floats(points, c, least, processes);
  steps.are_floats = steps.of_axis != std::array<double, 3>{0, 0, 0};
  if(steps.are_floats)
    return steps;
  std::array<std::vector<double>, 3> values;
  for(auto i = points.begin(); i != points.end() && values[0].size() < sampled_for_steps; ++i)
    for(int c = 0; c < 3 && is_measured(*i); ++c)
      values[std::size_t(c)].push_back((*i)[c]);
  for(std::size_t c = 0; c < 3; ++c) {
    std::vector<double> sorted = values[c];
    remove_copies(sorted);
    const double step = common_step(sorted, least);
    const bool is_lost = step > 0 && points_in_cell(values, step) >= least_points_in_cell;
    steps.of_axis[c] = processes.largest(is_lost ? step : 0);
  }
  return steps;
}

// --- What is wrong with the coordinates of a cloud, as far as they tell: a sentence each, with what to do.

// More points than few_zeros at 0 0 0 where nothing else is near, or than many_zeros there anyway, are no measurements.
constexpr long long few_zeros = 3, many_zeros = 100;
// What is near 0 0 0, as a fraction of the extent.
constexpr double near_zero = .01;
// A degree has 111 km: heights are larger, compared with an extent in degrees, wherever the ground rises by 1 in 1000.
constexpr double smallest_height_in_degrees = 100;
// Steps that are a larger fraction of the tolerance of points cut surfaces into strips.
constexpr double largest_step_in_tolerance = .25;

// Of degrees in place of lengths.
constexpr const char* advice_on_degrees = "first project such coordinates, for example to UTM";

// The points of all ranks that are finite and not at 0 0 0, and the number of those at 0 0 0.
struct Cloud_box {
  CGAL::Bbox_3 box;
  long long zeros = 0;

  double side(int c) const { return box.max(c) - box.min(c); }
  double extent() const { return (std::max)({side(0), side(1), side(2)}); }
};

template <class Points, class Processes>
Cloud_box box_of(const Points& points, const Processes& processes)
{
  CGAL::Bbox_3 own;
  long long zeros = 0;
  for(const auto& p : points)
    if(is_at_zero(p))
      ++zeros;
    else if(is_measured(p))
      own += p.bbox();
  std::array<double, 6> sides;
  for(int c = 0; c < 3; ++c) {
    sides[std::size_t(c)] = -processes.largest(-own.min(c));
    sides[std::size_t(c) + 3] = processes.largest(own.max(c));
  }
  return {CGAL::Bbox_3(sides[0], sides[1], sides[2], sides[3], sides[4], sides[5]), processes.sums({zeros})[0]};
}

inline bool are_zeros_strange(const Cloud_box& box)
{
  const double margin = near_zero * box.extent();
  bool is_outside = false;
  for(int c = 0; c < 3; ++c)
    is_outside = is_outside || box.box.min(c) > margin || box.box.max(c) < -margin;
  return box.zeros > (is_outside ? few_zeros : many_zeros);
}

inline std::string advice_on_zeros(const Cloud_box& box)
{
  return sentence(box.zeros, " points are exactly at 0 0 0, like invalid pixels: --ignore-zeros leaves them out");
}

inline bool look_like_degrees(const Cloud_box& box)
{
  const bool are_in_range =
    box.box.xmin() >= -180 && box.box.xmax() <= 180 && box.box.ymin() >= -90 && box.box.ymax() <= 90;
  const double side = (std::max)(box.side(0), box.side(1));
  return are_in_range && box.side(0) > 0 && box.side(1) > 0 && side < 1 &&
         box.side(2) > smallest_height_in_degrees * side;
}

template <class Points, class Processes>
std::string warning_of_steps(const Points& points, double tolerance, const Processes& processes)
{
  const Coordinate_steps steps = find_steps(points, largest_step_in_tolerance * tolerance, processes);
  std::string axes;
  for(std::size_t c = 0; c < 3; ++c)
    if(steps.of_axis[c] > 0)
      axes += sentence(axes.empty() ? "" : ", ", "xyz"[c], " in steps of ", steps.of_axis[c]);
  if(axes.empty())
    return {};
  return sentence("the coordinates are rounded, ", axes, ", while the tolerance of points is ", tolerance,
                  steps.are_floats
                    ? ": use doubles, or subtract an offset before they become floats, which have 24 bits"
                    : ": use more digits");
}

// --- Why points are in no shape, in words, and the option that would change it.

struct Free_reason {
  std::size_t points;
  const char* name;   // they are ...
  const char* advice; // what to change
};

// What the statistics do not tell of free points.
struct Free_origin {
  bool has_given_normals = true; // those that the caller has; otherwise those that the caller has asked for
  std::size_t veil_points = 0;   // in shapes that are no surface; the statistics count them as not selected
};

// Those that points have, the most frequent first.
inline std::vector<Free_reason> free_reasons(const CGAL::Tandem::Statistics& s, const Free_origin& origin)
{
  const CGAL::Tandem::Free_points& f = s.free_points;
  std::vector<Free_reason> reasons = {
    {f.without_normal, "without a normal",
     "their neighbors are on a line, or --maximum-distance is larger than the objects: try a larger --k-neighbors or a "
     "smaller --maximum-distance"},
    {f.misaligned, "kept out by their normals",
     origin.has_given_normals ? "--estimate-normals mostly adds about as many to shapes"
                              : "--estimate-normals without a number mostly adds about as many to shapes"},
    {f.misfit, "just beyond the tolerances of a shape",
     "a larger --maximum-distance or --maximum-angle adds more of them"},
    {f.without_neighbors, "alone",
     "they are outliers, or --maximum-distance or --maximum-angle is too small for their noise"},
    {f.in_small_regions, "in small regions",
     s.line_spacing > 0 ? "a smaller --minimum-region-size adds more of them, but a face needs points of two scan lines"
                        : "a smaller --minimum-region-size adds more of them"},
    {f.clutter, "in clutter",
     s.has_estimated_normals || !origin.has_given_normals
       ? "they are on no surface, or --maximum-distance or --maximum-angle is too small for their noise"
       : "they are on no surface, --maximum-distance or --maximum-angle is too small for their noise, or their normals "
         "are wrong, such as with exchanged axes (--estimate-normals)"},
    {origin.veil_points, "in veils", "they are mixed pixels, edge-on to the sensor"},
    {f.unselected - origin.veil_points, "in shapes that were not selected",
     "the options of the selection leave them out"}};
  std::stable_sort(reasons.begin(), reasons.end(),
                   [](const Free_reason& a, const Free_reason& b) { return a.points > b.points; });
  while(!reasons.empty() && reasons.back().points == 0)
    reasons.pop_back();
  return reasons;
}

// --- Why a result is empty or poor, as far as its figures tell: a sentence each, with the option to change.

constexpr double poor_coverage = .2;
// Of all points. Fewer: what estimated normals add is often lost elsewhere.
constexpr double many_misaligned = .03;
constexpr double largest_distance_per_extent = .1; // of the maximum distance
constexpr double smallest_distance_per_noise = .1;
// Points that are thicker than the maximum distance fill it, so that their mean distance is half of it.
constexpr double full_fraction = .4;

// Of the points that could be in shapes. Pixels without a measurement could not. These are all at one place, so they are
// valid, or all are ignored for one reason, as far points are, and no other has as many points.
inline double ratio_in_shapes(const CGAL::Tandem::Statistics& s, const Cloud_box& box)
{
  const auto zeros = std::size_t(box.zeros);
  const bool are_valid =
    zeros > (std::max)({s.number_of_ignored_normals, s.number_of_ignored_tolerances, s.number_of_far_points});
  const std::size_t none = s.number_of_ignored_points() + (are_zeros_strange(box) && are_valid ? zeros : 0);
  return s.number_of_points > none ? double(s.number_of_assigned_points) / double(s.number_of_points - none) : 1;
}

// measure(): the noise of the own points. The smallest of the ranks, infinite where there is no memory to measure it, as
// the shapes are worth more, and where all points are one.
template <class Measure, class Processes>
double smallest_noise(const Measure& measure, const Processes& processes)
{
  double own = 0;
  try {
    own = measure();
  } catch(const std::bad_alloc&) {
  }
  return -processes.largest(own > 0 ? -own : -std::numeric_limits<double>::infinity());
}

inline std::string why_empty(const CGAL::Tandem::Statistics& s, const CGAL::Tandem::Parameters& p,
                             const char* tolerances, const Free_origin& origin)
{
  const std::size_t points = s.number_of_points - s.number_of_ignored_points();
  if(points == 0 && s.number_of_ignored_tolerances > 0)
    return sentence("no shape was found: none of ", s.number_of_ignored_tolerances,
                    " points has a positive tolerance (", tolerances, ')');
  if(points < p.minimum_region_size)
    return sentence("no shape was found: the number of points is ", points, ", but a shape has at least ",
                    p.minimum_region_size, " (--minimum-region-size)");
  return sentence(
    "no shape was found: no ", p.minimum_region_size,
    " connected points (--minimum-region-size), other than on a line or in one place, are within ", p.maximum_distance,
    " of a plane (--maximum-distance) and ", p.maximum_angle, " degrees (--maximum-angle)",
    origin.has_given_normals && !s.has_estimated_normals ? ", or the given normals are wrong (--estimate-normals)"
                                                         : "");
}

inline double percent(const CGAL::Tandem::Statistics& s, std::size_t points)
{
  return 100 * double(points) / double(s.number_of_points);
}

// There are free points. Ratios of all points, as those of the summary are.
inline std::string why_poor(const CGAL::Tandem::Statistics& s, const Free_origin& origin)
{
  const Free_reason reason = free_reasons(s, origin).at(0);
  return sentence("only ", percent(s, s.number_of_assigned_points), " % of the points are in shapes, and ",
                  percent(s, reason.points), " % are ", reason.name, ": ", reason.advice);
}

inline std::string why_misaligned(const CGAL::Tandem::Statistics& s)
{
  return sentence("given normals keep ", percent(s, s.free_points.misaligned),
                  " % of the points out of shapes on whose planes they are: --estimate-normals mostly adds about "
                  "as many to shapes");
}

// How a caller has asked for the shapes.
struct Asked_shapes {
  double mean_tolerance = 0;      // of the points; 0: no point has one
  bool is_distance_given = false; // one for all points
  const char* tolerances = "";    // what gives each point its own
  std::string planes_from = {};   // where known planes are from, which are the shapes
  Free_origin free = {};
};

// Of the points and shapes of all ranks, some of which may have no points. The function measures the noise of the own
// points.
template <class Points, class Shapes, class Measure, class Processes>
std::vector<std::string> cloud_warnings(const Points& points, const Shapes& shapes, const Asked_shapes& asked,
                                        const Measure& noise_of_points, const Processes& processes)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const Cloud_box box = box_of(points, processes);
  const double extent = box.extent();
  std::vector<std::string> warnings;
  if(are_zeros_strange(box))
    warnings.push_back(advice_on_zeros(box));
  if(look_like_degrees(box))
    warnings.push_back(sentence("the coordinates look like degrees of longitude and latitude (x, y and z extend over ",
                                box.side(0), ", ", box.side(1), " and ", box.side(2), "): ", advice_on_degrees));
  if(asked.mean_tolerance > 0)
    warnings.push_back(warning_of_steps(points, asked.mean_tolerance, processes));
  // The noise is infinite where planes explain the points, which need not be measured then. Estimates cover it.
  const bool is_thin =
    s.number_of_shapes > 0 && s.coverage >= poor_coverage && s.mean_distance < full_fraction * p.maximum_distance;
  const auto measure = [&] { return is_thin || points.size() == 0 ? 0. : noise_of_points(); };
  const double noise = asked.is_distance_given ? smallest_noise(measure, processes) : 0;
  const bool is_poor = ratio_in_shapes(s, box) < poor_coverage;
  if(!asked.planes_from.empty() && (is_poor || s.number_of_assigned_points == 0))
    warnings.push_back(sentence("only ", 100 * s.coverage, " % of the points are within the tolerances of a plane of ",
                                asked.planes_from,
                                ": a larger --maximum-distance or --maximum-angle adds more points, or the planes "
                                "belong to another cloud"));
  else if(s.number_of_shapes == 0)
    warnings.push_back(why_empty(s, p, asked.tolerances, asked.free));
  else if(is_poor && s.number_of_rounds > 0)
    warnings.push_back(why_poor(s, asked.free));
  else if(asked.free.has_given_normals &&
          double(s.free_points.misaligned) >= many_misaligned * double(s.number_of_points))
    warnings.push_back(why_misaligned(s));
  if(extent > 0 && p.maximum_distance > largest_distance_per_extent * extent)
    warnings.push_back(sentence("the maximum distance ", p.maximum_distance,
                                " is more than a tenth of the extent of the points, ", extent,
                                ": a smaller --maximum-distance keeps planes apart"));
  if(p.maximum_distance < smallest_distance_per_noise * noise && std::isfinite(noise))
    warnings.push_back(sentence("the maximum distance ", p.maximum_distance,
                                " is less than a tenth of the noise of the points, ", noise,
                                ": --maximum-distance should be two to three times the noise"));
  warnings.push_back(s.angle_note);
  warnings.erase(std::remove(warnings.begin(), warnings.end(), ""), warnings.end());
  return warnings;
}

} // namespace tandem_examples

#endif // TANDEM_EXAMPLES_CLOUD_WARNINGS_H
