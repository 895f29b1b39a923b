// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions of touching shapes that one plane fits as well as their own planes, by their
// moments alone.

#ifndef CGAL_TANDEM_INTERNAL_CLUSTERS_H
#define CGAL_TANDEM_INTERNAL_CLUSTERS_H

#include <CGAL/Tandem/internal/point_passes.h>
#include <CGAL/Tandem/internal/update_shapes.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Below this size the normal of a shape says little.
constexpr std::int64_t reliable_normal_size = 30;
// How much worse, in epsilons (rms), another plane may be than the local one (R2).
constexpr double tolerated_rms = 0.5;
// In a joint fit it may also not be worse by more than the shape's own distances and
// this: a plane that bridges two narrow strips is close to both, but not as close as
// their own planes.
constexpr double negligible_rms = 0.2;

// How much the sum of squared distances grows when the shape gives up its local plane.
inline double excess(const Scatter& scatter, const Fit& fit, const Regular_plane& plane)
{
  const double e = dot(plane.normal, scatter.centroid) - plane.offset;
  return std::fma(scatter.count * e, e, quadratic_form(scatter.matrix, plane.normal)) - fit.smallest;
}

// Of moments only: no point is looked at.
struct Joint_fit_test {
  double squared_cosine;
  double maximum_distance;

  bool are_aligned(const Fitted_moments& a, const Fitted_moments& b) const
  {
    const double cosine = dot(a.fit.normal, b.fit.normal);
    return (std::min)(a.moments.count, b.moments.count) <= reliable_normal_size || cosine * cosine >= squared_cosine;
  }

  bool is_tolerable(const Fitted_moments& m, const Regular_plane& plane) const
  {
    return excess(m.scatter, m.fit, plane) <= most_excess(m);
  }

  bool operator()(const Fitted_moments& a, const Fitted_moments& b, Fitted_moments& joint) const
  {
    return !are_apart(a, b) && fit(a, b, joint);
  }

  // Whether fit() is certain to refuse them, at less cost. If it did not, the sum of squared distances of all points to
  // its plane, and so the smallest eigenvalue of their scatter matrix, would be at most `most`. The margins, relative
  // to that and to the extent, are for rounding.
  bool are_apart(const Fitted_moments& a, const Fitted_moments& b) const
  {
    const Symmetric_matrix joint = joint_matrix(a.scatter, b.scatter);
    const double most = a.fit.smallest + most_excess(a) + b.fit.smallest + most_excess(b);
    return has_eigenvalues_above(joint, std::fma(1e-8, joint.xx + joint.yy + joint.zz, 1.000001 * most));
  }

  bool fit(const Fitted_moments& a, const Fitted_moments& b, Fitted_moments& joint) const
  {
    joint.moments = a.moments;
    joint.moments += b.moments;
    refit(joint);
    return is_tolerable(a, joint.local) && is_tolerable(b, joint.local);
  }

private:
  // How much the sum of squared distances may grow.
  double most_excess(const Fitted_moments& m) const
  {
    const double most = tolerated_rms * maximum_distance, little = negligible_rms * maximum_distance;
    return (std::min)(most * most * m.scatter.count, std::fma(little * little, m.scatter.count, m.fit.smallest));
  }
};

// Unions of shapes with the moments of the whole. A small shape that tolerates the plane of
// a large one joins it without a new fit: the plane of both together is not worse for it.
// The large one is fitted again when it has grown by a quarter.
template <class Backend>
class Clusters {
public:
  // A step passes over all links that wait, and wakes threads: few of them are tried one by one.
  static constexpr std::size_t few_links = 256;

  Clusters(Tandem_state<Backend>& t, const Joint_fit_test& test, std::size_t few = few_links)
    : t_(t), unions_(t.shapes.size()), test_(test), few_(few), whole_(t.shapes.size(), no_index), merged_(t.live.size())
  {}

  // As if link after link were tried: a link depends on those before it that have a cluster in
  // common with it, so what depends on nothing else is tried at the same time. Returns the number of steps
  // in which that happened.
  std::uint32_t unite_along(const std::vector<Link>& links)
  {
    std::vector<Pair> pending(links.size());
    t_.backend.for_each_on_host(links.size(), [&](std::size_t i) {
      pending[i] = {links[i].first(), links[i].second(), no_index};
    });
    std::vector<Claim> claims(pending.size() > few_ ? t_.shapes.size() : 0);
    std::uint32_t steps = 0;
    for(std::size_t head = 0; head < pending.size();) {
      const std::size_t end = (std::min)(head + window, pending.size());
      bool is_worth_it = end - head > few_;
      if(is_worth_it) {
        std::vector<Pair> chained;
        const std::vector<std::uint32_t> first = chain_links(++steps, claims, pending, head, end, chained);
        const auto try_chain = [&](std::size_t c) {
          for(std::uint32_t i = first[c]; i != no_index; i = chained[i].next)
            try_to_unite(unions_.root(chained[i].a), unions_.root(chained[i].b));
        };
        t_.backend.for_each_on_host(first.size(), try_chain, few_chains);
        is_worth_it = end - head < most_waiting * chained.size();
      }
      for(; head < end && !is_worth_it; ++head)
        try_to_unite(unions_.root(pending[head].a), unions_.root(pending[head].b));
    }
    for(std::uint32_t id = 0; id < t_.shapes.size(); ++id)
      unions_.set_parent(id, unions_.root(id)); // so that threads may ask for it
    t_.backend.for_each_on_host(number_of_merged_, [&](std::size_t i) { refresh(merged_[i]); });
    return steps;
  }

