// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Growth inside one octree cell (Algorithm 2 of the paper). All shapes of the cell grow at the same time over its free
// surfels, with their planes fixed; then new shapes start. A cell reads and writes labels and states of its own surfels
// only, so cells need no order. See the manual, "Growth".

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELL_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELL_H

#include <CGAL/Tandem/internal/base/tuning/growth.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>

namespace CGAL::Tandem::internal {

// --- What the growth inside one octree cell reads and writes: shapes, seeds, and its scratch memory.

// What growth uses of the shapes during one pass: plain arrays, by shape. A cell writes the entries of its new shapes
// only; to the sums of the others all cells add atomically.
struct Shapes_view {
  Plane* plane;
  const std::uint8_t* is_restarted; // grows from all of its surfels
  Shared_moments* delta;            // what the pass adds
};

// The part of one cell in a pass. Surfels are positions in the sorted cloud.
struct Cell_job {
  Range cell;
  const std::uint32_t* border;   // its surfels with a neighbor in another cell ...
  const std::uint32_t* proposal; // ... and the shapes that they join first, or no_index
  std::uint32_t border_size;
  const std::uint32_t* seed; // candidates
  std::uint32_t seed_count;
  std::uint32_t* seed_cursor; // candidates before it are used up
  std::uint32_t new_shape;    // the ids from here on are those of new shapes
  bool has_restarted = true;  // maybe: some shape grows from all of its surfels
};

// A candidate that is tried, as in the manual, "Growth". A plane is fitted to the seed and those of its free neighbors
// that fit its own plane. Those that fit the new plane are the core of a new shape, unless they are too few.
struct Trial {
  std::uint32_t at, seed; // the seed among the candidates, and the surfel
  bool is_candidate;      // still: no shape that has begun meanwhile may reach it
  Plane plane;            // of the seed, then of the core
  Cell_moments sums;      // of the points of what fits the first ...
  std::uint32_t count;    // ... and the surfels that fit the second, ...
  std::uint32_t points;   // ... and their points
  std::uint32_t taken;    // surfels, of the seed and its neighbors, that shapes have taken since
};
// Of the blocks of all back ends: what the scratch memory has room for.
constexpr std::uint32_t maximum_lookahead = 32;

// Shared by the lanes of a block. Places in the queue are given in any order, so nothing may depend on them.
template <std::uint32_t CellSize>
struct Growth_scratch {
  std::uint16_t queue[CellSize]; // cell-relative surfels; each is queued at most once
  std::uint32_t tail;            // of the queue: its size
  Moment_table table;
  Trial trial[maximum_lookahead];
};

// --- Breadth-first growth of the shapes that have surfels in a cell, with their planes fixed. A cell reads and writes
// labels and states of its own surfels only, so cells need no order. See the manual, "Growth".

// Changed are labels, states, the seed cursor, the new shapes and the sums.
struct Growth_input {
  Cell_job job;
  Cloud_view cloud;
  Shapes_view shapes;
  Labels_view labels;
  Growth_parameters options;
};

// All members are called by all lanes of the block, but for those that are called within its functors. The queue has
// the surfels from which shapes grow in this pass: first those of restarted shapes, then those that shapes took. Its
// order is arbitrary, but steps of growth are ranges of it.
template <class Backend, class Block, class Scratch>
class Cell_growth {
  static_assert(Block::lookahead > 0 && Block::lookahead <= maximum_lookahead,
                "the scratch has no room for the trials");

public:
  CGAL_TANDEM_HD Cell_growth(Block& block, Scratch& scratch, const Growth_input& in)
    : block_(block), s_(scratch), job_(in.job), cloud_(in.cloud), shapes_(in.shapes), parameters_(in.options),
      label_(in.labels.label), state_(in.labels.state)
  {}

  // Grows the shapes of the cell, and starts new ones. Old shapes grow before new ones start, so that these do not take
  // the surfels the old ones reach. New ones take one step only, since their planes are still uncertain.
  CGAL_TANDEM_HD void run()
  {
    block_.single([&] { s_.tail = 0; });
    if(job_.has_restarted)
      collect_restarted();
    const std::uint32_t old = s_.tail; // from here on, surfels that have a shape since this pass
    join_proposals();
    for(std::uint32_t head = 0; head < s_.tail;)
      head = expand(head);
    if(*job_.seed_cursor < job_.seed_count)
      start_shapes();
    if(old < s_.tail)
      add_deltas(old, s_.tail);
  }

private:
  CGAL_TANDEM_HD void collect_restarted()
  {
    block_.for_each(job_.cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = job_.cell.first + at;
      if(label_[i] < first_mark && shapes_.is_restarted[label_[i]])
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
      push(i);
    });
  }

