// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions of touching shapes, along the links in their order, where Joint_fit_criterion.h accepts one plane for both.
// Works on the host and changes nothing but itself; merge_by_joint_fit.h tests the points and merges. See the manual,
// "Merging by Joint Fit".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_CLUSTERS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_CLUSTERS_H

#include <CGAL/Tandem/internal/rounds/Joint_fit_criterion.h>
#include <CGAL/Tandem/internal/memory/Unset_vector.h>
#include <CGAL/Tandem/internal/rounds/Unions.h>
#include <CGAL/Tandem/internal/shapes/links.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Unions of shapes with the moments of the whole. A small shape that tolerates the plane of a large one joins it
// without a new fit. The large one is fitted again when it has grown by a quarter. Joint fits stay on the host also for
// a device: each depends on those before it.
template <class Backend>
class Clusters {
public:
  // A step passes over all links that wait, and wakes threads. So this many or fewer are tried one by one.
  static constexpr std::size_t few_links = 256;

  Clusters(Backend& backend, const Shape_table<Backend>& shapes, const Joint_fit_criterion& test,
           std::size_t few = few_links)
    : backend_(backend), shapes_(shapes), unions_(shapes.size()), test_(test), few_(few), root_(shapes.size()),
      whole_(shapes.size(), no_index), merged_(shapes.live.size())
  {}

  // The result is as if link after link were tried. A link depends on earlier ones with a cluster in common; links that
  // depend on no other one are tried at the same time. Many links are rejected, and those change no cluster. Certain
  // rejections are therefore found ahead, for shapes that are not in a union yet. Fitting all links ahead would fit
  // each accepted one twice. Returns the number of parallel steps.
  std::uint32_t unite_along(const Link_list& links)
  {
    const bool is_ahead = links.size() > few_;
    Unset_vector<Pair> pending(links.size());
    backend_.for_each_on_host(links.size(), [&](std::size_t i) {
      const Shape &a = shapes_[links[i].first()], &b = shapes_[links[i].second()];
      const bool is_rejected = is_ahead && (!test_.are_aligned(a, b) || test_.are_apart(a, b));
      pending[i] = {links[i].first(), links[i].second(), no_index, is_rejected};
    });
    std::vector<Claim> claims(is_ahead ? shapes_.size() : 0);
    std::uint32_t steps = 0;
    for(std::size_t head = 0; head < pending.size();) {
      bool is_worth_it = pending.size() - head > few_;
      if(is_worth_it) {
        const std::size_t maximum = (std::min)(pending.size() - head, maximum_known);
        backend_.for_each_on_host(maximum, [&](std::size_t i) { find_clusters(pending[head + i]); });
        const std::size_t end = chain_links(++steps, claims, pending, head, head + maximum);
        const auto try_chain = [&](std::size_t c) {
          for(std::uint32_t i = chains_[c].first; i != no_index; i = chained_[i].next)
            try_link(chained_[i]);
        };
        backend_.for_each_on_host(chains_.size(), try_chain, few_chains);
        // Where most links wait for a few, as around a very large shape, steps cost more than they save.
        is_worth_it = end - head <= maximum_waiting * chained_.size();
      }
      for(const std::size_t end = (std::min)(head + window, pending.size()); head < end && !is_worth_it; ++head)
        try_link(pending[head]);
    }
    backend_.for_each_on_host(root_.size(), [&](std::size_t id) { root_[id] = unions_.find_root(std::uint32_t(id)); });
    backend_.for_each_on_host(number_of_merged_, [&](std::size_t i) { refresh(merged_[i]); });
    return steps;
  }

  // The next three are valid after unite_along(). Whether other shapes are in the cluster of this one.
  bool is_merged(std::uint32_t id) const { return whole_[root(id)] != no_index; }

  std::uint32_t root(std::uint32_t id) const { return root_[id]; }

  const Fitted_moments& whole(std::uint32_t root) const
  {
    return whole_[root] == no_index ? static_cast<const Fitted_moments&>(shapes_[root]) : merged_[whole_[root]];
  }

private:
  // A cluster of several shapes. Its moments are always those of all members; the fit may be of fewer.
  struct Whole : Fitted_moments {
    std::int64_t fitted_count; // points when it was fitted
  };

  // A link that is not decided yet.
  struct Pair {
    std::uint32_t a, b; // shapes, or roots of their clusters
    std::uint32_t next; // of its chain
    bool is_rejected;   // as long as both are what they were at first
  };

  // Links of a step that are tried one after the other, in their order. No two chains have a cluster in common. So each
  // is the work of one thread, and threads write different clusters.
  struct Chain {
    std::uint32_t part_of; // another chain, or itself
    std::uint32_t first, last;
    std::uint32_t size;
    bool is_open; // no link of it waits
  };

  // The chain that a cluster belongs to in a step.
  struct Claim {
    std::uint32_t step = 0;
    std::uint32_t chain = 0;
  };

  // A step ends when so many links are tried or wait: later ones mostly wait for them. Larger windows give fewer steps,
  // but longer chains and repeated tests of links that wait. The clusters of a few more are found ahead, as some links
  // are dropped.
  static constexpr std::size_t window = 1024, maximum_known = window * 5 / 4;
  static constexpr std::uint32_t maximum_joined = 16; // links of a chain that was two
  static constexpr std::size_t few_chains = 8;        // below this, one thread tries all chains
  static constexpr std::size_t maximum_waiting = 16;  // for each link that is tried; with more, steps do not pay

