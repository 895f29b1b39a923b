// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Passes over the labeled points between two growth passes: which shapes touch,
// which points a plane would lose, and the points that shapes give up.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_POINT_PASSES_H
#define CGAL_TANDEM_INTERNAL_SHAPES_POINT_PASSES_H

#include <CGAL/Tandem/internal/memory/Unset_vector.h>
#include <CGAL/Tandem/internal/shapes/cell_shapes.h>

#include <algorithm>
#include <functional>

namespace CGAL {
namespace Tandem {
namespace internal {

// A pair of shapes and the number of neighbor relations between their points.
struct Link {
  std::uint64_t pair; // smaller id << 32 | larger id
  std::uint32_t count;
  std::uint32_t gap = 0; // without it there were bytes that nobody writes

  std::uint32_t first() const { return std::uint32_t(pair >> 32); }
  std::uint32_t second() const { return std::uint32_t(pair); }
};

using Link_list = Unset_vector<Link>;

// Where cells append in any order. Goes on counting when it is full.
struct Link_sink {
  Link* link;
  std::uint32_t* size;
  std::uint32_t capacity;
};

struct Link_scratch {
  static constexpr std::uint32_t slots = 256;
  Link link[slots];
};

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

// All touching shapes, or only those of which one has changed since they were last asked for.
enum class Links { all, changed };

// The sums of n links in the memory of the back end, of ids below `ids`, where a pair has several: those of at least
// `least` relations, by falling number of relations, then by ids. A back end may have an overload of its own.
template <class Backend>
Link_list sum_links(Backend& backend, const Link* source, std::size_t n, std::size_t, std::uint32_t minimum)
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

// The links between live shapes with at least `least` relations, by falling
// number of relations, then by ids. While a device looks at the points, the host does
// `meanwhile`, which changes neither labels, nor which shapes are live or changed.
template <class Backend, class Work = Nothing>
Link_list collect_links(Tandem_state<Backend>& t, std::uint32_t minimum, Links which, Work meanwhile = Work())
{
  std::vector<std::uint8_t> is_selected(t.shapes.size(), 0);
  t.backend.for_each_on_host(t.live.size(), [&](std::size_t l) {
    Shape& shape = t.shapes[t.live[l]];
    is_selected[t.live[l]] = which == Links::all || shape.is_changed;
    shape.is_changed = false;
  });
  const auto selected = t.backend.read_access(is_selected);
  std::size_t capacity = 4 * t.live.size() + 64 * t.number_of_cells;
  for(bool is_first = true;; is_first = false) {
    typename Backend::template Buffer<Link> links(capacity);
    std::vector<std::uint32_t> size(1, 0);
    auto counter = t.backend.read_write_access(size);
    t.backend.template for_each_cell<Link_scratch>(
      t.number_of_cells,
      Collect_links<Backend>{
        t.cloud, t.cells_view(), t.labels(), selected.data(), {links.data(), counter.data(), std::uint32_t(capacity)}});
    if(is_first)
      meanwhile();
    counter.copy_back();
    if(size[0] <= capacity)
      return sum_links(t.backend, links.data(), size[0], t.shapes.size(), minimum);
    capacity = 2 * std::size_t(size[0]);
  }
}

// Numbers of points of a cell, by shape or whatever they are counted by. A key whose
// slot another one has is counted in the table of all at once.
struct Count_scratch {
  static constexpr std::uint32_t slots = 64;
  std::uint32_t key[slots];
  std::uint32_t count[slots];

  template <class Block>
  CGAL_TANDEM_HD void clear(Block& block)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      key[i] = no_index;
      count[i] = 0;
    });
  }

  template <class Backend, class Block>
  CGAL_TANDEM_HD void add(Block& block, std::uint32_t k, std::uint32_t* total)
  {
    const std::uint32_t slot = k % slots;
    const std::uint32_t owner = block.exchange_if(key[slot], no_index, k);
    if(owner == no_index || owner == k)
      block.append(count[slot]);
    else
      Backend::atomic_add(total[k], 1u);
  }

  template <class Backend, class Block>
  CGAL_TANDEM_HD void flush(Block& block, std::uint32_t* total)
  {
    block.for_each(slots, [&](std::uint32_t i) {
      if(count[i] > 0)
        Backend::atomic_add(total[key[i]], count[i]);
    });
  }
};

struct Update_scratch {
  Moment_table table;
  std::uint32_t labels[Cell_shapes::capacity];
};

// Gives each point the label `target` of its shape. Where that is a mark the shape
// is given up; where the shape is checked, points that do not fit are detached.
template <class Backend>
struct Update_points {
  Cloud_view cloud;
  const Range* cells;
  Cell_shapes* lists;
  Labels_view labels;
  const std::uint32_t* target; // these two by old label
  const std::uint8_t* is_checked;
  const Plane* plane; // these two by new label
  Shared_moments* loss;
  Tolerance tolerance;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Update_scratch& scratch, std::uint32_t c) const
  {
    if(!lists[c].may_have(block, [&](std::uint32_t s) { return target[s] != s || is_checked[s] != 0; }))
      return;
    relabel_list(block, lists[c], target, scratch.labels);
    const Range cell = cells[c];
    const Grid_point& base = cloud.point[cell.first];
    Moment_table& table = scratch.table;
    table.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      const std::uint32_t old = labels.label[i];
      if(old >= first_mark)
        return;
      const std::uint32_t s = target[old];
      if(s >= first_mark) {
        labels.label[i] = s;
        labels.state[i] = std::uint8_t((labels.state[i] | failed_seed_bit) & ~(frontier_bit | interior_bit));
      } else if(is_checked[old] && !fits(plane[s], cloud.point[i], tolerance)) {
        labels.label[i] = labels.state[i] & detached_bit ? locked_label : free_label;
        labels.state[i] = std::uint8_t((labels.state[i] | detached_bit) & ~(frontier_bit | interior_bit));
        table.template add<Backend>(block, s, cloud.point[i], base, -1, loss);
      } else if(s != old) {
        labels.label[i] = s;
      }
    });
    table.template flush<Backend>(block, base, loss);
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_POINT_PASSES_H
