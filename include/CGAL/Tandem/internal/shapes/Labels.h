// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels and states of the surfels, and which bit means what.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_LABELS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_LABELS_H

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL::Tandem::internal {

// A label below first_mark is the shape of the surfel, so ids are below 2^31. Otherwise the surfel is free. While a
// cell grows, first_mark + s is the claim of shape s. Claims are below the two constants, so the smallest value belongs
// to the smallest id.
constexpr std::uint32_t first_mark = 0x80000000u;
constexpr std::uint32_t free_label = 0xffffffffu;
constexpr std::uint32_t locked_label = 0xfffffffeu; // free, but growth cannot take it; an assignment can

// Bits of the state of a surfel. At any time at most one lane changes those of a surfel, so there are no races.
constexpr std::uint8_t tried_seed_bit = 1; // it has been tried as a seed, or its shape was dissolved
constexpr std::uint8_t detached_bit = 2;   // it has been detached once; the second time locks it
// All of its neighbors had its label, so passes over contacts leave it out. Neighbors may have another one later: see
// Phase in Labeled_cloud.h.
constexpr std::uint8_t interior_bit = 4;

// The labels and states of surfels, by position in the sorted cloud.
struct Labels_view {
  std::uint32_t* label;
  std::uint8_t* state;
};

// Whether a shape may still start at surfel i. Labels of other shapes and locked surfels exclude it.
CGAL_TANDEM_HD inline bool is_untried(const std::uint32_t* label, const std::uint8_t* state, std::uint32_t i)
{
  return label[i] == free_label && !(state[i] & tried_seed_bit);
}

// --- Which points of a surfel belong to its shape. In the loop all do; in the result those that are within their
// tolerances.

// The labels of surfels, and of the points that they stand for. A point has the label of its surfel, or none.
struct Labels_of_points {
  Surfels_view surfels;
  const std::uint32_t* label;       // by surfel
  const std::uint32_t* point_label; // by point; null: all have those of their surfels

  // Whether point p of surfel i has its label.
  CGAL_TANDEM_HD bool has(std::uint32_t i, std::uint32_t p) const
  {
    return label[i] < first_mark && (point_label == nullptr || point_label[p] == label[i]);
  }

  // f(p) for the points of surfel i that have its label.
  template <class F>
  CGAL_TANDEM_HD void for_each_point(std::uint32_t i, F f) const
  {
    const Range points = surfels.points(i);
    for(std::uint32_t p = points.first; p < points.last; ++p)
      if(has(i, p))
        f(p);
  }
};

// The shapes of a result, as functors read them.
struct Final_shapes {
  Labels_of_points labels;
  const std::uint32_t* shape; // of each surfel, and of ghosts; no_index if there is none
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_LABELS_H
