// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the points to the parameters that the caller did not give. See the manual, "Estimated Parameters".

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_COMPLETE_PARAMETERS_H
#define CGAL_TANDEM_INTERNAL_ENGINE_COMPLETE_PARAMETERS_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/cloud/far_points.h>
#include <CGAL/Tandem/internal/neighbors/measure_cloud.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace CGAL::Tandem::internal {

// Whether there is more noise than that of rounding, and most of it is not that of surfaces that bend.
inline bool has_noise(const Cloud_measure& m)
{
  using namespace tuning::estimation;
  return m.noise > least_noise_per_spacing * m.spacing && m.bends < bent_ratio;
}

// The epsilon for a cloud: from the spacing, but between multiples of the noise.
inline double distance_for(const Cloud_measure& m)
{
  using namespace tuning::estimation;
  const double root4 = std::sqrt(std::sqrt(m.places)), root16 = std::sqrt(std::sqrt(root4));
  const double spaced = distance_per_spacing * root4 * root16 * m.spacing;
  const double most = has_noise(m)
                        ? (std::min)(distance_per_largest_noise * m.largest_noise, distance_per_rms_noise * m.rms_noise)
                        : spaced;
  return (std::max)(distance_per_noise * m.noise, (std::min)(spaced, most));
}

// The same, as long as it has to be.
inline double estimate_maximum_distance(const Import& in, const Cloud_measure& m)
{
  using namespace tuning::estimation;
  if(m.extent > 0) {
    const double smallest = std::ldexp(m.extent, minimum_distance_bits); // so that the grid can hold the cloud
    return bounded_length((std::max)(distance_for(m), smallest));
  }
  double largest = 0; // all points are equal: any positive length
  for(int c = 0; c < 3; ++c)
    largest = (std::max)(largest, std::fabs(in.box.low[c]));
  return largest > 1e-200 ? bounded_length(smallest_distance * largest) : 1;
}

// What is to be said of the epsilon of a cloud. Of several reasons the first one counts.
inline Distance_estimate describe_compromise(const Cloud_measure& m)
{
  using namespace tuning::estimation;
  const auto percent = [](double ratio) { return to_text(std::lround(100 * ratio)) + " %"; };
  if(m.places < minimum_places)
    return {};
  if(m.patch.empty())
    return {"No surface was found to measure the noise on: there may be none, or the noise exceeds the size of the "
            "faces."};
  if(has_noise(m) && m.exact > compromise_ratio)
    return {percent(m.exact) +
            " of the points lie exactly on planes with their nearest neighbors, but not with more of "
            "them: coordinates are in steps, which the estimated maximum distance is meant to cover."};
  if(m.sheets > compromise_ratio)
    return {percent(m.sheets) +
            " of the surfaces have a second one close to them, and the estimate keeps the two apart: "
            "if they are one, as in scans that do not match, give a larger maximum distance."};
  if(has_noise(m) && m.varies)
    return {"The noise varies from " + to_text(m.low_noise) + " to " + to_text(m.high_noise) + " over the cloud.",
            true};
  return {};
}

// The largest distance where points have tolerances of their own: no more than the largest one, and, if it is not given,
// what nearly all of them do not exceed. Infinite ones do not count; if all are, it is estimated.
template <class Ranks>
void bound_by_tolerances(const Ranks& ranks, const Import& in, Parameters& p)
{
  if(p.maximum_distance != 0) {
    p.maximum_distance = (std::min)(p.maximum_distance, bounded_length(in.largest_tolerance));
    return;
  }
  std::vector<double> finite;
  for(const double t : in.tolerances)
    if(std::isfinite(t))
      finite.push_back(t);
  if(ranks.total(finite.size()) > 0)
    p.maximum_distance = bounded_length(quantile_of_all(
      ranks, finite.size(), [&](std::size_t i) { return finite[i]; }, tuning::grid::tolerances_within));
}

// The minimum size of a shape, from the number of points. spacing(): that of the points, where the number is large.
template <class Spacing>
std::size_t estimate_minimum_region_size(double points, double maximum_distance, Spacing spacing)
{
  using namespace tuning::estimation;
  double size = region_size_per_root * std::sqrt(points);
  if(size > largest_region_size)
    size = (std::min)(size, (std::max)(largest_region_size, region_size_per_distance * maximum_distance / spacing()));
  return (std::max)(minimum_region_size, std::size_t(std::llround(size)));
}

// Estimates the parameters that are 0, and checks all of them. Returns what is to be said of them.
template <class Backend>
Distance_estimate complete_parameters(Backend& backend, const Import& in, bool has_offset, Parameters& p)
{
  Distance_estimate estimate;
  if(in.has_tolerances && in.total.points > 0)
    bound_by_tolerances(Ranks<Backend>(backend), in, p);
  std::optional<Cloud_measure> measure;
  if(p.maximum_distance == 0 && in.total.points > 0) {
    measure = measure_cloud(backend, in);
    p.maximum_distance = estimate_maximum_distance(in, *measure);
    estimate = describe_compromise(*measure);
  }
  if(p.maximum_distance == 0)
    p.maximum_distance = 1;
  if(!has_offset)
    p.maximum_offset = p.maximum_distance;
  if(p.minimum_region_size == 0)
    p.minimum_region_size = estimate_minimum_region_size(double(in.total.points), p.maximum_distance, [&] {
      return measure ? measure->spacing : measure_cloud(backend, in).spacing;
    });
  check_parameters(p);
  return estimate;
}

// Completes the parameters, as above, and chooses the grid of the points.
template <class Backend>
std::string set_scale(Backend& backend, Import& in, bool has_offset, Parameters& p)
{
  const Distance_estimate estimate = complete_parameters(backend, in, has_offset, p);
  drop_far_points(Ranks<Backend>(backend), in, p.maximum_distance);
  choose_grid(in, p);
  return estimate.note +
         (estimate.noise_varies ? " estimate_local_distances() gives each point a tolerance of its own." : "");
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_COMPLETE_PARAMETERS_H
