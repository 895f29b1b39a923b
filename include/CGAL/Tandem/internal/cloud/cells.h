// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The octree cells, which are ranges of the sorted cloud. They do not depend on the order of the caller's points, nor
// on how many ranks share them.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_CELLS_H
#define CGAL_TANDEM_INTERNAL_CLOUD_CELLS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/cloud/sort_along_curve.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// The level of octants that are not split, however many points they have: that of the curve, or the one with as many
// surfels as a cell may have, each cube of them with all six faces. Larger cubes are at most a seventh more within the
// octant, and one of each size around it.
inline int last_level(const Code_frame& frame, std::size_t cell_size)
{
  int level = curve_bits;
  const std::size_t around = 6 * std::size_t(frame.octaves);
  if(frame.has_surfels())
    for(std::size_t cubes = 8; 6 * cubes + (around > 0 ? around + cubes : 0) <= cell_size; cubes *= 8)
      level = level == curve_bits ? curve_bits - 2 : level - 1;
  return level;
}

// Whether an octant of this level, with so many points, is a leaf of the octree. See cell_extent_bits for its width.
inline bool is_leaf(const Code_frame& frame, int level, std::uint64_t points, std::size_t cell_size)
{
  return level >= last_level(frame, cell_size) ||
         (points <= cell_size && curve_bits - level + frame.shift <= cell_extent_bits);
}

// Appends the cells of a leaf. A leaf is one cell, but a finest octant of more points than a cell may have is cut, unless
// these are surfels.
inline void append_cells(const Range& leaf, std::size_t cell_size, std::vector<Range>& cells)
{
  for(std::uint32_t first = leaf.first; first < leaf.last; first += std::uint32_t(cell_size))
    cells.push_back({first, (std::min)(first + std::uint32_t(cell_size), leaf.last)});
}

// A cube, 2^(21 - level) finest octants wide: codes from `code` on.
struct Octant {
  std::uint64_t code;
  std::uint64_t total; // points, of all ranks
  Range own;           // points of this rank, in the order of codes
  int level;

  // Where leaves of more points are cut: finest octants.
  std::size_t number_of_cells(std::size_t cell_size) const
  {
    return level < curve_bits ? 1 : std::size_t((total + cell_size - 1) / cell_size);
  }
};

// Writes where the eight octants of octant i begin, and the end, to bound[9 i] ... bound[9 i + 8]. Each is found by
// bisection, since codes ascend; no point is visited.
template <class Table>
struct Find_octants {
  Table order;
  const Octant* octant;
  int bits; // of a code, below the eight
  std::uint32_t* bound;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const Octant& o = octant[at / 9];
    const std::uint64_t first = (o.code >> bits) + at % 9;
    bound[at] =
      partition_point(o.own.first, o.own.last, [&](std::uint32_t i) { return (order.key(i) >> bits) < first; });
  }
};

// The octants of these, all at once, so that a device has one launch a level.
template <class Backend>
std::vector<Octant> children_of(Backend& backend, const typename Backend::Sort_table& order,
                                const std::vector<Octant>& parents)
{
  using Table = typename Backend::Sort_table::View;
  const int level = parents.front().level + 1, bits = 3 * (curve_bits - level);
  const auto octants = to_buffer(backend, parents);
  Buffer_of<Backend, std::uint32_t> bounds(9 * parents.size());
  backend.for_each(bounds.size(), Find_octants<Table>{order.view(), octants.data(), bits, bounds.data()});
  const std::vector<std::uint32_t> bound = to_vector(backend, bounds);
  std::vector<Octant> children;
  std::vector<std::uint64_t> sizes;
  for(std::size_t i = 0; i < bound.size(); ++i)
    if(i % 9 < 8) {
      children.push_back({parents[i / 9].code + (std::uint64_t(i % 9) << bits), 0, {bound[i], bound[i + 1]}, level});
      sizes.push_back(children.back().own.size());
    }
  sizes = Ranks<Backend>(backend).total(std::move(sizes));
  for(std::size_t i = 0; i < sizes.size(); ++i)
    children[i].total = sizes[i];
  return children;
}

// The leaves of the octree of all ranks, by code. The first octant with all points is split until a leaf has at most
// cell_size points and is at most 2^23 steps wide. See cell_extent_bits for that bound. All ranks have the same list.
template <class Backend>
std::vector<Octant> find_leaves(Backend& backend, const typename Backend::Sort_table& order, const Code_frame& frame,
                                std::size_t cell_size)
{
  std::vector<Octant> leaves, level = {{0,
                                        Ranks<Backend>(backend).total(order.size()),
                                        {0, std::uint32_t(order.size())},
                                        (std::min)(frame.first_level, last_level(frame, cell_size))}};
  for(;;) {
    std::vector<Octant> open;
    for(const Octant& o : level)
      if(o.total > 0)
        (is_leaf(frame, o.level, o.total, cell_size) ? leaves : open).push_back(o);
    if(open.empty())
      break;
    level = children_of(backend, order, open);
  }
  std::sort(leaves.begin(), leaves.end(), [](const Octant& a, const Octant& b) { return a.code < b.code; });
  return leaves;
}

// The cells of a sorted cloud, as ascending ranges that cover the points of this rank, which has whole leaves. Points of
// one finest octant are cut in the order of the sort, unless they are surfels; such an octant is never too wide.
template <class Backend>
std::vector<Range> split_cells(Backend& backend, const typename Backend::Sort_table& order, const Code_frame& frame,
                               std::size_t cell_size)
{
  std::vector<Range> cells;
  for(const Octant& leaf : find_leaves(backend, order, frame, cell_size))
    append_cells(leaf.own, frame.has_surfels() ? leaf.own.size() : cell_size, cells);
  return cells;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_CELLS_H
