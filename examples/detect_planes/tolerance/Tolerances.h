// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tolerance of each point, where points have their own: a property of the cloud.

#ifndef DETECT_PLANES_TOLERANCES_H
#define DETECT_PLANES_TOLERANCES_H

#include "input/read_cloud.h"
#include "ranks/Ranks.h"
#include "output/report.h"

#include <CGAL/Shape_regularization_tandem/distance_of_noise.h>

namespace program {

using Tolerance_map = Point_set::Property_map<double>;

inline bool has_tolerance_of_each_point(const Options& o)
{
  return !o.tolerance_column.empty() || o.noise || o.has_local_distances;
}

// Where the tolerances come from.
inline std::string source_of_tolerances(const Options& o)
{
  if(!o.tolerance_column.empty())
    return "column " + o.tolerance_column;
  if(o.noise)
    return "noise " + o.noise_text;
  return o.has_local_distances ? "auto-local" : o.maximum_distance ? "given" : "estimated";
}

// The place from which the points of an input were seen, if it is known: that of the option, else that of the file.
// Writers that know none put the default into PCD files.
inline std::optional<Kernel::Point_3> viewpoint_of(const Options& o, const Input_part& part, bool takes_default)
{
  const std::optional<Viewpoint>& of_file = part.notes.viewpoint;
  if(!o.viewpoint && (!of_file || (of_file->is_default && !takes_default)))
    return std::nullopt;
  const std::array<double, 3>& place = o.viewpoint ? *o.viewpoint : of_file->place;
  return Kernel::Point_3(place[0], place[1], place[2]);
}

// The same with every compiler.
inline double range_of(const Kernel::Vector_3& v)
{
  return std::sqrt(std::fma(v.x(), v.x(), std::fma(v.y(), v.y(), v.z() * v.z())));
}

inline void set_tolerances_of_noise(const Options& o, Input_cloud& cloud)
{
  Tolerance_map tolerances = *find_property<double>(cloud.points, tolerance_name);
  for(const Input_part& part : cloud.parts) {
    if(part.first == part.last)
      continue;
    const std::optional<Kernel::Point_3> sensor = viewpoint_of(o, part, false);
    if(!sensor)
      throw_error(o.inputs[part.input],
                  (part.notes.viewpoint ? ": the VIEWPOINT is 0 0 0 1 0 0 0, which files have that know none"
                                        : ": has no place of the sensor"),
                  ": --noise needs it by --viewpoint X,Y,Z (0,0,0 if it is the origin)");
    for(Point_set::Index i : Point_part(cloud.points, part.first, part.last))
      tolerances[i] = CGAL::Tandem::distance_of_noise((*o.noise)(range_of(cloud.points.point(i) - *sensor)));
  }
}

// Of the column the reader has made the property already; where a rank has no points, it is empty. Those of auto-local
// come with the detection.
inline void prepare_tolerances(const Options& o, Input_cloud& cloud)
{
  if(!has_tolerance_of_each_point(o))
    return;
  cloud.points.add_property_map<double>(tolerance_name, 0.);
  if(o.noise)
    set_tolerances_of_noise(o, cloud);
}

// What the library says of an estimate, with the options in place of its words.
inline std::string with_options(std::string note)
{
  const std::pair<const char*, const char*> words[] = {
    {"maximum_distance", "--maximum-distance"},
    {"maximum_angle", "--maximum-angle"},
    {"angle_tolerance", "--angle-tolerance"},
    {"a tolerance for each point", "a tolerance for each point (--maximum-distance auto-local)"}};
  for(const auto& [word, option] : words)
    if(const std::size_t place = note.find(word); place != note.npos)
      note.replace(place, std::strlen(word), option);
  return note;
}

// No tolerance exceeds the maximum distance. The sum of all is one of integers, so that it does not depend on the ranks.
inline Tolerance_facts tolerance_facts(const Point_set& points, const Options& o, const Shapes& shapes,
                                       const Ranks& ranks)
{
  const double maximum_distance = shapes.parameters().maximum_distance;
  Tolerance_facts facts;
  facts.source = source_of_tolerances(o);
  facts.note = o.estimate_note.empty() ? with_options(shapes.statistics().estimate_note) : o.estimate_note;
  facts.is_of_each_point = has_tolerance_of_each_point(o);
  facts.smallest = facts.mean = facts.largest = maximum_distance;
  if(!facts.is_of_each_point)
    return facts;
  const Tolerance_map tolerances = *find_property<double>(points, tolerance_name);
  constexpr int sum_bits = 30;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  long long count = 0, sum = 0;
  for(Point_set::Index i : points)
    if(is_finite(points.point(i)) && tolerances[i] > 0) {
      const double tolerance = (std::min)(tolerances[i], maximum_distance);
      smallest = (std::min)(smallest, tolerance);
      largest = (std::max)(largest, tolerance);
      sum += std::llround(std::ldexp(tolerance / maximum_distance, sum_bits));
      ++count;
    }
  smallest = -ranks.largest(-smallest);
  facts.largest = ranks.largest(largest);
  const std::vector<long long> sums = ranks.sums({count, sum});
  facts.smallest = sums[0] > 0 ? smallest : 0;
  facts.mean = sums[0] > 0 ? maximum_distance * std::ldexp(double(sums[1]) / double(sums[0]), -sum_bits) : 0;
  return facts;
}

} // namespace program

#endif // DETECT_PLANES_TOLERANCES_H
