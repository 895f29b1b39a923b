// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides which shapes merge because they touch and have the same plane. Changes nothing: the caller merges shapes and
// points. See the manual, "Unions", last paragraph.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_COPLANAR_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_COPLANAR_H

#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/rounds/join_members.h>
#include <CGAL/Tandem/internal/shapes/links.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Live shapes with a plane of the relations, as members of sets: see join_members().
struct Shapes_with_plane {
  const Shape* shape;

  CGAL_TANDEM_HD bool has(std::uint32_t id) const { return shape[id].is_live() && shape[id].plane_number >= 0; }
  CGAL_TANDEM_HD std::uint32_t id(std::uint32_t i) const { return i; }
};

// Unites the shapes of a link that have one plane.
template <class Backend>
struct Unite_coplanar {
  const Shape* shape;
  const Link* link;
  std::uint32_t* set;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t a = link[i].first(), b = link[i].second();
    if(shape[a].plane_number >= 0 && shape[a].plane_number == shape[b].plane_number)
      Union_find<Shared_parents<Backend>>{{set}}.unite(a, b);
  }
};

// The targets of that merge. Planes are compared by their number in the relations, so equal ones are the same bits.
template <class Backend>
Targets<Backend> coplanar_targets(Backend& backend, const Shape_table<Backend>& shapes,
                                  const typename Backend::template Buffer<Link>& links)
{
  Targets<Backend> set = identity_targets(backend, shapes.size);
  backend.for_each(links.size(), Unite_coplanar<Backend>{shapes.table().data(), links.data(), set.data()});
  return join_members(backend, shapes, shapes.size, Shapes_with_plane{shapes.counted()}, set.data());
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_COPLANAR_H
