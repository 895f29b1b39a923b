// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters of a detection in the units of the grid. make_stage_parameters.h computes them.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_STAGE_PARAMETERS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_STAGE_PARAMETERS_H

#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/base/types.h>
#include <CGAL/Tandem/internal/regularity/relations.h>
#include <CGAL/Tandem/internal/score/Score.h>

#include <cstddef>

namespace CGAL::Tandem::internal {

// --- How shapes grow and begin in a cell.

// How shapes start and grow: see the manual, "Growth".
struct Growth_parameters {
  Tolerance tolerance;      // epsilon and alpha
  std::uint32_t core_size;  // fewest surfels that a shape begins with ...
  std::int64_t core_points; // ... unless at least three have so many points
  std::size_t cell_size;    // most surfels of a cell
};

// Surfels of a cell, at most. The queue has two bytes a surfel, so that of a small cell fits into fast memory. The
// largest cell is what 16 bits can address.
constexpr std::uint32_t small_cell = 8192;
constexpr std::uint32_t largest_cell = 65536;

// --- All parameters of the stages.

// The final test of a point, in the caller's coordinates. See the manual, "Exact Check".
struct Exact_bounds {
  double maximum_distance; // of level 0, in the caller's units
  double cosine;           // of maximum_angle, raised by the rounding of a normal to float

  // Whether p is within the tolerance of its level for certain: true only if every order of evaluation in double finds it
  // so. The margin is relative to the sum of the terms, which bounds the error of rounding.
  bool is_near(const Coefficients& c, const Vector& p, std::uint8_t level) const
  {
    const double x = c[0] * p.x, y = c[1] * p.y, z = c[2] * p.z;
    const double size = std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(c[3]);
    const double e = fused(c[0], p.x, fused(c[1], p.y, fused(c[2], p.z, c[3])));
    return fused(size, tuning::exactness::evaluation_margin, std::fabs(e)) <= maximum_distance * level_factor(level);
  }

  // Whether the unit normal n is within alpha of that of the plane. The sign of a normal is ignored.
  bool is_aligned(const Coefficients& c, const Vector& n) const
  {
    return std::fabs(dot({c[0], c[1], c[2]}, n)) >= cosine;
  }
};

// The parameters of the stages. Sizes are numbers of points. See the manual, "Choosing Parameters", and base/tuning.
struct Stage_parameters {
  Growth_parameters growth;
  Score score = Score(1, 1);
  Regularity_parameters regularity;
  double maximum_distance_steps; // epsilon
  std::int64_t minimum_region_size;
  std::int64_t minimum_related_size;  // smaller shapes get no relations in the loop
  std::int64_t minimum_fragment_size; // smaller shapes are dissolved when they stop growing
  Tolerance certain, possible;        // bounds within which the exact check is not needed, and beyond which it fails
  Exact_bounds exact;                 // in the caller's units
  int regularity_period;              // in rounds
  bool has_estimated_normals;         // none were given
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_STAGE_PARAMETERS_H
