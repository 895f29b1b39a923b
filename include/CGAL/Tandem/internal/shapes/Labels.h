// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels and states of the points.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_LABELS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_LABELS_H

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// A label below first_mark is the shape of the point. The other values mean that
// the point is free, now or for good.
constexpr std::uint32_t first_mark = 0x80000000u;
constexpr std::uint32_t free_label = 0xffffffffu;
constexpr std::uint32_t locked_label = 0xfffffffeu; // free, but detached too often to be grown over again

// Bits of the state of a point.
constexpr std::uint8_t frontier_bit = 1;    // its neighbors are still to be visited
constexpr std::uint8_t failed_seed_bit = 2; // a shape that started here has failed
constexpr std::uint8_t detached_bit = 4;
constexpr std::uint8_t interior_bit = 8; // all of its neighbors have had its label

struct Labels_view {
  std::uint32_t* label;
  std::uint8_t* state;

  CGAL_TANDEM_HD bool is_untried(std::uint32_t i) const
  {
    return label[i] == free_label && !(state[i] & failed_seed_bit);
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_LABELS_H
