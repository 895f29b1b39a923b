// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bounding boxes on the grid. They are minima and maxima of integers: neither the order of points nor the number of
// threads can change them.

#ifndef CGAL_TANDEM_INTERNAL_BASE_BOX_H
#define CGAL_TANDEM_INTERNAL_BASE_BOX_H

#include <CGAL/Tandem/internal/base/types.h>

#include <limits>

namespace CGAL {
namespace Tandem {
namespace internal {

// Bounds of a set of points, in grid steps; both corners belong to the box. It starts empty, with low > high, and can
// only grow. When points are taken out of the set it stays a valid bound, though not the tightest one.
struct Box {
  std::int32_t low[3] = {(std::numeric_limits<std::int32_t>::max)(), (std::numeric_limits<std::int32_t>::max)(),
                         (std::numeric_limits<std::int32_t>::max)()};
  std::int32_t high[3] = {(std::numeric_limits<std::int32_t>::min)(), (std::numeric_limits<std::int32_t>::min)(),
                          (std::numeric_limits<std::int32_t>::min)()};

  CGAL_TANDEM_HD void add(const Grid_point& p)
  {
    const std::int32_t c[3] = {p.x, p.y, p.z};
    for(int a = 0; a < 3; ++a) {
      low[a] = c[a] < low[a] ? c[a] : low[a];
      high[a] = c[a] > high[a] ? c[a] : high[a];
    }
  }

  // An empty box changes nothing.
  CGAL_TANDEM_HD void add(const Box& b)
  {
    for(int a = 0; a < 3; ++a) {
      low[a] = b.low[a] < low[a] ? b.low[a] : low[a];
      high[a] = b.high[a] > high[a] ? b.high[a] : high[a];
    }
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BASE_BOX_H
