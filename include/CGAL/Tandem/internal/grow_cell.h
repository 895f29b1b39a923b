// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Growth inside one octree leaf (Algorithm 2 of the paper): all shapes of the leaf
// grow at the same time over its free points, with their planes fixed; then new
// shapes begin. A leaf writes the labels of its own points only.

#ifndef CGAL_TANDEM_INTERNAL_GROW_CELL_H
#define CGAL_TANDEM_INTERNAL_GROW_CELL_H

#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/Moment_table.h>
#include <CGAL/Tandem/internal/backend/concepts.h>
#include <CGAL/Tandem/internal/seeds.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// What the shapes look like to the points during one round: plain arrays, by shape.
struct Shapes_view {
  Plane* plane;
  std::uint16_t* rounds;            // breadth-first rounds of this pass
  const std::uint8_t* is_restarted; // all of its points are on the frontier
  Shared_moments* gain;             // what the pass adds
};

struct Growth_options {
  Tolerance tolerance;
  int seeds_in_flight;     // most shapes that may be growing in a leaf for a new one to begin
  int seed_tries;          // candidates that may fail in one pass
  std::uint32_t core_size; // fewest points that a shape begins with
};

// The part of one leaf in a pass.
struct Cell_job {
  Range cell;
  const std::uint32_t* border;   // its points with a neighbor in another leaf ...
  const std::uint32_t* proposal; // ... and the shapes that they join first, or no_index
  std::uint32_t border_size;
  const std::uint32_t* seed; // candidates
  std::uint32_t seed_count;
  std::uint32_t* seed_cursor; // candidates before it are used up
  std::uint32_t new_shape;    // the ids from here on are those of new shapes
  bool has_restarted = true;  // maybe: some shape grows again from all of its points
};

constexpr int least_seeds_in_flight = 8;
constexpr std::uint32_t max_seeds_in_flight = 32;

// Points of a leaf, at most: the queue of a small one fits into fast memory.
constexpr std::uint32_t small_cell = 8192;
constexpr std::uint32_t largest_cell = 65536;

template <std::uint32_t CellSize>
struct Growth_scratch {
  std::uint16_t queue[CellSize]; // cell-relative points; each is queued at most once
  std::uint32_t tail;
  Moment_table table;
  std::uint32_t active[max_seeds_in_flight]; // shapes on the frontier of this leaf, ascending
  std::uint32_t active_count;
  std::uint32_t core[65];
  std::uint32_t core_count;
  Cell_moments core_sums;
};

template <class Backend, class Block, class Scratch>
class Cell_growth {
  static_assert(Is_block<Block>::value, "the block is no model of the concept Block");

public:
  CGAL_TANDEM_HD Cell_growth(Block& block, Scratch& scratch, const Cell_job& job, const Cloud_view& cloud,
                             const Shapes_view& shapes, const Labels_view& labels, const Growth_options& options)
    : block_(block), s_(scratch), job_(job), cloud_(cloud), shapes_(shapes), options_(options), label_(labels.label),
      state_(labels.state)
  {}

  CGAL_TANDEM_HD void run()
  {
    block_.single([&] { s_.tail = s_.active_count = 0; });
    collect_frontier();
    const std::uint32_t old = s_.tail;
    join_proposals();
    const bool has_seeds = *job_.seed_cursor < job_.seed_count;
    if(has_seeds)
      list_active();
    expand(0, s_.tail);
    if(has_seeds)
      begin_shapes();
    if(old < s_.tail)
      add_gain(old, s_.tail);
  }

private:
  CGAL_TANDEM_HD const Grid_point& base() const { return cloud_.point[job_.cell.first]; }

  CGAL_TANDEM_HD void push(std::uint32_t i) { s_.queue[block_.append(s_.tail)] = std::uint16_t(i - job_.cell.first); }

  CGAL_TANDEM_HD std::uint32_t queued(std::uint32_t place) const { return job_.cell.first + s_.queue[place]; }

