// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Growth inside one octree cell (Algorithm 2 of the paper). All shapes of the cell grow at the same time over its free
// points, with their planes fixed; then new shapes start. A cell reads and writes labels and states of its own points
// only, so cells need no order. See the manual, "Growth".

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELL_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELL_H

#include <CGAL/Tandem/internal/growth/expand_cell.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// All members are called by all lanes of the block, but for those that are called within its functors.
template <class Backend, class Block, class Scratch>
class Cell_growth : private Cell_expansion<Backend, Block, Scratch> {
  static_assert(Block::lookahead > 0 && Block::lookahead <= maximum_lookahead,
                "the scratch has no room for the trials");
  using Base = Cell_expansion<Backend, Block, Scratch>;
  using Base::block_;
  using Base::cloud_;
  using Base::job_;
  using Base::label_;
  using Base::options_;
  using Base::s_;
  using Base::shapes_;
  using Base::state_;

public:
  using Base::Base;

  // Grows the shapes of the cell, and starts new ones. Old shapes grow before new ones start, so that these do not take
  // the points the old ones reach. Nothing can start without seeds, so then the active shapes need not be known.
  CGAL_TANDEM_HD void run()
  {
    block_.single([&] { s_.tail = s_.active_count = 0; });
    this->collect_frontier();
    const std::uint32_t old = s_.tail; // from here on, points that have a shape since this pass
    this->join_proposals();
    const bool has_seeds = *job_.seed_cursor < job_.seed_count;
    if(has_seeds)
      list_active();
    this->expand(0, s_.tail);
    if(has_seeds)
      start_shapes();
    if(old < s_.tail)
      this->add_deltas(old, s_.tail);
  }

private:
  // The distinct shapes of the queue that keep new ones from starting, until the list is full. Restarted shapes do not
  // count: as long as planes still move, they would fill the list round after round. Found by rising id, so the list
  // does not depend on the order of the queue.
  CGAL_TANDEM_HD void list_active()
  {
    std::uint32_t next = 0;
    for(int count = 0; count < options_.seeds_in_flight; ++count) {
      const std::uint32_t s = block_.min(s_.tail, [&](std::uint32_t place) {
        const std::uint32_t label = label_[this->queued(place)];
        return label < next || shapes_.is_restarted[label] ? no_index : label;
      });
      if(s == no_index)
        return;
      next = s + 1;
      block_.single([&] { s_.active[s_.active_count++] = s; });
    }
  }

  // New shapes start at the first candidates with a core. Those without one are no seeds any more, and each costs a
  // try. A block may try several at once, as many lanes would be idle for one. The result is as if one were tried after
  // the other: where an earlier shape took points of a core, that candidate is tried again. Candidates in reach of a
  // growing shape are left for later passes.
  CGAL_TANDEM_HD void start_shapes()
  {
    const std::uint32_t first = s_.tail;
    std::uint32_t at = skip_used_candidates(), shape = job_.new_shape;
    int room = options_.seeds_in_flight - int(s_.active_count);
    int tries = options_.seed_tries;
    while(room > 0 && tries > 0) {
      const std::uint32_t size = try_candidates(at);
      std::uint32_t next = 0;
      for(; next < size && room > 0 && tries > 0; ++next) {
        if(!s_.trial[next].is_candidate)
          continue;
        if(s_.trial[next].lost > 0)
          break; // to be tried again
        if(!has_core(s_.trial[next])) {
          --tries;
          continue;
        }
        start_shape(s_.trial[next], shape);
        recheck_trials(shape++, next + 1, size);
        --room;
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
    this->expand(first, s_.tail);
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

  // Whether a shape may start at point i. Tests at most maximum_seeds_in_flight planes, so this is cheap enough for
  // each seed.
  CGAL_TANDEM_HD bool is_candidate(std::uint32_t i) const
  {
    if(!is_untried(i))
      return false;
    for(std::uint32_t a = 0; a < s_.active_count; ++a)
      if(cloud_.fits(shapes_.plane[s_.active[a]], i, options_.tolerance))
        return false; // a shape that is still growing here may reach it
    return true;
  }

  // Tries the next candidates, at most Block::lookahead; returns how many. All of them are tried with the same labels.
  // A trial with too few points keeps the plane of its seed; its count is then too small as well.
  CGAL_TANDEM_HD std::uint32_t try_candidates(std::uint32_t at)
  {
    const Grid_point& o = this->base();
    // First the points that fit the planes of the seeds, then the new planes, then the cores.
    const std::uint32_t size = block_.find(
      at, job_.seed_count, Block::lookahead, [&](std::uint32_t c) { return is_candidate(job_.seed[c]); },
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
      if(trial.sums.count < std::int64_t(options_.core_size))
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
    return trial.count >= options_.core_size ||
           (trial.count >= 3 && std::int64_t(trial.points) >= options_.core_points);
  }

  // Corrects the later trials [first, last) when a shape has started: it may reach their seed, or have taken points of
  // their core.
  CGAL_TANDEM_HD void recheck_trials(std::uint32_t shape, std::uint32_t first, std::uint32_t last)
  {
    const std::uint32_t width = std::uint32_t(cloud_.k) + 1;
    block_.for_each((last - first) * width, [&](std::uint32_t at) {
      Trial& trial = s_.trial[first + at / width];
      const std::uint32_t j = at % width, q = near_seed(trial.seed, j);
      if(j == 0 && (label_[q] != free_label || cloud_.fits(shapes_.plane[shape], q, options_.tolerance)))
        trial.is_candidate = false;
      if(this->is_own(q) && label_[q] == shape)
        block_.append(trial.lost);
    });
  }

  // f(trial, q), by one lane each, for the free points q near the seed that fit the plane of a trial. Many lanes have
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

  // Point j of those around a seed: the seed itself for j = 0, else a neighbor of it; it may be no_index, or in another
  // cell.
  CGAL_TANDEM_HD std::uint32_t near_seed(std::uint32_t seed, std::uint32_t j) const
  {
    return j == 0 ? seed : cloud_.row(seed)[j - 1];
  }

  // Whether a free point of the cell fits the plane. Points of other cells are left out, since their labels may change
  // at this time.
  CGAL_TANDEM_HD bool is_in_core(std::uint32_t q, const Plane& plane) const
  {
    return this->is_own(q) && label_[q] == free_label && cloud_.fits(plane, q, options_.tolerance);
  }

  // Starts a shape: its core takes the label. The shape grows by one step in this pass: its plane is still uncertain.
  CGAL_TANDEM_HD void start_shape(const Trial& trial, std::uint32_t shape)
  {
    block_.single([&] {
      shapes_.plane[shape] = trial.plane;
      shapes_.steps[shape] = 1;
      s_.active[s_.active_count++] = shape;
    });
    block_.for_each(std::uint32_t(cloud_.k) + 1, [&](std::uint32_t j) {
      const std::uint32_t q = near_seed(trial.seed, j);
      if(!is_in_core(q, trial.plane))
        return;
      label_[q] = shape;
      state_[q] |= frontier_bit;
      this->push(q);
    });
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELL_H
