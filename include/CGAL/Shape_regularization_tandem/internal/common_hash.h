// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What all processes have of a result, as one number.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_COMMON_HASH_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_COMMON_HASH_H

#include <CGAL/Tandem/Shapes_data.h>
#include <CGAL/Tandem/internal/base/listed_parameters.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Of all but what is said of single points. Shapes: a Planar_shapes_3.
template <class Shapes>
std::uint64_t common_hash(const Shapes_data& data)
{
  std::uint64_t h = 0;
  const auto add = [&](const auto& list) {
    Shapes::add_to_hash(h, list.size());
    for(const auto& x : list)
      Shapes::add_to_hash(h, std::uint64_t(x));
  };
  const auto add_number = [&](double x) { Shapes::add_to_hash(h, {{x, 0, 0, 0}}); };
  Shapes::add_to_hash(h, data.coefficients);
  add(data.size);
  add(data.parallel_group);
  add(data.coplanar_group);
  add(data.is_flipped);
  for(const Plane_uncertainty& u : data.uncertainty) {
    Shapes::add_to_hash(h, {{u.centroid[0], u.centroid[1], u.centroid[2], u.noise}});
    add_number(u.offset_deviation);
    add_number(u.angle_deg);
    for(const double x : u.normal_covariance)
      add_number(x);
  }
  add(data.fixed_direction);
  add(data.symmetry_group);
  for(const auto& pair : data.orthogonal_groups)
    add(std::vector<int>{pair.first, pair.second});
  for(const auto& parameter : listed(data.parameters))
    add_number(parameter.second);
  add(std::vector<std::size_t>{data.statistics.number_of_rounds, data.statistics.is_cancelled});
  const Result_score& score = data.statistics.score;
  for(const double x : {score.fit, score.links, score.size, score.price, score.freedom})
    add_number(x);
  return h;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_COMMON_HASH_H
