// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Great circles and cells on the sphere of directions; opposite directions are the same. Directions are projected from
// the origin onto three faces of a cube, where a great circle is a straight line. Bounds are on the safe side of all
// rounding.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_GREAT_CIRCLE_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_GREAT_CIRCLE_H

#include <CGAL/Tandem/internal/base/tuning/exactness.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL {
namespace Tandem {
namespace internal {

// A square on a face of the cube [-1, 1]^3, the one where coordinate `face` is 1. u and v are the next coordinates, in
// turn.
struct Direction_cell {
  int face;
  double u, v, half_width; // center, and half of the width
};

// The great circle of the directions orthogonal to the unit axis (x, y, z).
class Great_circle {
public:
  Great_circle(double x, double y, double z) : n{x, y, z, x, y}
  {
    for(int face = 0; face < 3; ++face)
      slope[face] = std::fabs(n[face + 1]) + std::fabs(n[face + 2]);
  }

  // Whether it may pass through the cell.
  bool meets(const Direction_cell& cell) const { return !(distance(cell) > 0); }

  // At most the squared dot product of the axis and any unit direction of the cell.
  double least_squared_dot(const Direction_cell& cell) const
  {
    const double least = distance(cell);
    if(!(least > 0))
      return 0;
    const double u = std::fabs(cell.u) + cell.half_width, v = std::fabs(cell.v) + cell.half_width;
    return least * least / (1 + u * u + v * v);
  }

  // The quarter of the cell of which the center is nearest to the circle.
  int nearest_quarter(const Direction_cell& cell) const
  {
    const double h = height(cell), w = cell.half_width / 2, u = w * n[cell.face + 1], v = w * n[cell.face + 2];
    const double distances[4] = {std::fabs(h - u - v), std::fabs(h + u - v), std::fabs(h - u + v),
                                 std::fabs(h + u + v)};
    return int(std::min_element(distances, distances + 4) - distances);
  }

private:
  // The dot product of the axis and the center of the cell, on the face.
  double height(const Direction_cell& cell) const
  {
    return n[cell.face] + n[cell.face + 1] * cell.u + n[cell.face + 2] * cell.v;
  }

  // The least |dot product| of the cell, on the face.
  double distance(const Direction_cell& cell) const
  {
    return std::fabs(height(cell)) - cell.half_width * slope[cell.face] - tuning::exactness::dot_margin;
  }

  std::array<double, 5> n; // so that the coordinates can be taken in turn
  double slope[3];         // by face: how much the dot product changes within a cell
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_GREAT_CIRCLE_H
