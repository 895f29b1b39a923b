// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the points to the parameters that the caller did not give. See the manual, "Estimated Parameters".

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_COMPLETE_PARAMETERS_H
#define CGAL_TANDEM_INTERNAL_ENGINE_COMPLETE_PARAMETERS_H

#include <CGAL/Tandem/check_parameters.h>
#include <CGAL/Tandem/internal/neighbors/measure_cloud.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Tandem {
namespace internal {

// The epsilon that is estimated: from the noise or the spacing, whichever gives more.
template <class Backend>
double estimate_maximum_distance(Backend& backend, const Import& in)
{
  using namespace tuning::estimation;
  const Cloud_measure measure = measure_cloud(backend, in);
  const Coordinate_box& box = in.box;
  const double estimate = (std::max)(distance_per_noise * measure.noise, distance_per_spacing * measure.spacing);
  const double smallest = std::ldexp(box.extent(), minimum_distance_bits); // so that the grid can hold the cloud
  if(box.extent() > 0)
    return bounded_length((std::max)(estimate, smallest));
  double largest = 0; // all points are equal: any positive length
  for(int c = 0; c < 3; ++c)
    largest = (std::max)(largest, std::fabs(box.low[c]));
  return largest > 1e-200 ? bounded_length(smallest_distance * largest) : 1;
}

inline std::size_t estimate_minimum_region_size(std::size_t points)
{
  using namespace tuning::estimation;
  return (std::max)(minimum_region_size, std::size_t(std::llround(region_size_per_root * std::sqrt(double(points)))));
}

// Estimates the parameters that are 0, and checks all of them.
template <class Backend>
void complete_parameters(Backend& backend, const Import& in, bool has_offset, Parameters& p)
{
  if(p.maximum_distance == 0)
    p.maximum_distance = in.total.points > 0 ? estimate_maximum_distance(backend, in) : 1;
  if(!has_offset)
    p.maximum_offset = p.maximum_distance;
  if(p.minimum_region_size == 0)
    p.minimum_region_size = estimate_minimum_region_size(std::size_t(in.total.points));
  check_parameters(p);
}

// Completes the parameters, as above, and chooses the grid of the points.
template <class Backend>
void set_scale(Backend& backend, Import& in, bool has_offset, Parameters& p)
{
  complete_parameters(backend, in, has_offset, p);
  choose_grid(in, p);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_COMPLETE_PARAMETERS_H
