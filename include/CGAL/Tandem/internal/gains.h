// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What shapes gain or lose in a pass over the points. The sums belong to the back
// end and are zero between two passes; the host gets those that are not.

#ifndef CGAL_TANDEM_INTERNAL_GAINS_H
#define CGAL_TANDEM_INTERNAL_GAINS_H

#include <CGAL/Tandem/internal/Tandem_state.h>

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

struct Has_gain {
  const Shared_moments* sums;

  CGAL_TANDEM_HD bool operator()(std::uint32_t id) const { return sums[id].count != 0; }
};

struct Move_gains {
  const std::uint32_t* id;
  Shared_moments* sums;
  Gain* gain;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    gain[i] = {id[i], 0, sums[id[i]]};
    sums[id[i]] = Shared_moments();
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

// After the pass: the sums of the shapes with a gain, by id.
template <class Backend>
std::vector<Gain> take_gains(Tandem_state<Backend>& t, std::size_t ids)
{
  const auto id = t.backend.compact(ids, Has_gain{t.gain.data()});
  typename Backend::template Buffer<Gain> buffer(id.size());
  t.backend.for_each(id.size(), Move_gains{id.data(), t.gain.data(), buffer.data()});
  std::vector<Gain> gains(id.size());
  t.backend.to_host(buffer.data(), gains.size(), gains.data());
  return gains;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GAINS_H
