// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How shapes grow and begin in a cell.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_GROWTH_OPTIONS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_GROWTH_OPTIONS_H

#include <CGAL/Tandem/internal/base/types.h>

#include <cstddef>

namespace CGAL {
namespace Tandem {
namespace internal {

// How shapes start and grow: see the manual, "Growth".
struct Growth_options {
  Tolerance tolerance;     // epsilon and alpha
  int seeds_in_flight;     // most shapes that may be growing in a cell for a new one to begin; rises after young rounds
  int seed_tries;          // candidates that may fail in one pass
  std::uint32_t core_size; // fewest surfels that a shape begins with ...
  std::int64_t core_points; // ... unless at least three have so many points
  std::size_t cell_size;    // most surfels of a cell
};

// Points of a cell, at most. The queue has two bytes a point, so that of a small cell fits into fast memory. The
// largest cell is what 16 bits can address.
constexpr std::uint32_t small_cell = 8192;
constexpr std::uint32_t largest_cell = 65536;

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_GROWTH_OPTIONS_H
