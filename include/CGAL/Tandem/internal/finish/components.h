// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components of the surfels of each shape: which pieces of a plane become separate shapes. Two surfels are
// adjacent if one is a neighbor of the other, or both are neighbors of one surfel. Reads labels and neighbors and
// writes one table of roots. See the manual, "Components".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_COMPONENTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_COMPONENTS_H

#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/finish/Border_components.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>

#include <algorithm>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The components themselves.

// The entries of a union-find in the scratch of one cell, which only the lanes of its block change. Indices are
// relative to the cell.
template <class Block>
struct Cell_parents {
  Block& block;
  std::uint32_t* parent;

  CGAL_TANDEM_HD std::uint32_t load(std::uint32_t i) const { return block.load(parent[i]); }
  CGAL_TANDEM_HD void lower(std::uint32_t i, std::uint32_t value) const { block.fetch_min(parent[i], value); }
  CGAL_TANDEM_HD bool set(std::uint32_t i, std::uint32_t value) const
  {
    return block.exchange_if(parent[i], i, value) == i;
  }
};

// The edges of the graph whose components are searched, row by row of the neighbor graph. The surfels of a row with one
// label are adjacent in pairs. A star around the first of them connects the same surfels with fewer edges.
struct Adjacency {
  Cloud_view cloud;
  const std::uint32_t* label;

  // Calls unite(p, q) for the neighbors q of r. p is r itself, or the first neighbor of r with the label of q. Both are
  // in the range; free surfels and surfels out of the range are skipped.
  template <class Unite>
  CGAL_TANDEM_HD void operator()(std::uint32_t r, const Range& range, Unite unite) const
  {
    const std::uint32_t* row = cloud.row(r);
    const std::uint32_t own = label[r];
    std::uint32_t shape = no_index, first = no_index; // of other labels, the last one and its first neighbor
    for(int j = 0; j < cloud.k; ++j) {
      const std::uint32_t q = row[j];
      if(q - range.first >= range.size()) // also where a row ends
        continue;
      const std::uint32_t t = label[q];
      if(t >= first_mark)
        continue;
      if(t != own && t != shape) {
        shape = t;
        first = first_neighbor(row, t, range);
      }
      unite(t == own ? r : first, q); // a surfel is in the range with its neighbors
    }
  }

private:
  // There is one.
  CGAL_TANDEM_HD std::uint32_t first_neighbor(const std::uint32_t* row, std::uint32_t s, const Range& range) const
  {
    while(*row - range.first >= range.size() || label[*row] != s)
      ++row;
    return *row;
  }
};

// One entry for each surfel of a cell. Its size is that of the largest cell, in two variants: see small_cell.
template <std::uint32_t CellSize>
struct Union_scratch {
  std::uint32_t parent[CellSize]; // relative to the cell
};

// The components within each cell, in fast memory: most edges are there. Large components then have as many roots as
// cells, so few threads contend for one of them. Writes component[i] of the surfels of the cell, as a position in the
// cloud.
struct Unite_in_cell {
  Adjacency adjacency;
  const Range* cells;
  std::uint32_t* component;

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    const Union_find<Cell_parents<Block>> points = {{block, scratch.parent}};
    // Lanes that run at the same time begin with a forest of short paths, so that few edges join two trees.
    constexpr bool has_lanes = Block::lookahead > 1;
    block.for_each(cell.size(),
                   [&](std::uint32_t at) { scratch.parent[at] = has_lanes ? first_before(cell, at) : at; });
    if(has_lanes)
      block.for_each(cell.size(), [&](std::uint32_t at) { points.parents.lower(at, points.root(at)); });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      adjacency(cell.first + at, cell,
                [&](std::uint32_t p, std::uint32_t q) { points.unite(p - cell.first, q - cell.first); });
    });
    block.for_each(cell.size(), [&](std::uint32_t at) { component[cell.first + at] = cell.first + points.root(at); });
  }

private:
  // The nearest neighbor in the cell with the same label and a smaller position, or the surfel itself.
  CGAL_TANDEM_HD std::uint32_t first_before(const Range& cell, std::uint32_t at) const
  {
    const std::uint32_t i = cell.first + at, own = adjacency.label[i];
    const std::uint32_t* row = adjacency.cloud.row(i);
    for(int j = 0; own < first_mark && j < adjacency.cloud.k && row[j] != no_index; ++j)
      if(row[j] - cell.first < at && adjacency.label[row[j]] == own)
        return row[j] - cell.first;
    return at;
  }
};

// Pairs of roots that a cell has met already, by their hash. The counts are required by count_pair() and not used.
struct Pair_scratch {
  static constexpr std::uint32_t slots = 256;
  std::uint64_t pair[slots];
  std::uint32_t count[slots];
};

