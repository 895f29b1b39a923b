// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pass of the end game, while planes are fixed: shapes absorb the free points around them.

#ifndef CGAL_TANDEM_INTERNAL_ABSORB_H
#define CGAL_TANDEM_INTERNAL_ABSORB_H

#include <CGAL/Tandem/internal/backend/Host_loan.h>
#include <CGAL/Tandem/internal/update_shapes.h>

#include <algorithm>
#include <type_traits>
#include <vector>

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

// Later rounds: only the points that were absorbed in the last one have news.
template <class Backend>
struct Offer_again {
  Offer<Backend> offer;
  Offered absorbed;
  std::size_t items; // that this is called with

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::size_t first = absorbed.end[0], size = absorbed.end[1] - first, k = std::size_t(offer.cloud.k);
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

// Rounds in which free points accept offers, and then pass on those of the shapes that they have joined.
template <class Backend>
struct Absorption {
  Offer<Backend> offer; // the first one, which has been made
  Labels_view labels;
  Offered offered;
  std::size_t few;

  CGAL_TANDEM_HD Accept_offers accept(std::size_t round, std::size_t items) const
  {
    return {labels, offer.offer, of_round(round), items};
  }

  // After accept(): whether next to no point has joined a shape.
  CGAL_TANDEM_HD bool is_last(std::size_t round) const { return offered.end[round + 1] - offered.end[round] <= few; }

  CGAL_TANDEM_HD Offer_again<Backend> offer_again(std::size_t round, std::size_t items) const
  {
    Offer<Backend> next = offer;
    next.end = offered.end + round + 2;
    return {next, of_round(round), items};
  }

private:
  CGAL_TANDEM_HD Offered of_round(std::size_t round) const { return {offered.point, offered.end + round}; }
};

// A device has an overload of its own: here the host sees what functors have written.
template <class Backend>
void run_rounds(Backend& backend, std::size_t most_rounds, const Absorption<Backend>& rounds)
{
  static_assert(std::is_base_of<Host_memory, Backend>::value, "a device needs an overload");
  const std::size_t items = (std::min)(std::size_t(rounds.offer.cloud.size), std::size_t(1) << 18);
  for(std::size_t round = 0; round < most_rounds; ++round) {
    backend.for_each(items, rounds.accept(round, items));
    if(rounds.is_last(round))
      return;
    backend.for_each(items, rounds.offer_again(round, items));
  }
}

// Free points join the shapes that they fit, until next to none does.
template <class Backend>
void absorb(Tandem_state<Backend>& t)
{
  constexpr std::size_t most_rounds = 16;
  const std::size_t n = t.cloud.size, few = n / 100000;
  typename Backend::template Buffer<std::uint64_t> offer(n);
  typename Backend::template Buffer<std::uint32_t> offered(n);
  std::vector<std::uint32_t> end(most_rounds + 2, 0); // the host does not look at it again
  const auto plane = t.backend.lend(t.plane);
  const auto ends = t.backend.lend_out(end);
  t.backend.for_each(n, Clear_offers{offer.data()});
  const Offer<Backend> first = {t.cloud,        t.label.data(), t.state.data(),
                                plane.data(),   offer.data(),   t.options.growth.tolerance,
                                offered.data(), ends.data() + 1};
  t.backend.for_each(n, first);
  run_rounds(t.backend, most_rounds, {first, t.labels(), {offered.data(), ends.data()}, few});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ABSORB_H
