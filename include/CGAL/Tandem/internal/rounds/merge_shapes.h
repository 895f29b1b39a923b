// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Touching shapes become one where that gains: see Union_gain.h. Without it slanted surfaces are cut into terraces.
// Shapes that have the same plane merge elsewhere, in merge_coplanar.h. Changes the table of shapes, labels, states and
// lists of cells, and the links.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_SHAPES_H

#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/rounds/join_members.h>
#include <CGAL/Tandem/internal/rounds/unite_shapes.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// All members of unions: see join_members().
struct Members_of_unions {
  const std::uint32_t* member;

  CGAL_TANDEM_HD bool has(std::uint32_t) const { return true; }
  CGAL_TANDEM_HD std::uint32_t id(std::uint32_t i) const { return member[i]; }
};

struct Relabel_link {
  const std::uint32_t* target;
  Link* link;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    link[i].pair = unordered_pair(target[link[i].first()], target[link[i].second()]);
  }
};

// Of a union, the largest shape stays, of equal ones that with the smallest id. The links then have the new ids. A pair
// may have several links, or become a pair of one shape with itself.
template <class Backend>
void merge_by_gain(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                   typename Backend::template Buffer<Link>& links)
{
  Backend& backend = points.backend;
  require(points, shapes, tables::fits);
  auto samples = sample_shapes(points, shapes);
  const Shape_unions<Backend> unions =
    unite_shapes(backend, points.ranks, shapes, {Union_gain(options), samples}, links);
  if(unions.member.size() == 0)
    return;
  const Targets<Backend> target =
    join_members(backend, shapes, unions.member.size(), Members_of_unions{unions.member.data()}, unions.target.data());
  merge_points(points, shapes, target);
  backend.for_each(links.size(), Relabel_link{target.data(), links.data()});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_SHAPES_H
