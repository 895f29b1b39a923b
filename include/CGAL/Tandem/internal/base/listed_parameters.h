// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters as a list of numbers, to compare them.

#ifndef CGAL_TANDEM_INTERNAL_BASE_LISTED_PARAMETERS_H
#define CGAL_TANDEM_INTERNAL_BASE_LISTED_PARAMETERS_H

#include <CGAL/Tandem/Parameters.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Each number with its name. Directions come last, since there may be any number of them.
inline std::vector<std::pair<const char*, double>> listed(const Parameters& p)
{
  std::vector<std::pair<const char*, double>> list = {
    {"maximum_distance", p.maximum_distance},
    {"maximum_angle", p.maximum_angle},
    {"angle_tolerance", p.angle_tolerance},
    {"maximum_offset", p.maximum_offset},
    {"minimum_region_size", double(p.minimum_region_size)},
    {"k_neighbors", double(p.k_neighbors)},
    {"cell_size", double(p.cell_size)},
    {"regularize_parallelism", p.regularize_parallelism},
    {"regularize_orthogonality", p.regularize_orthogonality},
    {"regularize_coplanarity", p.regularize_coplanarity},
    {"regularize_axis_symmetry", p.regularize_axis_symmetry},
    {"regularity_period", double(p.regularity_period)},
  };
  for(const double x : p.symmetry_direction)
    list.emplace_back("symmetry_direction", x);
  list.emplace_back("fixed_directions", double(p.fixed_directions.size()));
  for(const auto& direction : p.fixed_directions)
    for(const double x : direction)
      list.emplace_back("fixed_directions", x);
  return list;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_LISTED_PARAMETERS_H