// Adds the edges that lead out of a cell: those in the rows of surfels with a neighbor in another cell. Most of them
// join the same few pairs of roots, so each noted pair is united once, at the end. Pairs that find no slot are united
// at once.
template <class Backend>
struct Unite_at_border {
  Adjacency adjacency;
  const Range* border_of; // of each cell, in `border`
  const std::uint32_t* border;
  std::uint32_t* component;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Pair_scratch& scratch, std::uint32_t c) const
  {
    constexpr std::uint64_t none = ~std::uint64_t(0);
    const Union_find<Shared_parents<Backend>> points = {{component}};
    const Range range = border_of[c];
    block.for_each(Pair_scratch::slots, [&](std::uint32_t i) { scratch.pair[i] = none; });
    const auto note = [&](std::uint32_t p, std::uint32_t q) {
      p = points.parents.load(p);
      q = points.parents.load(q);
      if(p == q)
        return;
      const std::uint64_t pair = std::uint64_t(p) << 32 | q;
      const std::uint32_t slot = std::uint32_t(hash_of_pair(pair) >> 56);
      if(!block.count_pair(scratch.pair[slot], scratch.count[slot], pair))
        points.unite(p, q); // the slot holds another pair
    };
    block.for_each(range.size(), [&](std::uint32_t b) {
      adjacency(border[range.first + b], {0, adjacency.cloud.size + adjacency.cloud.ghosts}, note);
    });
    block.for_each(Pair_scratch::slots, [&](std::uint32_t i) {
      if(scratch.pair[i] != none)
        points.unite(std::uint32_t(scratch.pair[i] >> 32), std::uint32_t(scratch.pair[i]));
    });
  }
};

// Makes component[i] the root of i. Other items shorten their paths at the same time; no root changes any more, so all
// read the same one.
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

// component[i] becomes the smallest position, on this rank, of the component of surfel i; free surfels are components
// of their own. Ghosts have entries, too.
// label: of any kind, by surfel, with marks for free surfels. Takes nearly linear time.
template <class Backend>
Border_components<Backend> find_components(Labeled_cloud<Backend>& points, std::size_t cell_size,
                                           const std::uint32_t* label, std::uint32_t* component)
{
  Backend& backend = points.backend;
  const std::size_t cells = points.number_of_cells();
  const Adjacency adjacency = {points.cloud.view(), label};
  const Unite_in_cell inside = {adjacency, points.cells.data(), component};
  if(cell_size <= small_cell)
    backend.template for_each_cell<Union_scratch<small_cell>>(cells, inside);
  else
    backend.template for_each_cell<Union_scratch<largest_cell>>(cells, inside);
  // Ghosts begin as components of their own.
  backend.for_each(points.cloud.ghosts, Fill_ascending{component + points.cloud.number_of_surfels(),
                                                       std::uint32_t(points.cloud.number_of_surfels())});
  // The unions of the cells are complete here, so that roots from all cells can be joined.
  const Border<Backend>& border = points.border;
  backend.template for_each_cell<Pair_scratch>(
    cells, Unite_at_border<Backend>{adjacency, border.range.data(), border.surfel.data(), component});
  backend.for_each(points.cloud.size_with_ghosts(), Find_root<Backend>{component});
  Border_components<Backend> borders(backend, points.ranks);
  borders.find(adjacency.cloud, label, component);
  return borders;
}

// --- Which components become shapes: those with at least the minimum number of points. Also their order in the result.
// Reads labels and components, changes nothing.

// Adds the labeled points of each cell to their components: size[r] for the root r. Counts are gathered in the cell
// first, because all surfels of a face have the same root. Integer sums, so the order does not matter.
template <class Backend>
struct Count_components {
  const Range* cells;
  Labels_of_points labels;
  const std::uint32_t* component;
  std::uint32_t* size;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    scratch.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      std::uint32_t points = 0;
      labels.for_each_point(cell.first + at, [&](std::uint32_t) { ++points; });
      if(points > 0)
        scratch.template add<Backend>(block, component[cell.first + at], points, size);
    });
    scratch.template flush<Backend>(block, size);
  }
};

// The components that are large enough, by their roots. A free surfel is a root of its own, and excluded by its label.
struct Take_large {
  const std::uint32_t* label;
  const std::uint32_t* component;
  const std::uint32_t* size;
  std::uint64_t minimum;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const
  {
    return component[i] == i && label[i] < first_mark && size[i] >= minimum;
  }
  CGAL_TANDEM_HD Component take(std::uint32_t i) const { return {i, label[i], size[i]}; }
};

static_assert(free_label == no_index, "what has no number is free");

// A surfel gets the number that its key has in a table, or becomes free. Free surfels stay so.
struct Take_number {
  const std::uint32_t* label;
  const std::uint32_t* key;    // by surfel
  const std::uint32_t* number; // by key; no_index if there is none
  std::uint32_t* chosen;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { chosen[i] = label[i] < first_mark ? number[key[i]] : label[i]; }
};

// Writes the entry of each component to its root, where its surfels find it.
struct Number_roots {
  const Component* component;
  std::uint32_t* number; // by root

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(component[i].root != no_index)
      number[component[i].root] = component[i].entry;
  }
};

// The components of the surfels with these labels that have enough points, by falling number of points, then by
// position of the root: they are found in that order. component: see find_components().
template <class Backend>
std::vector<Component> large_components(Labeled_cloud<Backend>& points, const Stage_parameters& options,
                                        const Labels_of_points& labels, std::uint32_t* component)
{
  Backend& backend = points.backend;
  const std::size_t n = points.cloud.number_of_surfels();
  auto borders = find_components(points, options.growth.cell_size, labels.label, component);
  auto size = filled_buffer(backend, n, std::uint32_t(0));
  backend.template for_each_cell<Count_scratch>(
    points.number_of_cells(), Count_components<Backend>{points.cells.data(), labels, component, size.data()});
  borders.sum_sizes(n, size.data());
  std::vector<Component> components = borders.join_large(backend.template collect_on_host<Component>(
    n, Take_large{labels.label, component, size.data(), std::uint64_t(options.minimum_region_size)}));
  std::stable_sort(components.begin(), components.end(),
                   [](const Component& a, const Component& b) { return a.size > b.size; });
  return components;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_COMPONENTS_H