  // One breadth-first step, from the surfels of the queue behind `head`. Returns where the next one starts. A free
  // surfel that several shapes reach in one step goes to the smallest id.
  CGAL_TANDEM_HD std::uint32_t expand(std::uint32_t head)
  {
    const std::uint32_t tail = s_.tail;
    block_.for_each_neighbor(
      tail - head, cloud_.k, [&](std::uint32_t source) { return cloud_.row(queued(head + source)); },
      [&](std::uint32_t source, std::uint32_t q) { propose(label_[queued(head + source)], q); });
    // Claims become labels only now, so that all shapes of a step start from the same labels.
    block_.for_each(s_.tail - tail, [&](std::uint32_t at) { label_[queued(tail + at)] &= ~first_mark; });
    return tail;
  }

  // Adds [first, last) of the queue to the sums of the shapes: the surfels that came in this pass.
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

  // The origin of the moments of this cell. Any of its surfels would do.
  CGAL_TANDEM_HD const Grid_point& base() const { return cloud_.point[job_.cell.first]; }

  // By one lane. There is room, since no surfel is queued twice.
  CGAL_TANDEM_HD void push(std::uint32_t i) { s_.queue[block_.append(s_.tail)] = std::uint16_t(i - job_.cell.first); }

  // The position of the surfel at a place of the queue.
  CGAL_TANDEM_HD std::uint32_t queued(std::uint32_t place) const { return job_.cell.first + s_.queue[place]; }

  // False for no_index.
  CGAL_TANDEM_HD bool is_own(std::uint32_t q) const { return q >= job_.cell.first && q < job_.cell.last; }

  // Of shape s to surfel q, by one lane. Claims are marked, and become labels at the end of the step. Another lane may
  // lower the label after it was read here. That is harmless: within a step labels only fall, and the minimum remains.
  // Only the first claim replaces free_label, so a surfel is queued once.
  CGAL_TANDEM_HD void propose(std::uint32_t s, std::uint32_t q)
  {
    if(!is_own(q))
      return;
    const std::uint32_t claim = first_mark | s;
    const std::uint32_t old = label_[q];
    if(old < first_mark || old <= claim || old == locked_label ||
       !cloud_.fits(shapes_.plane[s], q, parameters_.tolerance))
      return;
    if(block_.fetch_min(label_[q], claim) == free_label)
      push(q);
  }

  // New shapes start at the first candidates with a core. Those without one are no seeds any more, and each costs a
  // try. A block may try several at once, as many lanes would be idle for one. The result is as if one were tried after
  // the other: where an earlier shape took surfels of a core, that candidate is tried again. Candidates in reach of a
  // new shape are left for later passes.
  CGAL_TANDEM_HD void start_shapes()
  {
    const std::uint32_t first = s_.tail, end = job_.new_shape + tuning::growth::seeds_per_cell;
    std::uint32_t at = skip_used_candidates(), shape = job_.new_shape;
    int tries = tuning::growth::seed_tries;
    while(shape < end && tries > 0) {
      const std::uint32_t size = try_candidates(at, shape);
      std::uint32_t next = 0;
      for(; next < size && shape < end && tries > 0; ++next) {
        if(!s_.trial[next].is_candidate)
          continue;
        if(s_.trial[next].taken > 0)
          break; // to be tried again
        if(!has_core(s_.trial[next])) {
          --tries;
          continue;
        }
        start_shape(s_.trial[next], shape);
        recheck_trials(shape++, next + 1, size);
      }
      // A seed is tried once, whether or not its shape could start. What is no candidate was not tried.
      block_.for_each(next, [&](std::uint32_t i) {
        if(s_.trial[i].is_candidate)
          state_[s_.trial[i].seed] |= tried_seed_bit;
      });
      if(next == size && size < Block::lookahead)
        break; // there were no more
      at = next < size ? s_.trial[next].at : s_.trial[size - 1].at + 1;
    }
    expand(first);
  }

  // Moves the cursor, so that later passes do not visit used candidates again.
  CGAL_TANDEM_HD std::uint32_t skip_used_candidates()
  {
    const std::uint32_t at =
      block_.find_first(*job_.seed_cursor, job_.seed_count, [&](std::uint32_t c) { return is_untried(job_.seed[c]); });
    block_.single([&] { *job_.seed_cursor = at; });
    return at;
  }

  CGAL_TANDEM_HD bool is_untried(std::uint32_t i) const { return internal::is_untried(label_, state_, i); }

  // Whether shape `next` may start at surfel i. Tests at most seeds_per_cell planes, so this is cheap enough for each
  // seed.
  CGAL_TANDEM_HD bool is_candidate(std::uint32_t i, std::uint32_t next) const
  {
    if(!is_untried(i))
      return false;
    for(std::uint32_t s = job_.new_shape; s < next; ++s)
      if(cloud_.fits(shapes_.plane[s], i, parameters_.tolerance))
        return false; // a shape that has started here may reach it
    return true;
  }

