// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How lanes share the items of a step of run_rounds(), where the host may not know how many there are.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_LANES_H
#define CGAL_TANDEM_INTERNAL_BACKEND_LANES_H

#include <CGAL/Tandem/internal/base/types.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// f(i) for the items of one lane; all lanes together have [0, n). On a device, lanes beside each other read items
// beside each other. On the host, where a thread has one lane after the other, the items of a lane are consecutive.
template <class F>
CGAL_TANDEM_HD void for_items_of_lane(std::size_t lane, std::size_t lanes, std::size_t n, F f)
{
#ifdef __CUDA_ARCH__
  for(std::size_t i = lane; i < n; i += lanes)
    f(i);
#else
  const std::size_t last = n * (lane + 1) / lanes;
  for(std::size_t i = n * lane / lanes; i < last; ++i)
    f(i);
#endif
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_LANES_H
