// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sets of shapes that become one: the largest stays, of equal ones that with the smallest id. Changes nothing.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_JOIN_MEMBERS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_JOIN_MEMBERS_H

#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What a set of shapes becomes; the order of the members does not matter.
struct Stays {
  std::uint64_t size = ~std::uint64_t(0); // ~ of the points of the largest shape
  std::uint32_t id = no_index;
};

// Three loops over the members of all sets, since each needs all of the one before.
template <class Backend, class Members>
struct Join_member {
  enum Step { largest, smallest_id, join } step;
  const Shape* shape;
  Members members;
  const std::uint32_t* set; // by id: leads to the root of the set
  Stays* stays;             // by root
  std::uint32_t* target;    // by id

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(!members.has(std::uint32_t(i)))
      return;
    const std::uint32_t id = members.id(std::uint32_t(i));
    Stays& s = stays[root_of(set, id)];
    const std::uint64_t size = ~std::uint64_t(shape[id].moments.count);
    if(step == largest)
      Backend::atomic_min(s.size, size);
    else if(step == smallest_id && size == s.size)
      Backend::atomic_min(s.id, id);
    else if(step == join)
      target[id] = s.id;
  }
};

// The targets of members.id(i) for the i in [0, n) with members.has(i); all other shapes stay.
template <class Backend, class Members>
Targets<Backend> join_members(Backend& backend, const Shape_table<Backend>& shapes, std::size_t n, Members members,
                              const std::uint32_t* set)
{
  using Body = Join_member<Backend, Members>;
  Targets<Backend> target = identity_targets(backend, shapes.size);
  auto stays = filled_buffer(backend, shapes.size, Stays());
  for(const auto step : {Body::largest, Body::smallest_id, Body::join})
    backend.for_each(n, Body{step, shapes.counted(), members, set, stays.data(), target.data()});
  return target;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_JOIN_MEMBERS_H
