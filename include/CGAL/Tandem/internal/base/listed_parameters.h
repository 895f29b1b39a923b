// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters as a list of numbers, to compare them. Ranks with different ones would wait for each other.

#ifndef CGAL_TANDEM_INTERNAL_BASE_LISTED_PARAMETERS_H
#define CGAL_TANDEM_INTERNAL_BASE_LISTED_PARAMETERS_H

#include <CGAL/Tandem/Parameters.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// Each number with its name. Directions come last, since there may be any number of them.
inline std::vector<std::pair<const char*, double>> listed(const Parameters& p)
{
  std::vector<std::pair<const char*, double>> list = {
    {"maximum_distance", p.maximum_distance},
    {"maximum_angle", p.maximum_angle},
    {"angle_tolerance", p.angle_tolerance},
    {"maximum_offset", p.maximum_offset},
    {"minimum_region_size", double(p.minimum_region_size)},
    {"simplicity", p.simplicity},
    {"regularity", p.regularity},
    {"fixed_regularity", p.fixed_regularity},
    {"surfel_size", p.surfel_size},
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

// Throws on all ranks unless they have the same parameters.
template <class Ranks>
void check_same_parameters(const Ranks& ranks, const Parameters& parameters)
{
  const auto list = listed(parameters);
  std::vector<double> own;
  for(const auto& value : list)
    own.push_back(value.second);
  std::vector<std::size_t> first;
  const std::vector<double> all = ranks.gather(own, &first);
  for(std::size_t r = 1; r + 1 < first.size(); ++r)
    for(std::size_t i = 0; i < (std::min)(first[1], first[r + 1] - first[r]); ++i)
      if(all[i] != all[first[r] + i])
        throw std::invalid_argument(std::string(i < list.size() ? list[i].first : "fixed_directions") +
                                    " has to be the same on all ranks: there are " + to_text(all[i]) + " and " +
                                    to_text(all[first[r] + i]));
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_LISTED_PARAMETERS_H
