// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes have points in which leaf. Most passes between two growth passes are
// about some of the shapes, so they visit only the leaves that have points of those.

#ifndef CGAL_TANDEM_INTERNAL_LEAF_SHAPES_H
#define CGAL_TANDEM_INTERNAL_LEAF_SHAPES_H

#include <CGAL/Tandem/internal/Tandem_state.h>

namespace CGAL {
namespace Tandem {
namespace internal {

struct List_scratch {
  static constexpr std::uint32_t slots = 2 * Leaf_shapes::capacity;
  std::uint32_t shape[slots];
};

struct List_shapes {
  const Range* cells;
  const std::uint32_t* label;
  Leaf_shapes* list;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, List_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    Leaf_shapes& shapes = list[c];
    block.single([&] { shapes.size = 0; });
    block.for_each(List_scratch::slots, [&](std::uint32_t i) { scratch.shape[i] = no_index; });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t s = label[cell.first + at];
      if(s < first_mark && is_new(block, scratch, s)) {
        const std::uint32_t place = block.append(shapes.size);
        if(place < Leaf_shapes::capacity)
          shapes.shape[place] = s;
      }
    });
  }

private:
  // Where the table is full, every shape counts as new: the list has overflown by then.
  template <class Block>
  CGAL_TANDEM_HD static bool is_new(Block& block, List_scratch& scratch, std::uint32_t s)
  {
    for(std::uint32_t probe = 0; probe < List_scratch::slots; ++probe) {
      const std::uint32_t old = block.exchange_if(scratch.shape[(s + probe) % List_scratch::slots], no_index, s);
      if(old == no_index || old == s)
        return old == no_index;
    }
    return true;
  }
};

// To be called when points have got new labels. Points that lose theirs may stay listed.
template <class Backend>
void list_shapes(Tandem_state<Backend>& t)
{
  t.leaf_shapes.resize(t.cells.size());
  t.backend.template for_each_cell<List_scratch>(t.cells.size(),
                                                 List_shapes{t.cells.data(), t.label.data(), t.leaf_shapes.data()});
}

// The same after points have been relabeled, by old label.
template <class Backend>
void relabel_lists(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& target)
{
  for(Leaf_shapes& list : t.leaf_shapes) {
    if(list.size > Leaf_shapes::capacity)
      continue;
    std::uint32_t kept = 0;
    for(std::uint32_t i = 0; i < list.size; ++i)
      if(target[list.shape[i]] < first_mark)
        list.shape[kept++] = target[list.shape[i]];
    list.size = kept;
  }
}

// Whether there may be points of a shape that is asked for.
template <class Predicate>
bool may_have(const Leaf_shapes& list, Predicate is_asked)
{
  return list.size > Leaf_shapes::capacity || std::any_of(list.shape, list.shape + list.size, is_asked);
}

// Of the ranges of all leaves, those that may have points of shapes that are asked for.
template <class Backend, class Predicate>
std::vector<Range> ranges_of(const Tandem_state<Backend>& t, const std::vector<Range>& range, Predicate is_asked)
{
  std::vector<Range> ranges;
  for(std::size_t c = 0; c < t.cells.size(); ++c)
    if(may_have(t.leaf_shapes[c], is_asked))
      ranges.push_back(range[c]);
  return ranges;
}

template <class Backend, class Predicate>
std::vector<Range> leaves_of(const Tandem_state<Backend>& t, Predicate is_asked)
{
  return ranges_of(t, t.cells, is_asked);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_LEAF_SHAPES_H
