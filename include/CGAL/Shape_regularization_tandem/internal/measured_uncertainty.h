// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The uncertainty of a plane, from points in the caller's memory.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_MEASURED_UNCERTAINTY_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_MEASURED_UNCERTAINTY_H

#include <CGAL/Tandem/internal/result/measure_planes.h>

#include <cstddef>

namespace CGAL::Tandem::internal {

// position(i) of the i of `members`, of which there is one. Sums are in steps of the grid of the detection, from the
// first point: their squares then neither overflow nor vanish.
template <class Members, class Position>
Plane_uncertainty measured_uncertainty(const Members& members, const Position& position, const Coefficients& plane,
                                       const Parameters& parameters, double step)
{
  Grid grid;
  grid.origin = position(members[0]);
  grid.step = step;
  const auto for_each_point = [&](auto f) {
    for(std::size_t i : members) {
      const Vector v = position(i) - grid.origin;
      f(Vector{v.x / step, v.y / step, v.z / step});
    }
  };
  Scatter s = {double(members.size()), {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
  for_each_point([&](const Vector& v) { s.centroid = add_scaled(s.centroid, 1 / s.count, v); });
  for_each_point([&](const Vector& v) { s.matrix = add_square(s.matrix, 1, v - s.centroid); });
  return to_caller(plane_uncertainty(s, to_grid(plane, grid), parameters.maximum_distance / step), grid);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_MEASURED_UNCERTAINTY_H
