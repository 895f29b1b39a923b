// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joint-fit merge: touching shapes that one plane fits as well as their own planes
// become one shape. Without it slanted surfaces are cut into terraces.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_FRAGMENTS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_FRAGMENTS_H

#include <CGAL/Tandem/internal/rounds/Clusters.h>
#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Fewest neighbor relations between two shapes that touch.
constexpr std::uint32_t minimum_links = 2;

// The targets of a joint-fit merge along the links. Of each union, shapes of which
// more than the given share of points does not fit the joint plane are left out.
template <class Backend>
std::vector<std::uint32_t> joint_fit_targets(Tandem_state<Backend>& t, const Link_list& links, double misfit_share)
{
  Clusters<Backend> clusters(t, {t.options.squared_cosine, t.options.maximum_distance});
  clusters.unite_along(links);
  const Ids ids = chosen_shapes(t, [&](const Shape&, std::uint32_t id) { return clusters.is_merged(id); });
  std::vector<std::uint32_t> target = identity_targets(t);
  if(ids.empty())
    return target;
  Regular_planes planes(ids.size());
  std::vector<std::int64_t> sizes(ids.size());
  t.backend.for_each_on_host(ids.size(), [&](std::size_t i) {
    planes[i] = clusters.whole(clusters.root(ids[i])).local;
    sizes[i] = t.shapes[ids[i]].moments.count;
  });
  const Unset_vector<double> shares = Misfit_counter<Backend>{t, ids}(ids, planes);
  std::vector<std::size_t> first(t.shapes.size(), ids.size()); // per root: the member that stays
  for(std::size_t i = 0; i < ids.size(); ++i) {
    if(shares[i] > misfit_share)
      continue;
    std::size_t& stays = first[clusters.root(ids[i])];
    if(stays == ids.size() || sizes[stays] < sizes[i])
      stays = i;
  }
  t.backend.for_each_on_host(ids.size(), [&](std::size_t i) {
    if(shares[i] <= misfit_share)
      target[ids[i]] = ids[first[clusters.root(ids[i])]];
  });
  return target;
}

// Joint-fit merge of all touching shapes; the links follow. Returns whether there was any.
template <class Backend>
bool merge_fragments(Tandem_state<Backend>& t, Link_list& links, double misfit_share)
{
  const std::vector<std::uint32_t> target = joint_fit_targets(t, links, misfit_share);
  const bool is_any = std::any_of(t.live.begin(), t.live.end(), [&](std::uint32_t id) { return target[id] != id; });
  if(!is_any)
    return false;
  merge_points(t, target);
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

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_FRAGMENTS_H
