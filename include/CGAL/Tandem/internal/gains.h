// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What shapes gain or lose in a pass over the points. The sums belong to the back
// end and are zero between two passes; the host gets those that are not.

#ifndef CGAL_TANDEM_INTERNAL_GAINS_H
#define CGAL_TANDEM_INTERNAL_GAINS_H

#include <CGAL/Tandem/internal/Tandem_state.h>

#include <algorithm>
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

// The sums of all shapes, zero, to be handed to the functors of a pass.
template <class Backend>
Shared_moments* start_gains(Tandem_state<Backend>& t)
{
  if(t.gain.size() < t.shapes.size()) {
    t.gain.reset(t.shapes.size() + t.shapes.size() / 2);
    t.backend.for_each(t.gain.size(), Clear_sums{t.gain.data()});
  }
  return t.gain.data();
}

// After the pass: the sums of the shapes that it has met, by id.
template <class Backend>
std::vector<Gain> take_gains(Tandem_state<Backend>& t)
{
  std::vector<Gain> gains = t.backend.template collect<Gain>(t.shapes.size(), Take_sums{t.gain.data()});
  std::sort(gains.begin(), gains.end(), [](const Gain& a, const Gain& b) { return a.id < b.id; });
  return gains;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GAINS_H