  // Moves links to chains without a cluster in common. Drops those within a cluster, and certain rejections whose
  // clusters do not occur earlier in this step. A link goes to the chain of its clusters. If they have two chains,
  // these become one; if that is too long, the link waits, and with it all later links of both chains. Visits links
  // from the head on until a window of them is tried or waits, and returns where it ends. Those that wait stay before
  // that end, in their order, with a later head. The clusters of links before `known` are known.
  std::size_t chain_links(std::uint32_t step, std::vector<Claim>& claims, Unset_vector<Pair>& pending,
                          std::size_t& head, std::size_t known)
  {
    chains_.clear();
    chained_.clear();
    std::size_t kept = head, end = head;
    for(; end < pending.size() && chained_.size() + (kept - head) < window; ++end) {
      if(end >= known)
        find_clusters(pending[end]);
      const Pair link = pending[end];
      if(link.a == link.b)
        continue;
      Claim &a = claims[link.a], &b = claims[link.b];
      // Nothing earlier in this step can change these clusters.
      if(a.step != step && b.step != step) {
        if(link.is_rejected)
          continue;
        a = b = {step, std::uint32_t(chains_.size())};
        chains_.push_back({a.chain, std::uint32_t(chained_.size()), std::uint32_t(chained_.size()), 1, true});
        chained_.push_back(link);
        continue;
      }
      if(a.step != step)
        a = b;
      if(b.step != step)
        b = a;
      Chain &chain = chain_of(a), &other = chain_of(b);
      const std::uint32_t size = chain.size + (&chain == &other ? 0 : other.size) + 1;
      const bool is_one = &chain == &other || (chain.is_open && other.is_open && size <= maximum_joined);
      if(!is_one)
        chain.is_open = other.is_open = false;
      if(!chain.is_open) {
        pending[kept++] = link;
        continue;
      }
      // What is appended did not depend on the links before it, so the order of both stays right.
      if(&chain != &other) {
        chained_[chain.last].next = std::exchange(other.first, no_index);
        chain.last = other.last;
        other.part_of = a.chain = b.chain = chain.part_of;
      }
      chain.size = size;
      chain.last = chained_[chain.last].next = std::uint32_t(chained_.size());
      chained_.push_back(link);
    }
    const auto at = [&](std::size_t i) { return pending.begin() + std::ptrdiff_t(i); };
    std::move_backward(at(head), at(kept), at(end));
    head = end - (kept - head);
    return end;
  }

  // Chains that became part of another one are few, so paths are short.
  Chain& chain_of(const Claim& claim)
  {
    std::uint32_t c = claim.chain;
    while(chains_[c].part_of != c)
      c = chains_[c].part_of;
    return chains_[c];
  }

  // By all threads, for most links of a step. The thread that makes the chains would miss its cache for each link, as
  // others have written these lines.
  void find_clusters(Pair& link) const
  {
    link.a = unions_.find_root(link.a);
    link.b = unions_.find_root(link.b);
    link.is_rejected = is_rejected(link);
  }

  // The rejection found ahead, if it is still certain: neither cluster has grown.
  bool is_rejected(const Pair& roots) const
  {
    return roots.is_rejected && whole_[roots.a] == no_index && whole_[roots.b] == no_index;
  }

  // The clusters may have changed since the link came to its chain.
  void try_link(const Pair& link)
  {
    const Pair roots = {unions_.root(link.a), unions_.root(link.b), no_index, link.is_rejected};
    if(roots.a != roots.b && !is_rejected(roots))
      try_to_unite(roots.a, roots.b);
  }

  // The larger one, then the one with the smaller id, stays the root. Reads and writes these two clusters only.
  void try_to_unite(std::uint32_t a, std::uint32_t b)
  {
    if(size(a) < size(b) || (size(a) == size(b) && b < a))
      std::swap(a, b);
    if(!test_.are_aligned(whole(a), whole(b)))
      return;
    if(tuning::merging::much_larger * size(b) < size(a) && test_.is_tolerable(whole(b), whole(a).local)) {
      Whole& w = own_whole(a);
      w.moments += whole(b).moments;
      if(tuning::merging::refit_growth.is_exceeded(w.moments.count, w.fitted_count))
        refresh(w);
    } else {
      for(std::uint32_t c : {a, b})
        if(whole_[c] != no_index)
          refresh(merged_[whole_[c]]);
      Fitted_moments joint;
      if(!test_(whole(a), whole(b), joint))
        return;
      static_cast<Fitted_moments&>(own_whole(a)) = joint;
      own_whole(a).fitted_count = joint.moments.count;
    }
    unions_.set_parent(b, a);
  }

  std::int64_t size(std::uint32_t root) const { return whole(root).moments.count; }

  // Entries of merged_ are taken in any order; nothing depends on it. A root takes at most one, so there is room.
  Whole& own_whole(std::uint32_t root)
  {
    if(whole_[root] == no_index) {
      whole_[root] = number_of_merged_++;
      const Shape& shape = shapes_[root];
      new(&merged_[whole_[root]]) Whole{shape, shape.moments.count};
    }
    return merged_[whole_[root]];
  }

  // Fits the members that joined without a fit.
  static void refresh(Whole& w)
  {
    if(w.fitted_count == w.moments.count)
      return;
    refit(w);
    w.fitted_count = w.moments.count;
  }

  Backend& backend_;
  const Shape_table<Backend>& shapes_;
  Unions unions_;
  const Joint_fit_criterion test_;
  const std::size_t few_;
  std::vector<Pair> chained_; // these two of a step: the links that are tried
  std::vector<Chain> chains_;
  std::vector<std::uint32_t> root_;  // by id, after unite_along()
  std::vector<std::uint32_t> whole_; // index into merged_, by root
  Host_buffer<Whole> merged_;
  std::atomic<std::uint32_t> number_of_merged_{0};
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_CLUSTERS_H
