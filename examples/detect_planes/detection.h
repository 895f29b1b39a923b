// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The detection with what the command line says.

#ifndef DETECT_PLANES_DETECTION_H
#define DETECT_PLANES_DETECTION_H

#include "signals.h"
#include "tolerance/Tolerances.h"

#include <CGAL/Shape_regularization_tandem/detect_planes.h>
#include <CGAL/Shape_regularization_tandem/estimate_local_distances.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

namespace program {

// A number below 0 is outside of the ranges of the library, as 0 is.
inline std::size_t count_of(const std::optional<long long>& given, std::size_t otherwise)
{
  return given ? std::size_t((std::max)(*given, 0LL)) : otherwise;
}

// From what the library says about a parameter, "NAME is VALUE, allowed is RANGE", what to say about the option.
inline Usage_error option_error(const std::string& message, const Options& o)
{
  const std::string is = " is ", allowed = ", allowed is ";
  const std::size_t value_at = message.find(is), range_at = message.find(allowed);
  if(value_at == message.npos || range_at == message.npos)
    return Usage_error(message);
  std::string option = "--" + message.substr(0, value_at);
  std::replace(option.begin(), option.end(), '_', '-');
  std::string value = message.substr(value_at + is.size(), range_at - value_at - is.size());
  const std::pair<const char*, std::optional<long long>> counts[] = {
    {"--minimum-region-size", o.minimum_region_size}, {"--k-neighbors", o.k_neighbors}, {"--cell-size", o.cell_size}};
  for(const auto& [name, given] : counts)
    if(option == name && given)
      value = std::to_string(*given);
  return Usage_error(option + is + value + ", must be in " + message.substr(range_at + allowed.size()));
}

// What was given, checked. A length or size that is to be estimated is 0.
inline CGAL::Tandem::Parameters parameters_of(const Options& o)
{
  CGAL::Tandem::Parameters p;
  p.maximum_angle = o.maximum_angle.value_or(p.maximum_angle);
  p.angle_tolerance = o.angle_tolerance.value_or(p.angle_tolerance);
  p.simplicity = o.simplicity.value_or(p.simplicity);
  p.regularity = o.regularity.value_or(p.regularity);
  p.surfel_size = o.surfel_size.value_or(p.surfel_size);
  p.k_neighbors = count_of(o.k_neighbors, p.k_neighbors);
  p.cell_size = count_of(o.cell_size, p.cell_size);
  p.regularize_parallelism = o.regularize_parallelism;
  p.regularize_orthogonality = o.regularize_orthogonality;
  p.regularize_coplanarity = o.regularize_coplanarity;
  p.fixed_directions = o.fixed_directions;
  if(o.symmetry_direction) {
    p.regularize_axis_symmetry = true;
    p.symmetry_direction = *o.symmetry_direction;
  }
  CGAL::Tandem::Parameters checked = p;
  checked.maximum_distance = o.maximum_distance.value_or(1);
  checked.maximum_offset = o.maximum_offset.value_or(1);
  checked.minimum_region_size = count_of(o.minimum_region_size, 3);
  try {
    CGAL::Tandem::check_parameters(checked);
  } catch(const std::invalid_argument& e) {
    throw option_error(e.what(), o);
  }
  p.maximum_distance = o.maximum_distance.value_or(o.estimated_distance);
  p.minimum_region_size = count_of(o.minimum_region_size, 0);
  return p;
}

// With the tolerances of the points, where they have their own.
template <class Tag, class Named_parameters>
Shapes detect_with(const Point_set& points, const Named_parameters& np)
{
  if(const auto tolerances = find_property<double>(points, tolerance_name))
    return CGAL::Tandem::detect_planes<Tag>(points, np.maximum_distance_map(*tolerances));
  return CGAL::Tandem::detect_planes<Tag>(points, np);
}

// Estimates one distance for all points; returns what is to be said of it.
template <class Tag>
CGAL::Tandem::Distance_estimate estimate_distance(const Point_set& points, Options& o)
{
  CGAL::Tandem::Distance_estimate estimate;
  const auto list = CGAL::Tandem::parameters::settings(parameters_of(o));
  o.estimated_distance = CGAL::Tandem::estimate_parameters<Tag>(points, list, &estimate).maximum_distance;
  return estimate;
}

template <class Tag>
void estimate_tolerances(const Point_set& points, const Options& o)
{
  Tolerance_map tolerances = *find_property<double>(points, tolerance_name);
  const std::vector<double> estimated =
    CGAL::Tandem::estimate_local_distances<Tag>(points, CGAL::Tandem::parameters::settings(parameters_of(o)));
  auto next = estimated.begin();
  for(Point_set::Index i : points)
    tolerances[i] = *next++;
}

template <class Tag>
Shapes detect(const Point_set& points, const Options& o, Progress_line& progress)
{
  namespace np = CGAL::Tandem::parameters;
  const std::function<bool(double)> callback = [&](double share) {
    check_signals();
    progress.show(share);
    return true;
  };
  if(o.has_local_distances)
    estimate_tolerances<Tag>(points, o);
  const auto all = np::settings(parameters_of(o)).callback(callback);
  if(o.maximum_offset)
    return detect_with<Tag>(points, all.maximum_offset(*o.maximum_offset));
  return detect_with<Tag>(points, all);
}

} // namespace program

#endif // DETECT_PLANES_DETECTION_H