  // After unite_along(), as what follows: whether others are in its cluster.
  bool is_merged(std::uint32_t id) const { return whole_[root(id)] != no_index; }

  std::uint32_t root(std::uint32_t id) const { return unions_.parent(id); }

  const Fitted_moments& whole(std::uint32_t root) const
  {
    return whole_[root] == no_index ? static_cast<const Fitted_moments&>(t_.shapes[root]) : merged_[whole_[root]];
  }

private:
  struct Whole : Fitted_moments {
    std::int64_t fitted_count; // points when it was fitted
  };

  struct Pair {
    std::uint32_t a, b;
    std::uint32_t next; // of its chain
  };

  // The chain that a cluster belongs to in a step.
  struct Claim {
    std::uint32_t step = 0;
    std::uint32_t chain = 0;
  };

  // A step looks at so many links: later ones mostly wait for them.
  static constexpr std::size_t window = 1024;
  static constexpr std::size_t few_chains = 8;    // are left to one thread
  static constexpr std::size_t most_waiting = 16; // for each link that is tried in a step

  // Moves links of [head, end) to chains without a cluster in common, and drops those within a cluster. A link goes to
  // the chain of its clusters; where they have two it waits, and so do all later links of both chains. What waits
  // stays in [head, end), with a later head. Returns where the chains begin.
  std::vector<std::uint32_t> chain_links(std::uint32_t step, std::vector<Claim>& claims, std::vector<Pair>& pending,
                                         std::size_t& head, std::size_t end, std::vector<Pair>& chained)
  {
    std::vector<std::uint32_t> first, last;
    std::vector<char> is_open; // by chain: no link of it waits
    std::size_t kept = head;
    for(std::size_t i = head; i < end; ++i) {
      const Pair roots = {unions_.root(pending[i].a), unions_.root(pending[i].b), no_index};
      if(roots.a == roots.b)
        continue;
      Claim &a = claims[roots.a], &b = claims[roots.b];
      const bool is_new = a.step != step && b.step != step;
      const std::uint32_t place = std::uint32_t(chained.size());
      if(is_new) {
        a = b = {step, std::uint32_t(first.size())};
        first.push_back(place);
        last.push_back(place);
        is_open.push_back(1);
      } else {
        if(a.step != step)
          a = b;
        if(b.step != step)
          b = a;
        if(a.chain != b.chain)
          is_open[a.chain] = is_open[b.chain] = 0;
        if(!is_open[a.chain]) {
          pending[kept++] = roots;
          continue;
        }
        last[a.chain] = chained[last[a.chain]].next = place;
      }
      chained.push_back(roots);
    }
    const auto at = [&](std::size_t i) { return pending.begin() + std::ptrdiff_t(i); };
    std::move_backward(at(head), at(kept), at(end));
    head = end - (kept - head);
    return first;
  }

  // The larger one, then the one with the smaller id, stays the root. Touches nothing but these two.
  void try_to_unite(std::uint32_t a, std::uint32_t b)
  {
    if(a == b)
      return;
    if(size(a) < size(b) || (size(a) == size(b) && b < a))
      std::swap(a, b);
    if(!test_.are_aligned(whole(a), whole(b)))
      return;
    if(4 * size(b) < size(a) && test_.is_tolerable(whole(b), whole(a).local)) {
      Whole& w = own_whole(a);
      w.moments += whole(b).moments;
      if(4 * w.moments.count > 5 * w.fitted_count)
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

  Whole& own_whole(std::uint32_t root)
  {
    if(whole_[root] == no_index) {
      whole_[root] = number_of_merged_++;
      const Shape& shape = t_.shapes[root];
      new(&merged_[whole_[root]]) Whole{shape, shape.moments.count};
    }
    return merged_[whole_[root]];
  }

  static void refresh(Whole& w)
  {
    if(w.fitted_count == w.moments.count)
      return;
    refit(w);
    w.fitted_count = w.moments.count;
  }

  Tandem_state<Backend>& t_;
  Unions unions_;
  const Joint_fit_test test_;
  const std::size_t few_;
  std::vector<std::uint32_t> whole_; // index into merged_, by root
  Host_buffer<Whole> merged_;
  std::atomic<std::uint32_t> number_of_merged_{0};
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CLUSTERS_H
