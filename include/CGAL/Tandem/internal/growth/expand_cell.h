// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Breadth-first growth of the shapes that have points in a cell, with their planes fixed. A cell reads and writes
// labels and states of its own points only, so cells need no order. See the manual, "Growth".

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_EXPAND_CELL_H
#define CGAL_TANDEM_INTERNAL_GROWTH_EXPAND_CELL_H

#include <CGAL/Tandem/internal/backend/concepts.h>
#include <CGAL/Tandem/internal/growth/Cell_job.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Changed are labels, states, the seed cursor, the new shapes and the sums.
struct Growth_input {
  Cell_job job;
  Cloud_view cloud;
  Shapes_view shapes;
  Labels_view labels;
  Growth_options options;
};

// All members are called by all lanes of the block, but for those that are called within its functors. The queue has
// the points that have been visited in this pass: first the frontier, then the points that shapes took. Its order is
// arbitrary, but steps of growth are ranges of it.
template <class Backend, class Block, class Scratch>
class Cell_expansion {
  static_assert(Is_block<Block>::value, "the block is no model of the concept Block");

public:
  CGAL_TANDEM_HD Cell_expansion(Block& block, Scratch& scratch, const Growth_input& in)
    : block_(block), s_(scratch), job_(in.job), cloud_(in.cloud), shapes_(in.shapes), options_(in.options),
      label_(in.labels.label), state_(in.labels.state)
  {}

  // Queues the points from which shapes go on: those whose neighbors were not visited yet, and all of restarted shapes.
  CGAL_TANDEM_HD void collect_frontier()
  {
    block_.for_each(job_.cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = job_.cell.first + at;
      // Most points of late rounds are on no frontier; without restarts their labels are not read.
      const bool is_on = state_[i] & frontier_bit;
      if((!is_on && !job_.has_restarted) || label_[i] >= first_mark || !(is_on || shapes_.is_restarted[label_[i]]))
        return;
      state_[i] |= frontier_bit;
      push(i);
    });
  }

  // The only way for shapes of other cells to come in. Proposals were made before any cell grew.
  CGAL_TANDEM_HD void join_proposals()
  {
    block_.for_each(job_.border_size, [&](std::uint32_t b) {
      const std::uint32_t i = job_.border[b];
      if(job_.proposal[b] == no_index)
        return;
      label_[i] = job_.proposal[b];
      state_[i] |= frontier_bit;
      push(i);
    });
  }

  // Breadth-first steps, the first one from [head, tail) of the queue. A free point that several shapes reach in one
  // step goes to the smallest id. Points that a shape reaches in its last step stay on the frontier for the next pass.
  CGAL_TANDEM_HD void expand(std::uint32_t head, std::uint32_t tail)
  {
    for(int step = 0; head < tail; ++step) {
      block_.for_each_neighbor(
        tail - head, cloud_.k, [&](std::uint32_t source) { return row_if_going_on(head + source, step); },
        [&](std::uint32_t source, std::uint32_t q) { propose(label_[queued(head + source)], q); });
      const std::uint32_t sources = tail - head;
      // Claims become labels only now, so that all shapes of a step start from the same labels.
      block_.for_each(s_.tail - head, [&](std::uint32_t at) {
        const std::uint32_t i = queued(head + at);
        if(at >= sources) {
          label_[i] &= ~first_mark;
          state_[i] |= frontier_bit;
        } else if(step < shapes_.steps[label_[i]])
          state_[i] &= std::uint8_t(~frontier_bit);
      });
      head = tail;
      tail = s_.tail;
    }
  }

  // Adds [first, last) of the queue to the sums of the shapes: the points that came in this pass.
  CGAL_TANDEM_HD void add_deltas(std::uint32_t first, std::uint32_t last)
  {
    s_.table.clear(block_);
    const Cell_sums sums = {cloud_.surfels, base(), shapes_.delta};
    block_.for_each(last - first, [&](std::uint32_t at) {
      const std::uint32_t i = queued(first + at);
      s_.table.template add<Backend>(block_, label_[i], i, 1, sums);
    });
    s_.table.template flush<Backend>(block_, sums);
  }

protected:
  // The origin of the moments of this cell. Any of its points would do.
  CGAL_TANDEM_HD const Grid_point& base() const { return cloud_.point[job_.cell.first]; }

  // By one lane. There is room, since no point is queued twice.
  CGAL_TANDEM_HD void push(std::uint32_t i) { s_.queue[block_.append(s_.tail)] = std::uint16_t(i - job_.cell.first); }

  // The position of the point at a place of the queue.
  CGAL_TANDEM_HD std::uint32_t queued(std::uint32_t place) const { return job_.cell.first + s_.queue[place]; }

  // False for no_index.
  CGAL_TANDEM_HD bool is_own(std::uint32_t q) const { return q >= job_.cell.first && q < job_.cell.last; }

  // Null where the shape has used up its steps of this pass.
  CGAL_TANDEM_HD const std::uint32_t* row_if_going_on(std::uint32_t place, int step) const
  {
    const std::uint32_t i = queued(place);
    return step < shapes_.steps[label_[i]] ? cloud_.row(i) : nullptr;
  }

  // Of shape s to point q, by one lane. Claims are marked, and become labels at the end of the step. Another lane may
  // lower the label after it was read here. That is harmless: within a step labels only fall, and the minimum remains.
  // Only the first claim replaces free_label, so a point is queued once.
  CGAL_TANDEM_HD void propose(std::uint32_t s, std::uint32_t q)
  {
    if(!is_own(q))
      return;
    const std::uint32_t claim = first_mark | s;
    const std::uint32_t old = label_[q];
    if(old < first_mark || old <= claim || old == locked_label || !cloud_.fits(shapes_.plane[s], q, options_.tolerance))
      return;
    if(block_.fetch_min(label_[q], claim) == free_label)
      push(q);
  }

  Block& block_;
  Scratch& s_;
  const Cell_job job_;
  const Cloud_view cloud_;
  const Shapes_view shapes_;
  const Growth_options options_;
  std::uint32_t* label_;
  std::uint8_t* state_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_EXPAND_CELL_H
