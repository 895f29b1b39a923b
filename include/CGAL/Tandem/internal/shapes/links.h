// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes touch: the edges of the neighbor graph between their points. Sets the interior bits of points, and
// clears is_changed of shapes where only links of changed shapes are asked for; nothing else.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_LINKS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_LINKS_H

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

#include <functional>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A pair of shapes and the number of edges of the neighbor graph between their points.
struct Link {
  std::uint64_t pair; // smaller id << 32 | larger id
  std::uint32_t count;
  std::uint32_t gap = 0; // fills the padding, so that all bytes are defined where links are copied

  std::uint32_t first() const { return std::uint32_t(pair >> 32); }
  std::uint32_t second() const { return std::uint32_t(pair); }
};

using Link_list = Unset_vector<Link>;

// Where cells append in any order. When it is full, it still counts, which gives the capacity of the next attempt.
struct Link_sink {
  Link* link;
  std::uint32_t* size;
  std::uint32_t capacity;
};

// The links of a cell: one slot for each of 256 hashes. A pair whose slot belongs to another one is appended at once,
// so a pair may come several times. The sums join these, so results do not depend on it.
struct Link_scratch {
  static constexpr std::uint32_t slots = 256;
  Link link[slots];
};

// Counts the edges from points of selected shapes to points of other shapes, cell by cell. An edge is directed, from a
// point to one of its k neighbors. So a pair of selected shapes has its edges of both directions. Labels do not
// change meanwhile, and a cell writes states of its own points only.
template <class Backend>
struct Collect_links {
  Cloud_view cloud;
  Cells_view cells;
  Labels_view labels;
  const std::uint8_t* is_selected; // by shape
  Link_sink sink;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Link_scratch& scratch, std::uint32_t c) const
  {
    if(!cells.shapes[c].may_have(block, [&](std::uint32_t s) { return is_selected[s] != 0; }))
      return;
    const Range cell = cells[c];
    block.for_each(Link_scratch::slots, [&](std::uint32_t i) { scratch.link[i] = {~std::uint64_t(0), 0}; });
    block.for_each(cell.size(), [&](std::uint32_t at) { visit(block, scratch, cell.first + at); });
    block.for_each(Link_scratch::slots, [&](std::uint32_t i) {
      if(scratch.link[i].count > 0)
        append(scratch.link[i]);
    });
  }

private:
  CGAL_TANDEM_HD void append(const Link& link) const
  {
    const std::uint32_t place = Backend::atomic_add(*sink.size, 1u);
    if(place < sink.capacity)
      sink.link[place] = link;
  }

  // The point i, by one lane. Multiplicative hashing: ids of touching shapes are often close to each other.
  template <class Block>
  CGAL_TANDEM_HD void visit(Block& block, Link_scratch& scratch, std::uint32_t i) const
  {
    const std::uint32_t s = labels.label[i];
    if(s >= first_mark || !is_selected[s] || (labels.state[i] & interior_bit))
      return;
    const std::uint32_t* row = cloud.row(i);
    bool all_same = true;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = labels.label[row[j]];
      all_same = all_same && t == s;
      if(t >= first_mark || t == s)
        continue;
      const std::uint64_t pair = s < t ? std::uint64_t(s) << 32 | t : std::uint64_t(t) << 32 | s;
      const std::uint32_t slot = std::uint32_t((pair * 0x9e3779b97f4a7c15u) >> 56);
      if(!block.count_pair(scratch.link[slot].pair, scratch.link[slot].count, pair))
        append({pair, 1});
    }
    if(all_same)
      labels.state[i] |= interior_bit;
  }
};

// All touching shapes, or only those of which one has changed since its links were last collected.
enum class Links { all, changed };

// The sums of n links in the memory of the back end, where a pair may come several times. Kept are pairs with at least
// `minimum` edges, by falling number of edges, then by ids. This order is total, so that of the input has no influence.
template <class Backend>
Link_list sum_links_on_host(Backend& backend, const Link* source, std::size_t n, std::uint32_t minimum)
{
  Link_list links(n);
  backend.to_host(source, n, links.data());
  backend.sort_on_host(links.begin(), links.end(), [](const Link& a, const Link& b) { return a.pair < b.pair; });
  std::size_t kept = 0;
  for(std::size_t i = 0; i < n;) {
    Link sum = {links[i].pair, 0};
    for(; i < n && links[i].pair == sum.pair; ++i)
      sum.count += links[i].count;
    if(sum.count >= minimum)
      links[kept++] = sum;
  }
  std::vector<std::uint64_t> order(kept); // count, most first, then place among the sorted pairs
  for(std::size_t i = 0; i < kept; ++i)
    order[i] = std::uint64_t(~links[i].count) << 32 | i;
  backend.sort_on_host(order.begin(), order.end(), std::less<std::uint64_t>());
  Link_list sorted(kept);
  backend.for_each_on_host(kept, [&](std::size_t i) { sorted[i] = links[std::uint32_t(order[i])]; });
  return sorted;
}

// The same, or what the back end has in its place. ids: more than the largest id.
template <class Backend>
Link_list sum_links(Backend& backend, const Link* source, std::size_t n, std::size_t ids, std::uint32_t minimum)
{
  if constexpr(Stage_overrides<Backend>::sums_links)
    return Stage_overrides<Backend>::sum_links(backend, source, n, ids, minimum);
  else {
    static_cast<void>(ids);
    return sum_links_on_host(backend, source, n, minimum);
  }
}

// The links between live shapes with enough edges to touch, by falling number of edges, then by ids. While a device
// counts edges, the host does `meanwhile`. That changes neither labels nor which shapes are live or changed. If the
// links do not fit, the cells are counted again with room for them. Interior points found by then have no links, so
// none is lost.
template <class Backend, class Work = Nothing>
Link_list collect_links(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Links which,
                        Work meanwhile = Work())
{
  Backend& backend = points.backend;
  std::vector<std::uint8_t> is_selected(shapes.size(), 0);
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    Shape& shape = shapes[shapes.live[l]];
    is_selected[shapes.live[l]] = which == Links::all || shape.is_changed;
    shape.is_changed = shape.is_changed && which == Links::all;
  });
  const auto selected = backend.read_access(is_selected);
  std::size_t capacity = 4 * shapes.live.size() + 64 * points.number_of_cells();
  for(bool is_first = true;; is_first = false) {
    typename Backend::template Buffer<Link> links(capacity);
    std::vector<std::uint32_t> size(1, 0);
    auto counter = backend.read_write_access(size);
    backend.template for_each_cell<Link_scratch>(
      points.number_of_cells(), Collect_links<Backend>{points.cloud.view(),
                                                       points.cells_view(),
                                                       points.labels(),
                                                       selected.data(),
                                                       {links.data(), counter.data(), std::uint32_t(capacity)}});
    if(is_first)
      meanwhile();
    counter.copy_back();
    if(size[0] <= capacity)
      return sum_links(backend, links.data(), size[0], shapes.size(), tuning::merging::minimum_edges);
    capacity = 2 * std::size_t(size[0]);
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_LINKS_H
