// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relations. See Ratio.h.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_REGULARITY_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_REGULARITY_H

#include <cstddef>
#include <cstdint>

namespace CGAL::Tandem::internal {
namespace tuning {

// When directions are the same, or orthogonal.
namespace relations {

// Two unit normals are orthogonal if their dot product is at most this. Half of the 1e-15 that results promise, so
// that every order of evaluation keeps the promise.
constexpr double orthogonal_dot = 5e-16;
// The same of the cosines of their angles to an axis, whose rounding is larger.
constexpr double same_cosine = 6e-16;
// Directions closer than this (sine) are one up to rounding.
constexpr double same_direction = 1e-9;

} // namespace relations

// Groups of parallel shapes, and their right angles (sections 4.1 and 4.2 of the paper).
namespace directions {

// Directions, the first ones, of which two may be partners of another. More: slower, hardly better.
constexpr std::size_t partners = 8;
// Two placed directions whose squared sine is smaller determine no third one.
constexpr double minimum_squared_sine = 0.04;

} // namespace directions

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_REGULARITY_H
