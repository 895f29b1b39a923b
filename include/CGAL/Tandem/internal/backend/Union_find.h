// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Union-find by many lanes at the same time, without locks.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_UNION_FIND_H
#define CGAL_TANDEM_INTERNAL_BACKEND_UNION_FIND_H

#include <CGAL/Tandem/internal/base/types.h>

#include <cstdint>

namespace CGAL::Tandem::internal {

// An entry never exceeds its index and only ever falls, so there are no cycles.
// A root is the smallest index of its set, whatever the order of the unions. Where threads race for a root, one
// succeeds, and the others go on from the value that they find.
template <class Parents>
struct Union_find {
  Parents parents;

  // The root of i at some time during the call. It may have got a parent when the call returns.
  CGAL_TANDEM_HD std::uint32_t root(std::uint32_t i) const
  {
    for(;;) {
      const std::uint32_t up = parents.load(i);
      if(up == i)
        return i;
      const std::uint32_t above = parents.load(up);
      if(above != up)
        parents.lower(i, above); // halves the path
      i = up;
    }
  }

  // Attaches the larger root to the smaller one. set() fails if the larger one is no root any more; then both are
  // searched again.
  CGAL_TANDEM_HD void unite(std::uint32_t a, std::uint32_t b) const
  {
    a = parents.load(a);
    b = parents.load(b);
    while(a != b) { // nearly all pairs have the same parent already
      a = root(a);
      b = root(b);
      if(a < b) {
        const std::uint32_t swapped = a;
        a = b;
        b = swapped;
      }
      if(a == b || parents.set(a, b))
        return;
    }
  }
};

// The root of i in sets that do not change meanwhile.
CGAL_TANDEM_HD inline std::uint32_t root_of(const std::uint32_t* parent, std::uint32_t i)
{
  while(parent[i] != i)
    i = parent[i];
  return i;
}

// The entries of a union-find in the memory of the back end, which all cells change at the same time.
template <class Backend>
struct Shared_parents {
  std::uint32_t* parent;

  CGAL_TANDEM_HD std::uint32_t load(std::uint32_t i) const { return Backend::atomic_load(parent[i]); }
  CGAL_TANDEM_HD void lower(std::uint32_t i, std::uint32_t value) const { Backend::atomic_min(parent[i], value); }
  CGAL_TANDEM_HD bool set(std::uint32_t i, std::uint32_t value) const
  {
    return Backend::atomic_exchange_if(parent[i], i, value) == i;
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_UNION_FIND_H
