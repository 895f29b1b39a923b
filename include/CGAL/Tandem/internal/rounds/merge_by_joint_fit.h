// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joint-fit merge: touching shapes that one plane fits as well as their own planes become one shape. Without it slanted
// surfaces are cut into terraces. Shapes that have the same plane merge elsewhere, in merge_coplanar.h. Whether two
// shapes merge is decided twice: by moments, in rounds of mutual choice (Mutual_unions.h, Joint_fit_criterion.h), then
// by the share of their points that misfit, in joint_fit_targets() below. Changed are the table of shapes, labels,
// states and lists of cells, the links, and the samples of the misfit counter.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_BY_JOINT_FIT_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_BY_JOINT_FIT_H

#include <CGAL/Tandem/internal/rounds/Mutual_unions.h>
#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The targets of a joint-fit merge along the links. A shape is left out of its union if the share of its misfits
// exceeds the given one. The largest of the others stays, of equal ones that with the smallest id.
template <class Backend>
Targets joint_fit_targets(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                          const Link_list& links, double misfit_share)
{
  Backend& backend = points.backend;
  const Host_buffer<Union_member> members =
    unite_shapes(backend, shapes, {options.squared_cosine, options.maximum_distance}, links);
  Targets target = identity_targets(shapes.size());
  if(members.size() == 0)
    return target;
  Ids ids(members.size());
  Regular_planes planes(ids.size());
  std::vector<std::int64_t> sizes(ids.size());
  backend.for_each_on_host(ids.size(), [&](std::size_t i) {
    ids[i] = members[i].id;
    planes[i] = members[i].plane;
    sizes[i] = shapes[ids[i]].moments.count;
  });
  const Unset_vector<double> shares = Misfit_counter<Backend>(points, shapes, options, ids).count(ids, planes);
  std::vector<std::size_t> first(shapes.size(), ids.size()); // per root: the member that stays
  for(std::size_t i = 0; i < ids.size(); ++i) {
    if(shares[i] > misfit_share)
      continue;
    std::size_t& stays = first[members[i].root];
    if(stays == ids.size() || sizes[stays] < sizes[i])
      stays = i;
  }
  backend.for_each_on_host(ids.size(), [&](std::size_t i) {
    if(shares[i] <= misfit_share)
      target[ids[i]] = ids[first[members[i].root]];
  });
  return target;
}

// Joint-fit merge of all touching shapes. Returns whether there was any. The links then have the new ids. A pair may
// have several links, or become a pair of one shape with itself.
template <class Backend>
bool merge_by_joint_fit(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                        Link_list& links, double misfit_share)
{
  const Targets target = joint_fit_targets(points, shapes, options, links, misfit_share);
  if(std::all_of(shapes.live.begin(), shapes.live.end(), [&](std::uint32_t id) { return target[id] == id; }))
    return false;
  merge_points(points, shapes, target);
  refit_shapes(points.backend, shapes);
  points.backend.for_each_on_host(links.size(), [&](std::size_t i) {
    const std::uint32_t a = target[links[i].first()], b = target[links[i].second()];
    links[i].pair = a < b ? std::uint64_t(a) << 32 | b : std::uint64_t(b) << 32 | a;
  });
  return true;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_BY_JOINT_FIT_H