  CGAL_TANDEM_HD void join_proposals()
  {
    block_.for_each(job_.border_size, [&](std::uint32_t b) {
      const std::uint32_t i = job_.border[b];
      if(job_.proposal[b] == no_index)
        return;
      label_[i] = job_.proposal[b];
      state_[i] |= on_frontier;
      push(i);
    });
  }

  // Queues the points from which shapes go on.
  CGAL_TANDEM_HD void collect_frontier()
  {
    block_.for_each(job_.cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = job_.cell.first + at;
      const bool is_on = state_[i] & on_frontier;
      if((!is_on && !job_.has_restarted) || label_[i] >= first_mark || !(is_on || shapes_.is_restarted[label_[i]]))
        return;
      state_[i] |= on_frontier;
      push(i);
    });
  }

  // The distinct shapes of the queue that keep new ones from beginning, as far as the
  // list goes. Those that grow again from all of their points are not among them:
  // while planes settle they would take the room round after round.
  CGAL_TANDEM_HD void list_active()
  {
    std::uint32_t next = 0;
    for(int count = 0; count < options_.seeds_in_flight; ++count) {
      const std::uint32_t s = block_.min(s_.tail, [&](std::uint32_t place) {
        const std::uint32_t label = label_[queued(place)];
        return label < next || shapes_.is_restarted[label] ? no_index : label;
      });
      if(s == no_index)
        return;
      next = s + 1;
      block_.single([&] { s_.active[s_.active_count++] = s; });
    }
  }

  // Breadth-first rounds over [head, tail) of the queue. A free point that several
  // shapes reach in one round goes to the smallest id.
  CGAL_TANDEM_HD void expand(std::uint32_t head, std::uint32_t tail)
  {
    for(int round = 0; head < tail; ++round) {
      block_.for_each_neighbor(
        tail - head, cloud_.k, [&](std::uint32_t source) { return row_if_going_on(head + source, round); },
        [&](std::uint32_t source, std::uint32_t q) { propose(label_[queued(head + source)], q); });
      const std::uint32_t sources = tail - head;
      block_.for_each(s_.tail - head, [&](std::uint32_t at) {
        const std::uint32_t i = queued(head + at);
        if(at >= sources) {
          label_[i] &= ~first_mark;
          state_[i] |= on_frontier;
        } else if(round < shapes_.rounds[label_[i]])
          state_[i] &= std::uint8_t(~on_frontier);
      });
      head = tail;
      tail = s_.tail;
    }
  }

  CGAL_TANDEM_HD const std::uint32_t* row_if_going_on(std::uint32_t place, int round) const
  {
    const std::uint32_t i = queued(place);
    return round < shapes_.rounds[label_[i]] ? cloud_.row(i) : nullptr;
  }

  // Claims are marked, and become labels when the round is over.
  CGAL_TANDEM_HD void propose(std::uint32_t s, std::uint32_t q)
  {
    if(q < job_.cell.first || q >= job_.cell.last)
      return;
    const std::uint32_t claim = first_mark | s;
    const std::uint32_t old = label_[q];
    if(old < first_mark || old <= claim || old == is_locked ||
       !fits(shapes_.plane[s], cloud_.point[q], options_.tolerance))
      return;
    if(block_.fetch_min(label_[q], claim) == is_free)
      push(q);
  }

  CGAL_TANDEM_HD void begin_shapes()
  {
    const std::uint32_t first = s_.tail;
    std::uint32_t at = skip_used_candidates();
    int room = options_.seeds_in_flight - int(s_.active_count);
    std::uint32_t shape = job_.new_shape;
    for(int tries = options_.seed_tries; room > 0 && tries > 0;) {
      at = block_.find_first(at, job_.seed_count, [&](std::uint32_t c) { return is_candidate(job_.seed[c]); });
      if(at == job_.seed_count)
        break;
      if(begin_shape(job_.seed[at], shape)) {
        ++shape;
        --room;
      } else {
        --tries;
      }
      ++at;
    }
    expand(first, s_.tail);
  }

  CGAL_TANDEM_HD std::uint32_t skip_used_candidates()
  {
    const std::uint32_t at =
      block_.find_first(*job_.seed_cursor, job_.seed_count, [&](std::uint32_t c) { return is_untried(job_.seed[c]); });
    block_.single([&] { *job_.seed_cursor = at; });
    return at;
  }

  CGAL_TANDEM_HD bool is_untried(std::uint32_t i) const { return Labels_view{label_, state_}.is_untried(i); }

  CGAL_TANDEM_HD bool is_candidate(std::uint32_t i) const
  {
    if(!is_untried(i))
      return false;
    for(std::uint32_t a = 0; a < s_.active_count; ++a)
      if(fits(shapes_.plane[s_.active[a]], cloud_.point[i], options_.tolerance))
        return false; // a shape that is still growing here may reach it
    return true;
  }

  CGAL_TANDEM_HD bool is_own_free(std::uint32_t q) const
  {
    return q >= job_.cell.first && q < job_.cell.last && label_[q] == is_free;
  }

  // The seed and its free neighbors that fit its plane, then those that fit the
  // plane through them, are the core of a new shape. False if they are too few.
  CGAL_TANDEM_HD bool begin_shape(std::uint32_t seed, std::uint32_t shape)
  {
    bool is_core = gather_core(seed, own_plane(cloud_.point[seed]));
    if(is_core) {
      fit_core(shapes_.plane[shape]);
      is_core = gather_core(seed, shapes_.plane[shape]);
    }
    block_.single([&] {
      state_[seed] |= no_seed;
      if(is_core) {
        shapes_.rounds[shape] = 1;
        s_.active[s_.active_count++] = shape;
      }
    });
    if(!is_core)
      return false;
    block_.for_each(s_.core_count, [&](std::uint32_t c) {
      label_[s_.core[c]] = shape;
      state_[s_.core[c]] |= on_frontier;
      push(s_.core[c]);
    });
    return true;
  }

  // True if there are enough for a shape.
  CGAL_TANDEM_HD bool gather_core(std::uint32_t seed, const Plane& plane)
  {
    const std::uint32_t* row = cloud_.row(seed);
    block_.single([&] { s_.core_count = 0; });
    block_.for_each(std::uint32_t(cloud_.k) + 1, [&](std::uint32_t j) {
      const std::uint32_t q = j == 0 ? seed : row[j - 1];
      if(is_own_free(q) && fits(plane, cloud_.point[q], options_.tolerance))
        s_.core[block_.append(s_.core_count)] = q;
    });
    return s_.core_count >= options_.core_size;
  }

  CGAL_TANDEM_HD void fit_core(Plane& plane)
  {
    const Grid_point& o = base();
    block_.single([&] { s_.core_sums = Cell_moments(); });
    block_.template accumulate<Cell_moments>(
      s_.core_count,
      [&](std::uint32_t c, Cell_moments& sums) {
        const Grid_point& p = cloud_.point[s_.core[c]];
        sums.add(std::int64_t(p.x) - o.x, std::int64_t(p.y) - o.y, std::int64_t(p.z) - o.z);
      },
      [&](const Cell_moments& sums) {
        if(sums.count > 0)
          block_.add_moments(s_.core_sums, sums);
      });
    block_.single([&] {
      const Scatter scatter = make_scatter(shifted(s_.core_sums, o.x, o.y, o.z));
      plane = make_plane(fit_plane(scatter).normal, scatter.centroid);
    });
  }

  CGAL_TANDEM_HD void add_gain(std::uint32_t first, std::uint32_t last)
  {
    s_.table.clear(block_);
    block_.for_each(last - first, [&](std::uint32_t at) {
      const std::uint32_t i = queued(first + at);
      s_.table.template add<Backend>(block_, label_[i], cloud_.point[i], base(), 1, shapes_.gain);
    });
    s_.table.template flush<Backend>(block_, base(), shapes_.gain);
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

#endif // CGAL_TANDEM_INTERNAL_GROW_CELL_H
