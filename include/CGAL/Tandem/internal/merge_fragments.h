// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joint-fit merge: touching shapes that one plane fits as well as their own planes
// become one shape. Without it slanted surfaces are cut into terraces.

#ifndef CGAL_TANDEM_INTERNAL_MERGE_FRAGMENTS_H
#define CGAL_TANDEM_INTERNAL_MERGE_FRAGMENTS_H

#include <CGAL/Tandem/internal/Misfit_counter.h>

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
class Clusters {
public:
  Clusters(const std::vector<Shape>& shapes, const Joint_fit_test& test)
    : unions_(shapes.size()), shapes_(shapes), test_(test), whole_(shapes.size(), -1)
  {}

  void unite_along(const std::vector<Link>& links)
  {
    for(const Link& link : links)
      try_to_unite(unions_.root(link.first()), unions_.root(link.second()));
    for(Whole& w : merged_)
      refresh(w);
  }

  std::uint32_t root(std::uint32_t id) { return unions_.root(id); }

  const Fitted_moments& whole(std::uint32_t root) const
  {
    return whole_[root] < 0 ? static_cast<const Fitted_moments&>(shapes_[root]) : merged_[std::size_t(whole_[root])];
  }

private:
  struct Whole : Fitted_moments {
    std::int64_t fitted_count; // points when it was fitted
  };

  // The larger one, then the one with the smaller id, stays the root.
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
        if(whole_[c] >= 0)
          refresh(merged_[std::size_t(whole_[c])]);
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
    if(whole_[root] < 0) {
      whole_[root] = int(merged_.size());
      merged_.push_back({shapes_[root], shapes_[root].moments.count});
    }
    return merged_[std::size_t(whole_[root])];
  }

  static void refresh(Whole& w)
  {
    if(w.fitted_count == w.moments.count)
      return;
    refit(w);
    w.fitted_count = w.moments.count;
  }

  Unions unions_;
  const std::vector<Shape>& shapes_;
  const Joint_fit_test test_;
  std::vector<int> whole_; // index into merged_, by root
  std::vector<Whole> merged_;
};

// The targets of a joint-fit merge along the links. Of each union, shapes of which
// more than the given share of points does not fit the joint plane are left out.
template <class Backend>
std::vector<std::uint32_t> joint_fit_targets(Tandem_state<Backend>& t, const std::vector<Link>& links,
                                             double misfit_share)
{
  Clusters clusters(t.shapes, {t.options.squared_cosine, t.options.maximum_distance});
  clusters.unite_along(links);
  std::vector<std::uint32_t> ids;
  std::vector<Regular_plane> planes;
  for(std::uint32_t id : t.live) {
    const Fitted_moments& whole = clusters.whole(clusters.root(id));
    if(whole.moments.count == t.shapes[id].moments.count)
      continue;
    ids.push_back(id);
    planes.push_back(whole.local);
  }
  std::vector<std::uint32_t> target = identity_targets(t);
  if(ids.empty())
    return target;
  const std::vector<double> shares = Misfit_counter<Backend>{t, ids}(ids, planes);
  std::vector<std::uint32_t> first(t.shapes.size(), no_index); // per root: the member that stays
  for(std::size_t i = 0; i < ids.size(); ++i) {
    if(shares[i] > misfit_share)
      continue;
    std::uint32_t& stays = first[clusters.root(ids[i])];
    if(stays == no_index || t.shapes[stays].moments.count < t.shapes[ids[i]].moments.count)
      stays = ids[i];
  }
  for(std::size_t i = 0; i < ids.size(); ++i)
    if(shares[i] <= misfit_share)
      target[ids[i]] = first[clusters.root(ids[i])];
  return target;
}

// Joint-fit merge of all touching shapes; the links follow. Returns whether there was any.
template <class Backend>
bool merge_fragments(Tandem_state<Backend>& t, std::vector<Link>& links, double misfit_share)
{
  const std::vector<std::uint32_t> target = joint_fit_targets(t, links, misfit_share);
  bool is_any = false;
  for(std::uint32_t id : t.live)
    is_any = is_any || target[id] != id;
  if(!is_any)
    return false;
  merge_shapes(t, target);
  update_points(t, target, std::vector<std::uint8_t>(t.shapes.size(), 0));
  refit_shapes(t);
  for(Link& link : links) {
    const std::uint32_t a = target[link.first()], b = target[link.second()];
    link.pair = a < b ? std::uint64_t(a) << 32 | b : std::uint64_t(b) << 32 | a;
  }
  return true;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MERGE_FRAGMENTS_H