  // Tries the next candidates for shape `next`, at most Block::lookahead; returns how many. All of them are tried with
  // the same labels. A trial with too few points keeps the plane of its seed; its count is then too small as well.
  CGAL_TANDEM_HD std::uint32_t try_candidates(std::uint32_t at, std::uint32_t next)
  {
    const Grid_point& o = base();
    // First the surfels that fit the planes of the seeds, then the new planes, then the cores.
    const std::uint32_t size = block_.find(
      at, job_.seed_count, Block::lookahead, [&](std::uint32_t c) { return is_candidate(job_.seed[c], next); },
      [&](std::uint32_t i, std::uint32_t c) {
        const std::uint32_t seed = job_.seed[c];
        s_.trial[i] = {c, seed, true, own_plane(cloud_.point[seed]), Cell_moments(), 0, 0, 0};
      });
    for_each_of_cores(size, [&](Trial& trial, std::uint32_t q) {
      Shape_run run;
      run.add(cloud_.surfels, q, o, 1);
      block_.add_moments(trial.sums, run.moments);
    });
    block_.for_each(size, [&](std::uint32_t i) {
      Trial& trial = s_.trial[i];
      if(trial.sums.count < std::int64_t(parameters_.core_size))
        return;
      const Scatter scatter = make_scatter(shifted(trial.sums, o.x, o.y, o.z));
      trial.plane = make_plane(fit_plane(scatter).normal, scatter.centroid);
    });
    for_each_of_cores(size, [&](Trial& trial, std::uint32_t q) {
      block_.append(trial.count);
      block_.add(trial.points, cloud_.surfels.points(q).size());
    });
    return size;
  }

  CGAL_TANDEM_HD bool has_core(const Trial& trial) const
  {
    return trial.count >= parameters_.core_size ||
           (trial.count >= 3 && std::int64_t(trial.points) >= parameters_.core_points);
  }

  // Corrects the later trials [first, last) when a shape has started: it may reach their seed, or have taken surfels of
  // their core.
  CGAL_TANDEM_HD void recheck_trials(std::uint32_t shape, std::uint32_t first, std::uint32_t last)
  {
    const std::uint32_t width = std::uint32_t(cloud_.k) + 1;
    block_.for_each((last - first) * width, [&](std::uint32_t at) {
      Trial& trial = s_.trial[first + at / width];
      const std::uint32_t j = at % width, q = near_seed(trial.seed, j);
      if(j == 0 && (label_[q] != free_label || cloud_.fits(shapes_.plane[shape], q, parameters_.tolerance)))
        trial.is_candidate = false;
      if(is_own(q) && label_[q] == shape)
        block_.append(trial.taken);
    });
  }

  // f(trial, q), by one lane each, for the free surfels q near the seed that fit the plane of a trial. Many lanes have
  // one trial in common, so f has to add atomically.
  template <class F>
  CGAL_TANDEM_HD void for_each_of_cores(std::uint32_t size, F f)
  {
    const std::uint32_t width = std::uint32_t(cloud_.k) + 1;
    block_.for_each(size * width, [&](std::uint32_t at) {
      Trial& trial = s_.trial[at / width];
      const std::uint32_t q = near_seed(trial.seed, at % width);
      if(is_in_core(q, trial.plane))
        f(trial, q);
    });
  }

  // Surfel j of those around a seed: the seed itself for j = 0, else a neighbor of it; it may be no_index, or in
  // another cell.
  CGAL_TANDEM_HD std::uint32_t near_seed(std::uint32_t seed, std::uint32_t j) const
  {
    return j == 0 ? seed : cloud_.row(seed)[j - 1];
  }

  // Whether a free surfel of the cell fits the plane. Surfels of other cells are left out, since their labels may
  // change at this time.
  CGAL_TANDEM_HD bool is_in_core(std::uint32_t q, const Plane& plane) const
  {
    return is_own(q) && label_[q] == free_label && cloud_.fits(plane, q, parameters_.tolerance);
  }

  // Starts a shape: its core takes the label.
  CGAL_TANDEM_HD void start_shape(const Trial& trial, std::uint32_t shape)
  {
    block_.single([&] { shapes_.plane[shape] = trial.plane; });
    block_.for_each(std::uint32_t(cloud_.k) + 1, [&](std::uint32_t j) {
      const std::uint32_t q = near_seed(trial.seed, j);
      if(!is_in_core(q, trial.plane))
        return;
      label_[q] = shape;
      push(q);
    });
  }

  Block& block_;
  Scratch& s_;
  const Cell_job job_;
  const Cloud_view cloud_;
  const Shapes_view shapes_;
  const Growth_parameters parameters_;
  std::uint32_t* label_;
  std::uint8_t* state_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELL_H
