// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components of the points of each shape in the 2-hop neighbor graph: two
// points are adjacent if one is a neighbor of the other, or both are neighbors of
// one point.

#ifndef CGAL_TANDEM_INTERNAL_COMPONENTS_H
#define CGAL_TANDEM_INTERNAL_COMPONENTS_H

#include <CGAL/Tandem/internal/Tandem_state.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The entries of a union-find that all threads share, and those that a leaf has in its scratch.
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

template <class Block>
struct Leaf_parents {
  Block& block;
  std::uint32_t* parent;

  CGAL_TANDEM_HD std::uint32_t load(std::uint32_t i) const { return block.load(parent[i]); }
  CGAL_TANDEM_HD void lower(std::uint32_t i, std::uint32_t value) const { block.fetch_min(parent[i], value); }
  CGAL_TANDEM_HD bool set(std::uint32_t i, std::uint32_t value) const
  {
    return block.exchange_if(parent[i], i, value) == i;
  }
};

// Union-find over points. A root is the smallest position of its component, so
// the result does not depend on the order of the unions; threads may race for an
// entry, and then the loser goes on from what it finds there.
template <class Parents>
struct Union_find {
  Parents parents;

  CGAL_TANDEM_HD std::uint32_t root(std::uint32_t i) const
  {
    for(;;) {
      const std::uint32_t up = parents.load(i);
      if(up == i)
        return i;
      const std::uint32_t above = parents.load(up);
      if(above != up)
        parents.lower(i, above); // halves the path; entries only ever fall
      i = up;
    }
  }

  CGAL_TANDEM_HD void unite(std::uint32_t a, std::uint32_t b) const
  {
    a = parents.load(a);
    b = parents.load(b);
    while(a != b) { // next to always they have one parent already
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

// What each point ties together: itself and its neighbors, those with the same label.
struct Ties {
  Cloud_view cloud;
  const std::uint32_t* label;

  // unite(p, q) for points of the range: the first one of the row with a label stands for all.
  template <class Unite>
  CGAL_TANDEM_HD void operator()(std::uint32_t r, const Range& range, Unite unite) const
  {
    const std::uint32_t* row = cloud.row(r);
    for(int j = -1; j < cloud.k; ++j) {
      const std::uint32_t q = at(row, r, j);
      if(q == no_index)
        return;
      if(q < range.first || q >= range.last || label[q] >= first_mark)
        continue;
      for(int i = -1; i < j; ++i) {
        const std::uint32_t p = at(row, r, i);
        if(p < range.first || p >= range.last || label[p] != label[q])
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
};

template <std::uint32_t CellSize>
struct Union_scratch {
  std::uint32_t parent[CellSize]; // relative to the leaf
};

// The components within each leaf, in fast memory: most ties are there, and the few large
// components have as many roots as leaves, so that threads do not meet at one of them.
struct Unite_in_leaf {
  Ties ties;
  const Range* cells;
  std::uint32_t* component;

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    const Union_find<Leaf_parents<Block>> points = {{block, scratch.parent}};
    block.for_each(cell.size(), [&](std::uint32_t at) { scratch.parent[at] = at; });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      ties(cell.first + at, cell,
           [&](std::uint32_t p, std::uint32_t q) { points.unite(p - cell.first, q - cell.first); });
    });
    block.for_each(cell.size(), [&](std::uint32_t at) { component[cell.first + at] = cell.first + points.root(at); });
  }
};

// What the points with a neighbor in another leaf tie together.
template <class Backend>
struct Unite_at_border {
  Ties ties;
  const std::uint32_t* border;
  std::uint32_t* component;

  CGAL_TANDEM_HD void operator()(std::size_t b) const
  {
    const Union_find<Shared_parents<Backend>> points = {{component}};
    ties(border[b], {0, ties.cloud.size}, [&](std::uint32_t p, std::uint32_t q) { points.unite(p, q); });
  }
};

template <class Backend>
struct Find_root {
  std::uint32_t* component;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t parent = Backend::atomic_load(component[i]);
    std::uint32_t root = parent;
    for(std::uint32_t up; (up = Backend::atomic_load(component[root])) != root;)
      root = up;
    if(root != parent)
      Backend::atomic_min(component[i], root);
  }
};

// component[i] is the smallest position of the component of point i. Free points
// are components of their own.
template <class Backend>
void find_components(Tandem_state<Backend>& t, const std::uint32_t* label, std::uint32_t* component)
{
  const Ties ties = {t.cloud, label};
  const Unite_in_leaf inside = {ties, t.cells.data(), component};
  if(t.options.cell_size <= small_cell)
    t.backend.template for_each_cell<Union_scratch<small_cell>>(t.number_of_cells, inside);
  else
    t.backend.template for_each_cell<Union_scratch<largest_cell>>(t.number_of_cells, inside);
  t.backend.for_each(t.border.size(), Unite_at_border<Backend>{ties, t.border.data(), component});
  t.backend.for_each(t.cloud.size, Find_root<Backend>{component});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_COMPONENTS_H
