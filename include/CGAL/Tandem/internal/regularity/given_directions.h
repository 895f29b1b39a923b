// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The directions that the caller knows beforehand, and the axis of symmetry: from the parameters to the options of the
// regularity step, and which of them the groups of a result have.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_GIVEN_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_GIVEN_DIRECTIONS_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/regularity/relations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace CGAL::Tandem::internal {

// Unit and canonical in sign. Any length that is finite and not null will do.
inline Vector given_direction(const std::array<double, 3>& d)
{
  const double largest = (std::max)({std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])});
  return canonical(unit({d[0] / largest, d[1] / largest, d[2] / largest}));
}

// Adds a direction, unless there is one that equals it up to its sign and rounding; returns the one that is there.
inline Vector add_direction(std::vector<Vector>& directions, const Vector& d)
{
  constexpr double reach = tuning::relations::same_direction;
  for(const Vector& other : directions)
    if(squared_sine(other, d) < reach * reach)
      return other;
  directions.push_back(d);
  return d;
}

// All different: of equal ones, the first.
inline std::vector<Vector> distinct_fixed_directions(const Parameters& p)
{
  std::vector<Vector> directions;
  for(const auto& d : p.fixed_directions)
    add_direction(directions, given_direction(d));
  return directions;
}

// The fixed direction that equals the direction of symmetry, or else that itself.
inline Vector symmetry_axis(const Parameters& p)
{
  std::vector<Vector> directions = distinct_fixed_directions(p);
  return add_direction(directions, given_direction(p.symmetry_direction));
}

// step: of the grid. minimum_size: of a shape, in points. The axis of symmetry is a fixed direction, too.
inline Regularity_parameters make_regularity_parameters(const Parameters& p, double angle_tolerance_deg, double step,
                                                        double minimum_size)
{
  Regularity_parameters options;
  options.angle_tolerance_deg = angle_tolerance_deg;
  options.maximum_offset_steps = p.maximum_offset / step;
  options.maximum_distance_steps = p.maximum_distance / step;
  options.freedom = make_freedom_worth(p.regularity, minimum_size);
  options.given_freedom = make_freedom_worth((std::max)(p.regularity, p.fixed_regularity), minimum_size);
  options.parallelism = p.regularize_parallelism;
  options.orthogonality = p.regularize_orthogonality;
  options.coplanarity = p.regularize_coplanarity;
  options.fixed_directions = distinct_fixed_directions(p);
  if(p.regularize_axis_symmetry)
    options.symmetry_axis = {add_direction(options.fixed_directions, given_direction(p.symmetry_direction))};
  return options;
}

// The normals of parallel groups, up to their signs. group: of each plane.
inline std::vector<Vector> group_directions(const std::vector<int>& group, const std::vector<Coefficients>& planes)
{
  std::vector<Vector> directions(group.empty() ? 0 : std::size_t(*std::max_element(group.begin(), group.end())) + 1);
  for(std::size_t s = 0; s < planes.size(); ++s)
    directions[std::size_t(group[s])] = {planes[s][0], planes[s][1], planes[s][2]};
  return directions;
}

// By group, the place of its direction among the fixed ones, or -1. The first of equal ones counts.
inline std::vector<int> fixed_directions_of(const std::vector<Vector>& directions, const Parameters& p)
{
  std::vector<Vector> given;
  for(const auto& d : p.fixed_directions)
    given.push_back(given_direction(d));
  std::vector<int> result;
  for(const Vector& direction : directions) {
    const auto at = std::find(given.begin(), given.end(), canonical(direction));
    result.push_back(at == given.end() ? -1 : int(at - given.begin()));
  }
  return result;
}

// By group, the number of its angle to the axis: groups of one number make the same angle, up to the last bit of its
// cosine. -1 for null vectors, and for all where symmetry is off.
inline std::vector<int> symmetry_groups(const std::vector<Vector>& directions, const Parameters& p)
{
  std::vector<int> result(directions.size(), -1);
  if(!p.regularize_axis_symmetry)
    return result;
  const Vector axis = symmetry_axis(p);
  std::vector<double> cosine;
  cosine.reserve(directions.size());
  for(const Vector& d : directions)
    cosine.push_back(std::fabs(dot(d, axis)));
  std::vector<int> order(directions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cosine[a] < cosine[b]; });
  double first = -1;
  int number = -1;
  for(int g : order) {
    if(!(dot(directions[g], directions[g]) > 0))
      continue; // a plane without normal
    if(number < 0 || cosine[g] - first > tuning::relations::same_cosine) {
      first = cosine[g];
      ++number;
    }
    result[g] = number;
  }
  return result;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_GIVEN_DIRECTIONS_H
