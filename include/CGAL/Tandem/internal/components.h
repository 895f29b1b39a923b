// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components of the points of each shape in the 2-hop neighbor graph: two
// points are adjacent if one is a neighbor of the other, or both are neighbors of
// one point.

#ifndef CGAL_TANDEM_INTERNAL_COMPONENTS_H
#define CGAL_TANDEM_INTERNAL_COMPONENTS_H

#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/Shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Union-find over points. A root is the smallest position of its component, so
// the result does not depend on the order of the unions; threads may race for an
// entry, and then the loser goes on from what it finds there.
template <class Backend>
struct Unite_neighbors {
  Cloud_view cloud;
  const std::uint32_t* label;
  std::uint32_t* parent;

  CGAL_TANDEM_HD void operator()(std::size_t r) const
  {
    const std::uint32_t* row = cloud.row(std::uint32_t(r));
    for(int j = -1; j < cloud.k; ++j) {
      const std::uint32_t q = at(row, std::uint32_t(r), j);
      if(q == no_index)
        return;
      if(label[q] >= first_mark)
        continue;
      for(int i = -1; i < j; ++i) { // the first point of the row with this label stands for all
        const std::uint32_t p = at(row, std::uint32_t(r), i);
        if(label[p] != label[q])
          continue;
        unite(p, q);
        break;
      }
    }
  }

private:
  CGAL_TANDEM_HD static std::uint32_t at(const std::uint32_t* row, std::uint32_t r, int j)
  {
    return j < 0 ? r : row[j];
  }

  CGAL_TANDEM_HD std::uint32_t root(std::uint32_t i) const
  {
    for(;;) {
      const std::uint32_t up = Backend::atomic_load(parent[i]);
      if(up == i)
        return i;
      const std::uint32_t above = Backend::atomic_load(parent[up]);
      if(above != up)
        Backend::atomic_min(parent[i], above); // halves the path; entries only ever fall
      i = up;
    }
  }

  CGAL_TANDEM_HD void unite(std::uint32_t a, std::uint32_t b) const
  {
    a = root(a);
    b = root(b);
    while(a != b) {
      if(a < b) {
        const std::uint32_t swapped = a;
        a = b;
        b = swapped;
      }
      if(Backend::atomic_exchange_if(parent[a], a, b) == a)
        return;
      a = root(a);
    }
  }
};

struct Own_component {
  std::uint32_t* component;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { component[i] = std::uint32_t(i); }
};

template <class Backend>
struct Find_root {
  std::uint32_t* component;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    std::uint32_t root = component[i];
    while(Backend::atomic_load(component[root]) != root)
      root = Backend::atomic_load(component[root]);
    Backend::atomic_min(component[i], root);
  }
};

// component[i] is the smallest position of the component of point i. Free points
// are components of their own.
template <class Backend>
void find_components(Backend& backend, const Cloud_view& cloud, const std::uint32_t* label, std::uint32_t* component)
{
  backend.for_each(cloud.size, Own_component{component});
  backend.for_each(cloud.size, Unite_neighbors<Backend>{cloud, label, component});
  backend.for_each(cloud.size, Find_root<Backend>{component});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_COMPONENTS_H
