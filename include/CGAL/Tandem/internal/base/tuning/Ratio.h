// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers that steer the method, stage by stage. Each has its unit, where it comes from, and what moving it does.
// "Paper" is Oesau, Lafarge and Alliez 2016. "Measured" means: chosen on scans of buildings, rooms and streets and on
// generated scenes with known faces, by coverage, number of directions and planes, and faces found. Entries that only
// bound the work, such as numbers of passes, were chosen so that more of them change next to nothing. With other values
// the result is another one, on all back ends alike. Numbers of the manual are made of these, by the manual's tuning.py.

#ifndef CGAL_TANDEM_INTERNAL_BASE_TUNING_RATIO_H
#define CGAL_TANDEM_INTERNAL_BASE_TUNING_RATIO_H

#include <cstdint>

namespace CGAL::Tandem::internal {
namespace tuning {

// A part of a number of points, without rounding of floats.
struct Ratio {
  std::int64_t numerator, denominator;

  constexpr std::int64_t of(std::int64_t n) const { return n * numerator / denominator; }

  // Whether the part is at least this ratio of the whole.
  constexpr bool is_reached(std::int64_t part, std::int64_t whole) const
  {
    return part * denominator >= whole * numerator;
  }

  constexpr bool is_exceeded(std::int64_t part, std::int64_t whole) const
  {
    return part * denominator > whole * numerator;
  }
};

} // namespace tuning
} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_TUNING_RATIO_H
