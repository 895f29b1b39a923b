// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What shapes gain or lose in a pass over the points. The sums belong to the back
// end and are zero between two passes; the host gets those that are not.

#ifndef CGAL_TANDEM_INTERNAL_GAINS_H
#define CGAL_TANDEM_INTERNAL_GAINS_H

#include <CGAL/Tandem/internal/Tandem_state.h>

#include <functional>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Gain {
  std::uint32_t id;
  std::uint32_t gap = 0; // without it there were bytes that nobody writes
  Shared_moments sums;
};

struct Clear_sums {
  Shared_moments* sums;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { sums[i] = Shared_moments(); }
};

// Takes the sums of a shape that a pass has met.
struct Take_sums {
  Shared_moments* sums;

  CGAL_TANDEM_HD bool operator()(std::uint32_t id, Gain& gain) const
  {
    if(sums[id].box.low[0] > sums[id].box.high[0])
      return false;
    gain = {id, 0, sums[id]};
    sums[id] = Shared_moments();
    return true;
  }
};

// The sums of all shapes, zero, to be handed to the functors of a pass. A growth pass has more
// ids than shapes.
template <class Backend>
Shared_moments* start_gains(Tandem_state<Backend>& t, std::size_t ids)
{
  if(t.gain.size() < ids) {
    t.gain.reset(ids + ids / 2);
    t.backend.for_each(t.gain.size(), Clear_sums{t.gain.data()});
  }
  return t.gain.data();
}

// After the pass: the sums of the shapes that it has met, by id.
template <class Backend>
std::vector<Gain> take_gains(Tandem_state<Backend>& t, std::size_t ids)
{
  const std::vector<Gain> found = t.backend.template collect<Gain>(ids, Take_sums{t.gain.data()});
  std::vector<std::uint64_t> order(found.size()); // to sort by id what is small
  for(std::size_t i = 0; i < found.size(); ++i)
    order[i] = std::uint64_t(found[i].id) << 32 | i;
  t.backend.sort_on_host(order.begin(), order.end(), std::less<std::uint64_t>());
  std::vector<Gain> gains(found.size());
  t.backend.for_each_on_host(gains.size(), [&](std::size_t i) { gains[i] = found[order[i] & 0xffffffffu]; });
  return gains;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GAINS_H
