// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joint-fit merge: touching shapes that one plane fits as well as their own planes
// become one shape. Without it slanted surfaces are cut into terraces.

#ifndef CGAL_TANDEM_INTERNAL_MERGE_FRAGMENTS_H
#define CGAL_TANDEM_INTERNAL_MERGE_FRAGMENTS_H

#include <CGAL/Tandem/internal/Misfit_counter.h>

#include <atomic>
#include <new>

namespace CGAL {
namespace Tandem {
namespace internal {

// Fewest neighbor relations between two shapes that touch.
constexpr std::uint32_t least_links = 2;
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
    const double most = tolerated_rms * maximum_distance, little = negligible_rms * maximum_distance;
    const double more = excess(m.scatter, m.fit, plane);
    return more <= most * most * m.scatter.count && more <= std::fma(little * little, m.scatter.count, m.fit.smallest);
  }

  bool operator()(const Fitted_moments& a, const Fitted_moments& b, Fitted_moments& joint) const
  {
    joint.moments = a.moments;
    joint.moments += b.moments;
    refit(joint);
    return is_tolerable(a, joint.local) && is_tolerable(b, joint.local);
  }
};

// Unions of shapes with the moments of the whole. A small shape that tolerates the plane of
// a large one joins it without a new fit: the plane of both together is not worse for it.
// The large one is fitted again when it has grown by a quarter.
template <class Backend>
class Clusters {
public:
  Clusters(Tandem_state<Backend>& t, const Joint_fit_test& test)
    : t_(t), unions_(t.shapes.size()), test_(test), whole_(t.shapes.size(), no_index), merged_(t.live.size())
  {}

  // Tries link after link, or as if: a link depends on those before it that have a cluster in
  // common with it, so the first ones of both of their clusters are tried at a time.
  void unite_along(const std::vector<Link>& links)
  {
    std::vector<Pair> pending(links.size());
    for(std::size_t i = 0; i < links.size(); ++i)
      pending[i] = {links[i].first(), links[i].second()};
    std::vector<Pair> first;
    std::vector<std::uint32_t> seen(t_.shapes.size(), 0); // by cluster: the last step in which it had a link
    for(std::uint32_t step = 1; pending.size() >= least_links_of_step; ++step) {
      first.clear();
      take_first(step, seen, pending, first);
      t_.backend.for_each_on_host(first.size(), [&](std::size_t i) { try_to_unite(first[i].a, first[i].b); });
      if(first.size() * least_share_of_step < pending.size())
        break;
    }
    for(const Pair& p : pending)
      try_to_unite(unions_.root(p.a), unions_.root(p.b));
    for(std::uint32_t id = 0; id < t_.shapes.size(); ++id)
      unions_.set_parent(id, unions_.root(id)); // so that threads may ask for it
    t_.backend.for_each_on_host(number_of_merged_, [&](std::size_t i) { refresh(merged_[i]); });
  }

  // Whether others are in its cluster.
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
  };

  // One step takes a pass over what is pending.
  static constexpr std::size_t least_links_of_step = 256;
  static constexpr std::size_t least_share_of_step = 32;

  // Moves the links that are the first ones of both of their clusters; drops those within a cluster.
  void take_first(std::uint32_t step, std::vector<std::uint32_t>& seen, std::vector<Pair>& pending,
                  std::vector<Pair>& first)
  {
    std::size_t kept = 0;
    for(const Pair& p : pending) {
      const Pair roots = {unions_.root(p.a), unions_.root(p.b)};
      if(roots.a == roots.b)
        continue;
      if(seen[roots.a] != step && seen[roots.b] != step)
        first.push_back(roots);
      else
        pending[kept++] = roots;
      seen[roots.a] = seen[roots.b] = step;
    }
    pending.resize(kept);
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
  std::vector<std::uint32_t> whole_; // index into merged_, by root
  Host_buffer<Whole> merged_;
  std::atomic<std::uint32_t> number_of_merged_{0};
};

// The targets of a joint-fit merge along the links. Of each union, shapes of which
// more than the given share of points does not fit the joint plane are left out.
template <class Backend>
std::vector<std::uint32_t> joint_fit_targets(Tandem_state<Backend>& t, const std::vector<Link>& links,
                                             double misfit_share)
{
  Clusters<Backend> clusters(t, {t.options.squared_cosine, t.options.maximum_distance});
  clusters.unite_along(links);
  std::vector<std::uint32_t> ids;
  for(std::uint32_t id : t.live)
    if(clusters.is_merged(id))
      ids.push_back(id);
  std::vector<std::uint32_t> target = identity_targets(t);
  if(ids.empty())
    return target;
  std::vector<Regular_plane> planes(ids.size());
  std::vector<std::int64_t> sizes(ids.size());
  t.backend.for_each_on_host(ids.size(), [&](std::size_t i) {
    planes[i] = clusters.whole(clusters.root(ids[i])).local;
    sizes[i] = t.shapes[ids[i]].moments.count;
  });
  const std::vector<double> shares = Misfit_counter<Backend>{t, ids}(ids, planes);
  std::vector<std::size_t> first(t.shapes.size(), ids.size()); // per root: the member that stays
  for(std::size_t i = 0; i < ids.size(); ++i) {
    if(shares[i] > misfit_share)
      continue;
    std::size_t& stays = first[clusters.root(ids[i])];
    if(stays == ids.size() || sizes[stays] < sizes[i])
      stays = i;
  }
  for(std::size_t i = 0; i < ids.size(); ++i)
    if(shares[i] <= misfit_share)
      target[ids[i]] = ids[first[clusters.root(ids[i])]];
  return target;
}

// Joint-fit merge of all touching shapes; the links follow. Returns whether there was any.
template <class Backend>
bool merge_fragments(Tandem_state<Backend>& t, std::vector<Link>& links, double misfit_share)
{
  const std::vector<std::uint32_t> target = joint_fit_targets(t, links, misfit_share);
  const bool is_any =
    std::any_of(t.live.begin(), t.live.end(), [&](std::uint32_t id) { return target[id] != id; });
  if(!is_any)
    return false;
  merge_shapes(t, target);
  update_points(t, target, std::vector<std::uint8_t>(t.shapes.size(), 0));
  refit_shapes(t);
  t.backend.for_each_on_host(links.size(), [&](std::size_t i) {
    const std::uint32_t a = target[links[i].first()], b = target[links[i].second()];
    links[i].pair = a < b ? std::uint64_t(a) << 32 | b : std::uint64_t(b) << 32 | a;
  });
  return true;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MERGE_FRAGMENTS_H
