// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From named parameters to the struct Parameters. Values of the struct come first, named ones replace them. A length or
// size that is 0 in the end is estimated later.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESOLVE_PARAMETERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESOLVE_PARAMETERS_H

#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Tandem/Parameters.h>

#include <CGAL/number_utils.h>

namespace CGAL::Tandem::internal {

// Any number type that converts to double.
template <class Tag, class NP>
void read_real(const NP& np, double& value)
{
  if constexpr(Is_given<Tag, NP>::value)
    value = CGAL::to_double(parameter<Tag>(np, 0));
}

// Throws for a value out of the range. A negative one must not wrap around, and 0 would mean "to be estimated".
template <class Tag, class NP>
void read_count(const NP& np, const Count_range& range, std::size_t& value)
{
  if constexpr(Is_given<Tag, NP>::value) {
    const auto given = parameter<Tag>(np, 0);
    if(!(given >= decltype(given)(1)) || double(given) > double(range.largest))
      throw_out_of_range(range.name, given, to_text(range));
    value = std::size_t(given);
  }
}

// Leaves the value as it is if the parameter is not given.
template <class Tag, class NP>
void read_switch(const NP& np, bool& value)
{
  if constexpr(Is_given<Tag, NP>::value)
    value = parameter<Tag>(np, true);
}

// A vector of the kernel, or anything else with x(), y() and z(), or three numbers.
template <class Direction>
std::array<double, 3> read_direction(const Direction& d)
{
  return {CGAL::to_double(d.x()), CGAL::to_double(d.y()), CGAL::to_double(d.z())};
}

inline std::array<double, 3> read_direction(const std::array<double, 3>& d) { return d; }

// The axis of symmetry is used if it is given, unless it is switched off. It is the z axis otherwise.
template <class NP>
void read_directions(const NP& np, Parameters& p)
{
  if constexpr(Is_given<internal_np::fixed_directions_t, NP>::value) {
    p.fixed_directions.clear();
    for(const auto& d : parameter<internal_np::fixed_directions_t>(np, 0))
      p.fixed_directions.push_back(read_direction(d));
  }
  if constexpr(Is_given<internal_np::symmetry_direction_t, NP>::value) {
    p.symmetry_direction = read_direction(parameter<internal_np::symmetry_direction_t>(np, 0));
    p.regularize_axis_symmetry = true;
  }
  read_switch<internal_np::regularize_axis_symmetry_t>(np, p.regularize_axis_symmetry);
}

// Lengths are checked here if they are given or set, since 0 would mean "to be estimated" later.
template <class NP>
Parameters read_parameters(const NP& np)
{
  Parameters p = parameter<internal_np::settings_t>(np, Parameters());
  read_real<internal_np::maximum_distance_t>(np, p.maximum_distance);
  if(Is_given<internal_np::maximum_distance_t, NP>::value || p.maximum_distance != 0)
    check_length("maximum_distance", p.maximum_distance, smallest_length);
  read_real<internal_np::maximum_angle_t>(np, p.maximum_angle);
  read_real<internal_np::angle_tolerance_t>(np, p.angle_tolerance);
  read_real<internal_np::maximum_offset_t>(np, p.maximum_offset);
  read_count<internal_np::minimum_region_size_t>(np, minimum_region_size_range, p.minimum_region_size);
  read_real<internal_np::simplicity_t>(np, p.simplicity);
  read_real<internal_np::regularity_t>(np, p.regularity);
  read_real<internal_np::surfel_size_t>(np, p.surfel_size);
  read_count<internal_np::k_neighbors_t>(np, k_neighbors_range, p.k_neighbors);
  read_count<internal_np::cell_size_t>(np, cell_size_range, p.cell_size);
  read_switch<internal_np::regularize_parallelism_t>(np, p.regularize_parallelism);
  read_switch<internal_np::regularize_orthogonality_t>(np, p.regularize_orthogonality);
  read_switch<internal_np::regularize_coplanarity_t>(np, p.regularize_coplanarity);
  read_directions(np, p);
  return p;
}

// Whether the caller gave maximum_offset; otherwise it follows maximum_distance.
template <class NP>
bool has_own_offset(const NP& np)
{
  return Is_given<internal_np::maximum_offset_t, NP>::value ||
         parameter<internal_np::settings_t>(np, Parameters()).maximum_offset != 0;
}

// The parameters as far as the caller gave them, checked before any work is done.
inline void check_given_parameters(Parameters p)
{
  if(p.maximum_distance == 0)
    p.maximum_distance = 1;
  if(p.minimum_region_size == 0)
    p.minimum_region_size = 3;
  check_parameters(p);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_RESOLVE_PARAMETERS_H
