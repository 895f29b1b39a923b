// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_INTERNAL_BASE_BOX_H
#define CGAL_TANDEM_INTERNAL_BASE_BOX_H

#include <CGAL/Tandem/internal/base/types.h>

#include <limits>

namespace CGAL {
namespace Tandem {
namespace internal {

// Integer bounds of a set of points; grows only.
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
