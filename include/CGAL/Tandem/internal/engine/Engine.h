// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 of the paper: detection and regularization in tandem.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_H

#include <CGAL/Tandem/internal/backend/concepts.h>
#include <CGAL/Tandem/internal/finish/end_game.h>
#include <CGAL/Tandem/internal/finish/extract_shapes.h>
#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/engine/prepare.h>
#include <CGAL/Tandem/internal/rounds/split_layers.h>

#include <algorithm>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Backend>
class Engine {
  static_assert(Is_backend<Backend>::value, "the back end is no model of the concept Backend");

public:
  using Upload = No_upload;

  // The import has to stay.
  Engine(Backend& backend, Import& in, const Parameters& parameters);

  static const char* name() { return Backend::name(); }

  // One round; false when nothing grows any more.
  bool iterate();

  // The end game. Afterwards result() is final and keeps the guarantees.
  void finish();

  double progress() const { return is_finished_ ? 1 : 1 - 8. / (8 + state_.round); }

  // Between rounds: what has been found so far, not regularized to the end and not
  // checked exactly.
  Engine_result result();

private:
  // In a joint-fit merge.
  static constexpr double misfit_share = 0.05;
  // The bounds of the loop: rounds, and a slow one whose growth leaves no cell with many seeds. A slow round gains at
  // most one point of so many. The first rounds are not slow: shapes are small because they are young.
  static constexpr int maximum_rounds = 300;
  static constexpr int young_rounds = 4;
  static constexpr std::size_t points_of_slow_gain = 32;
  // Passes of growth in a round, the next one if more than one of so many cells has many seeds left.
  static constexpr int maximum_passes = 9;
  static constexpr std::size_t cells_per_untried_cell = 64;

  // One pass; after the first rounds more of them as long as many cells have many seeds left, and in slow rounds as
  // long as any has: patches that are too small for a shape must not keep the faces behind them waiting, nor make the
  // table of shapes large in each round.
  std::size_t grow()
  {
    const bool is_young = state_.round < young_rounds;
    if(!is_young)
      state_.options.growth.seeds_in_flight = maximum_seeds_in_flight;
    std::size_t gained = grow_shapes(state_);
    if(is_young)
      return gained;
    int passes = 1;
    std::size_t untried_cells = count_untried_cells(state_);
    const auto sweep = [&](std::size_t maximum_untried_cells) {
      for(; untried_cells > maximum_untried_cells && passes < maximum_passes; ++passes) {
        take_local_planes(state_);
        gained += grow_shapes(state_);
        untried_cells = count_untried_cells(state_);
      }
    };
    sweep(state_.number_of_cells / cells_per_untried_cell);
    const bool is_slow = gain_settled() <= state_.cloud.size / points_of_slow_gain;
    if(is_slow)
      sweep(0);
    is_idle_ = is_slow && untried_cells == 0;
    return gained;
  }

  // The points that shapes which are large enough have gained; fragments come and go for ever.
  std::size_t gain_settled()
  {
    std::size_t settled = 0;
    for(std::uint32_t id : state_.live)
      if(state_.shapes[id].moments.count >= state_.options.minimum_region_size)
        settled += std::size_t(state_.shapes[id].moments.count);
    const std::size_t best_before = std::exchange(maximum_settled_, (std::max)(maximum_settled_, settled));
    return maximum_settled_ - best_before;
  }

  // Shapes of more than one pass that stopped growing while they are small, whether or not they have met others to
  // merge with: the others, or new ones, take their points.
  void drop_fragments()
  {
    const std::int64_t minimum = state_.options.minimum_fragment_size;
    drop_shapes(state_, [&](const Shape& shape, std::uint32_t) {
      return !shape.is_active && shape.age > 1 && shape.moments.count < minimum;
    });
  }

  bool is_going_on(std::size_t gained) const
  {
    bool is_alive = gained > 0;
    for(std::size_t c = 0; c < state_.number_of_cells; ++c)
      is_alive = is_alive || state_.seed_cursor[c] < state_.seeds.count[c];
    for(std::uint32_t id : state_.live)
      is_alive = is_alive || state_.is_restarted[id];
    return is_alive && !is_idle_ && state_.round < maximum_rounds;
  }

  const Import& in_;
  Tandem_state<Backend> state_;
  typename Backend::template Buffer<std::uint32_t> order_; // imported point of each sorted one
  typename Backend::template Buffer<Grid_point> points_;
  typename Backend::template Buffer<std::uint32_t> neighbors_;
  Shape_relations relations_;
  Stage_times times_;
  Engine_result final_;
  std::size_t maximum_settled_ = 0;
  bool is_idle_ = false; // growth was slow in this round, and no cell has many seeds left
  bool is_finished_ = false;
};

// Not in the class, so that a program of many files may compile them once (`extern template class`).

template <class Backend>
Engine<Backend>::Engine(Backend& backend, Import& in, const Parameters& parameters) : in_(in), state_(backend)
{
  prepare(state_, in, parameters, order_, points_, neighbors_, times_);
}

template <class Backend>
bool Engine<Backend>::iterate()
{
  if(state_.cloud.size == 0)
    return false;
  Stage_timer growth(times_.growth);
  const std::size_t gained = grow();
  growth.stop();

  Stage_timer regularity(times_.regularity);
  drop_fragments();
  Link_list links = collect_links(state_, minimum_links, Links::changed, [&] { refit_shapes(state_); });
  merge_fragments(state_, links, misfit_share);
  relations_ = regularize_shapes(state_, false, relations_);
  split_layers(state_, relations_);
  const std::vector<std::uint32_t> target = coplanar_targets(state_, relations_, links);
  merge_shapes(state_, target);
  apply_planes(state_, target);
  ++state_.round;
  return is_going_on(gained);
}

template <class Backend>
void Engine<Backend>::finish()
{
  Stage_timer timer(times_.finish);
  if(state_.cloud.size > 0)
    relations_ = end_game(state_);
  final_ = extract_shapes(state_, relations_, in_, order_.data());
  is_finished_ = true;
}

template <class Backend>
Engine_result Engine<Backend>::result()
{
  Engine_result r = is_finished_ ? final_ : extract_shapes(state_, relations_, in_, order_.data());
  r.rounds = std::size_t(state_.round);
  r.is_coarse = in_.grid.is_coarse;
  r.times = times_;
  r.peak_bytes = state_.peak_bytes;
  return r;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_H
