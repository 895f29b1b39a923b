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

#include <CGAL/Tandem/internal/rounds/unite_shapes.h>
#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>
#include <CGAL/Tandem/internal/rounds/join_members.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Make_candidate {
  const std::uint32_t* member;
  const std::uint32_t* target; // of the unions
  const Union_root* root;
  const Fitted_moments* whole;
  Regular_plane* candidate;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    candidate[i] = whole[root[root_of(target, member[i])].place].local;
  }
};

// Members that accept the plane of their union: see join_members().
struct Accepting_members {
  const std::uint32_t* member;
  const double* share; // by member
  double misfit_share;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return share[i] <= misfit_share; }
  CGAL_TANDEM_HD std::uint32_t id(std::uint32_t i) const { return member[i]; }
};

// How a merge goes on: the largest share of misfits of a shape that joins a union, and memory for samples.
template <class Backend>
struct Joint_fit_merge {
  double misfit_share;
  Sample_memory<Backend>& memory;
};

// The shapes of `links` that become one: the members that accept the plane of their union. The largest of these stays,
// of equal ones that with the smallest id.
template <class Backend>
Targets<Backend> joint_fit_targets(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                   const Shape_unions<Backend>& unions, const Joint_fit_merge<Backend>& merge)
{
  Backend& backend = points.backend;
  const std::size_t n = unions.member.size();
  typename Backend::template Buffer<Regular_plane> candidates(n);
  backend.for_each(n,
                   Make_candidate{unions.member.data(), unions.target.data(), unions.root.data(), unions.whole.data(),
                                  candidates.data()},
                   shapes_per_thread);
  const auto shares = Misfit_counter<Backend>(points, shapes, options, unions.member, merge.memory)
                        .shares(shapes, unions.member, candidates);
  return join_members(backend, shapes, n, Accepting_members{unions.member.data(), shares.data(), merge.misfit_share},
                      unions.target.data());
}

struct Relabel_link {
  const std::uint32_t* target;
  Link* link;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    link[i].pair = unordered_pair(target[link[i].first()], target[link[i].second()]);
  }
};

// Joint-fit merge of all touching shapes. Returns the targets of the merge; an empty table if
// no joint plane was tried. The links then have the new ids. A pair may have several links, or become a pair of one
// shape with itself.
template <class Backend>
Targets<Backend> merge_by_joint_fit(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                    const Options& options, typename Backend::template Buffer<Link>& links,
                                    const Joint_fit_merge<Backend>& merge)
{
  Backend& backend = points.backend;
  require(points, shapes, tables::fits | tables::lists);
  const Shape_unions<Backend> unions =
    unite_shapes(backend, points.ranks, shapes, {options.squared_cosine, options.maximum_distance}, links);
  if(unions.member.size() == 0)
    return {};
  Targets<Backend> target = joint_fit_targets(points, shapes, options, unions, merge);
  merge_points(points, shapes, target);
  backend.for_each(links.size(), Relabel_link{target.data(), links.data()});
  return target;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_BY_JOINT_FIT_H
