// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pass of the end game, while planes are fixed: shapes absorb the free points around them.

#ifndef CGAL_TANDEM_INTERNAL_ABSORB_H
#define CGAL_TANDEM_INTERNAL_ABSORB_H

#include <CGAL/Tandem/internal/update_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr std::uint64_t no_offer = ~std::uint64_t(0);

// The free points that got offers, each once: round by round, in any order in each. Those of a round are
// [end[0], end[1]), and the next ones follow, up to end[2].
struct Offered {
  std::uint32_t* point;
  std::uint32_t* end;
};

// Offers of shapes to free points, from both ends of a neighbor relation. The
// smallest (distance, shape) wins.
template <class Backend>
struct Offer {
  Cloud_view cloud;
  const std::uint32_t* label;
  const std::uint8_t* state;
  const Plane* plane;
  std::uint64_t* offer;
  Tolerance tolerance;
  std::uint32_t* offered; // those of all rounds ...
  std::uint32_t* end;     // ... which end here

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at);
    const std::uint32_t* row = cloud.row(i);
    if(label[i] < first_mark) {
      const bool has_others = !(state[i] & is_interior);
      for(int j = 0; has_others && j < cloud.k && row[j] != no_index; ++j)
        to(row[j], label[i]);
      return;
    }
    std::uint32_t last = is_free; // most neighbors that have a shape have the same one
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t s = label[row[j]];
      if(s >= first_mark || s == last)
        continue;
      last = s;
      make(s, i);
    }
  }

  // Of the shape s to a neighbor of one of its points, if that is free.
  CGAL_TANDEM_HD void to(std::uint32_t q, std::uint32_t s) const
  {
    if(label[q] >= first_mark)
      make(s, q);
  }

private:
  CGAL_TANDEM_HD void make(std::uint32_t s, std::uint32_t i) const
  {
    if(!fits(plane[s], cloud.point[i], tolerance))
      return;
    const std::int64_t e = signed_distance(plane[s], cloud.point[i]);
    const std::uint64_t distance = std::uint64_t(e < 0 ? -e : e) >> 16; // 2^-12 steps; < 2^32 while epsilon < 2^19
    if(Backend::atomic_min(offer[i], distance << 32 | s) == no_offer)
      offered[Backend::atomic_add(*end, 1u)] = i;
  }
};

// Later rounds: only the points that were absorbed in the last one have news. Nobody is asked any more when they were
// few.
template <class Backend>
struct Offer_again {
  Offer<Backend> offer;
  Offered absorbed;
  std::size_t few;
  std::size_t items; // that this is called with

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::size_t first = absorbed.end[0], size = absorbed.end[1] - first, k = std::size_t(offer.cloud.k);
    if(size <= few)
      return;
    for(std::size_t at = i; at < size * k; at += items) {
      const std::uint32_t p = absorbed.point[first + at / k], q = offer.cloud.row(p)[at % k];
      if(q != no_index)
        offer.to(q, offer.label[p]);
    }
  }
};

struct Clear_offers {
  std::uint64_t* offer;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { offer[i] = no_offer; }
};

struct Accept_offers {
  Labels_view labels;
  std::uint64_t* offer;
  Offered offered;
  std::size_t items; // that this is called with

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::size_t first = offered.end[0], last = offered.end[1];
    if(i == 0)
      offered.end[2] = offered.end[1];
    for(std::size_t at = first + i; at < last; at += items) {
      const std::uint32_t p = offered.point[at];
      labels.label[p] = std::uint32_t(offer[p]);
      labels.state[p] &= std::uint8_t(~is_interior);
      offer[p] = no_offer;
    }
  }
};

// Free points join the shapes that they fit, until next to none does. The host looks after some rounds how many they
// were: a wait takes longer than a round.
template <class Backend>
void absorb(Tandem_state<Backend>& t)
{
  constexpr std::size_t batches = 2, rounds = 8; // in each of them
  const std::size_t n = t.cloud.size, few = n / 100000, items = (std::min)(n, std::size_t(1) << 18);
  typename Backend::template Buffer<std::uint64_t> offer(n);
  typename Backend::template Buffer<std::uint32_t> offered(n);
  std::vector<std::uint32_t> end(batches * rounds + 2, 0);
  const auto plane = t.backend.lend(t.plane);
  auto ends = t.backend.lend_out(end);
  t.backend.for_each(n, Clear_offers{offer.data()});
  Offer<Backend> make = {t.cloud,        t.label.data(), t.state.data(),
                         plane.data(),   offer.data(),   t.options.growth.tolerance,
                         offered.data(), ends.data() + 1};
  t.backend.for_each(n, make);
  for(std::size_t round = 0; round < batches * rounds; ++round) {
    const Offered now = {offered.data(), ends.data() + round};
    make.end = now.end + 2;
    t.backend.for_each(items, Accept_offers{t.labels(), offer.data(), now, items});
    t.backend.for_each(items, Offer_again<Backend>{make, now, few, items});
    if((round + 1) % rounds != 0)
      continue;
    ends.take_back();
    if(end[round + 1] - end[round] <= few)
      break;
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ABSORB_H
