// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters in the units of the grid: lengths in steps, angles of points as squared cosines. Here the numbers of
// base/tuning become bounds of one cloud. Changes nothing.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_MAKE_STAGE_PARAMETERS_H
#define CGAL_TANDEM_INTERNAL_ENGINE_MAKE_STAGE_PARAMETERS_H

#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/base/tuning/growth.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>

#include <algorithm>

namespace CGAL::Tandem::internal {

// The bounds of a test of points. They are rounded to integers once, so that all tests of points are exact.
// epsilon_steps: the part of the distance that is less for points of smaller tolerances.
inline Tolerance make_tolerance(double distance_steps, double cosine, double epsilon_steps)
{
  const std::int64_t units = llrint(distance_steps * normal_scale);
  return {units, std::int64_t(llrint(cosine * cosine * 4294967296.0)),
          units - std::int64_t(llrint(epsilon_steps * normal_scale))};
}
inline Tolerance make_tolerance(double steps, double cosine) { return make_tolerance(steps, cosine, steps); }

// The largest error of an integer distance: of rounded points and planes, and of an origin far from zero, whose offset
// is rounded in the caller's coordinates.
inline double distance_margin_steps(const Grid& grid)
{
  const double size = std::fabs(grid.origin.x) + std::fabs(grid.origin.y) + std::fabs(grid.origin.z);
  return fused(size / grid.step, tuning::exactness::relative_margin, tuning::exactness::distance_margin_steps);
}

// How shapes start and grow. The size of a core is bounded by that of a cell, or nothing could start in small cells, and
// by the smallest size of a shape.
inline Growth_parameters make_growth_parameters(const Parameters& p, const Tolerance& tolerance)
{
  using namespace tuning::growth;
  const std::size_t core_size = (std::min)({(std::max)(p.k_neighbors / neighbors_per_core_point + 1, std::size_t(3)),
                                            p.cell_size / cell_points_per_core_point, p.minimum_region_size});
  return {tolerance, std::uint32_t(core_size), std::int64_t((std::max)(core_size, p.minimum_region_size)), p.cell_size};
}

static_assert(smallest_angle_deg > 2 * tuning::exactness::packing_margin_deg, "exact normals would not fit");

// The options of a detection. `certain` is what an integer test accepts without doubt: tighter by all roundings of
// distance and angle; `possible` is what the exact test may accept, wider by them. `exact` is in the caller's units,
// hence not divided by the step.
inline Stage_parameters make_stage_parameters(const Import& in, const Parameters& p)
{
  Stage_parameters o;
  const double step = in.grid.step;
  const double cosine = cosine_deg(p.maximum_angle);
  o.maximum_distance_steps = p.maximum_distance / step;
  o.minimum_region_size = std::int64_t(p.minimum_region_size);
  o.minimum_related_size = (std::max)(std::int64_t(1), tuning::loop::related_ratio.of(o.minimum_region_size));
  o.minimum_fragment_size =
    (std::min)(o.minimum_region_size,
               (std::max)(tuning::loop::minimum_fragment_size, tuning::loop::fragment_ratio.of(o.minimum_region_size)));
  o.growth = make_growth_parameters(p, make_tolerance(o.maximum_distance_steps, cosine));
  o.score = Score(p);
  o.regularity = make_regularity_parameters(p, p.angle_tolerance, step, double(p.minimum_region_size));
  const double certain_angle = (std::max)(p.maximum_angle - tuning::exactness::packing_margin_deg, 0.);
  // Far from zero the margin may exceed epsilon, even all integers: then no distance is certain.
  const double certain_steps = (std::max)(o.maximum_distance_steps - distance_margin_steps(in.grid), -1.);
  o.certain = make_tolerance(certain_steps, cosine_deg(certain_angle), o.maximum_distance_steps);
  const double possible_angle = (std::min)(p.maximum_angle + tuning::exactness::packing_margin_deg, 90.);
  const double possible_steps = (std::min)(o.maximum_distance_steps + distance_margin_steps(in.grid), double(1 << 30));
  o.possible = make_tolerance(possible_steps, cosine_deg(possible_angle), o.maximum_distance_steps);
  o.exact = {p.maximum_distance, fused(1.0, cosine, tuning::exactness::rounded_normal_margin)};
  o.regularity_period = int((std::min)(p.regularity_period, std::size_t(1) << 30));
  o.has_estimated_normals = !in.has_normals;
  return o;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_MAKE_STAGE_PARAMETERS_H
