// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Margins for rounding. See Ratio.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_EXACTNESS_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_EXACTNESS_H

namespace CGAL::Tandem::internal {
namespace tuning {

// Margins of the exact check, and of searches. They follow from the formats. Smaller ones would break the guarantee;
// larger ones only let more points be evaluated in double, or more directions be visited.
namespace exactness {

// Degrees: packed normals are within .004.
constexpr double packing_margin_deg = 0.006;
// Rounding a point costs up to .87 grid steps, rounding a plane's normal up to 1.3; and the relative rounding of the
// offset in the caller's coordinates.
constexpr double distance_margin_steps = 4;
constexpr double relative_margin = 1e-14;
// Of a cosine: the rounding of a normal to float.
constexpr double rounded_normal_margin = 2e-7;
// Relative to the sum of the terms: the rounding of a distance in double.
constexpr double evaluation_margin = 1e-15;
// Of a dot product of unit vectors: its rounding.
constexpr double dot_margin = 1e-14;
// Relative to the largest eigenvalue of a scatter: the rounding of a sum of squared distances.
constexpr double squared_distance_margin = 1e-13;
// Of bounds that spare a test: relative to the bound, and of the smallest eigenvalue of a joint scatter to its trace.
constexpr double bound_factor = 1.000001;
constexpr double eigenvalue_margin = 1e-8;
// Squared width of given points relative to their squared length: narrower ones are on a line up to rounding, and no
// plane is fitted to them.
constexpr double minimum_width_ratio2 = 1e-12;

} // namespace exactness

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_EXACTNESS_H
