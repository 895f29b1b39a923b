// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides which shapes merge because they touch and have the same plane. Changes nothing: the caller merges shapes and
// points. See the manual, "Merging by Joint Fit", last paragraph.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_COPLANAR_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_COPLANAR_H

#include <CGAL/Tandem/internal/rounds/Unions.h>
#include <CGAL/Tandem/internal/rounds/Shape_relations.h>
#include <CGAL/Tandem/internal/shapes/links.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The targets of that merge. The shape with most points, then the one with the smallest id, is the root. Planes are
// compared by their number in the relations, so equal ones are the same bits.
template <class Backend>
Targets coplanar_targets(Backend& backend, const Shape_table<Backend>& shapes, const Shape_relations& r,
                         const Link_list& links)
{
  std::vector<int> plane_of(shapes.size(), -1);
  for(std::size_t i = 0; i < r.id.size(); ++i)
    plane_of[r.id[i]] = r.relations.plane_of[i];
  // All threads find the links within a plane. One thread makes the unions, in the order of the links.
  const auto itself = [](std::size_t i) { return std::uint32_t(i); };
  const Ids coplanar = part_on_host(backend, links.size(), itself, [&](std::uint32_t i) {
                         const int plane = plane_of[links[i].first()];
                         return plane >= 0 && plane == plane_of[links[i].second()]; // what is united has one plane
                       }).chosen;
  Unions unions(shapes.size());
  std::vector<std::uint32_t> united;
  for(std::uint32_t i : coplanar) {
    std::uint32_t a = unions.root(links[i].first()), b = unions.root(links[i].second());
    if(a == b)
      continue;
    const std::int64_t na = shapes[a].moments.count, nb = shapes[b].moments.count;
    if(na < nb || (na == nb && b < a))
      std::swap(a, b);
    unions.set_parent(b, a);
    united.push_back(b);
  }
  Targets target = identity_targets(shapes.size());
  for(std::uint32_t id : united)
    target[id] = unions.root(id);
  return target;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MERGE_COPLANAR_H
