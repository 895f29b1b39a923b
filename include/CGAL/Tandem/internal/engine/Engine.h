// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 of the paper: detection and regularization in tandem. Decides the order of the stages, the number of
// passes of a round, and the end of the loop. The stages change the state; see the manual, "The Method, Stage by
// Stage".
//
// To add a stage:
// - Put it into the folder of its step. It is a function template on the tables that it reads and writes:
//   Labeled_cloud, Shape_table, Stage_parameters. Call it here, under a Stage_timer.
// - It begins with update_tables() of what it reads of what follows from labels: lists of cells, fits. It gets labels
//   that it changes from change_labels(), and says which of these tables it keeps right. It always keeps moments right.
//   Add it to test_requests.cpp, which runs each stage where all of these are out of date.
// - Loops over surfels and shapes are functors marked CGAL_TANDEM_HD on buffers of the back end, and bodies of a cell
//   are written on Block, so that a device runs them. A copy to the host waits: only what the host decides on crosses,
//   once a step. Steps that are repeated until nothing changes are run by run_rounds(), as those of Mutual_unions.h.
//   Items that take long are for a Lane_group.
// - A rank has its own surfels only, and the whole table of shapes. After a pass, sum_deltas() adds up what the ranks
//   have changed in that table, and refresh_labels() renews the labels of ghosts. Long loops over shapes are shared by
//   own_items() and gather(). Code for many ranks only stands under `if constexpr(Ranks<Backend>::are_many)`.
// - The score decides what is better, not a threshold. Thresholds that remain are in base/tuning, with their unit,
//   where they come from, and what moving them does.
// - Test it against brute force on small inputs, with shuffled lanes (testing/body_fixture.h), by
//   test_thread_backend.cpp under ThreadSanitizer, and on many ranks by test_mpi_bits.cpp.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_H

#include <CGAL/Tandem/internal/engine/engine_api.h>
#include <CGAL/Tandem/internal/engine/prepare.h>
#include <CGAL/Tandem/internal/finish/end_game.h>
#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/result/extract_shapes.h>
#include <CGAL/Tandem/internal/rounds/merge_shapes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace CGAL::Tandem::internal {

// The engine on one back end.
template <class Backend>
class Engine : public Detection_engine {
public:
  // Prepares the first round: see make_engine(). After an exception the engine can only be destroyed.
  Engine(Backend& backend, Import& in, const Parameters& parameters, Progress& progress);

  const char* name() const override { return Backend::name(); }
  bool iterate() override;
  void finish() override;
  Engine_result result() override;

private:
  std::size_t grow();
  void sweep_untried_cells(std::size_t maximum_untried_cells, int& passes, Growth_counts& grown);
  Shape_relations relate_shapes(Buffer_of<Backend, Link>& links);
  bool is_going_on(std::size_t new_points) const;

  std::optional<Kept_pages::Detection> detection_{std::in_place}; // before the tables, which are freed first
  const Import& in_;
  Progress& progress_;
  Tandem_state<Backend> state_;
  Shape_relations relations_; // of the last round, or of the end game
  Stage_times times_;
  Engine_result final_;
  std::size_t maximum_large_ = 0; // points of large shapes, in the best round so far
  bool is_idle_ = false;          // growth was slow in this round, and no cell is untried
  bool is_prepared_ = false;      // was not cancelled before there was anything to grow from
  bool is_finished_ = false;
};

// Not in the class, so that a program of many files may compile them once (`extern template class`).

template <class Backend>
Engine<Backend>::Engine(Backend& backend, Import& in, const Parameters& parameters, Progress& progress)
  : in_(in), progress_(progress), state_(backend)
{
  is_prepared_ = prepare(state_, in, parameters, times_, progress);
}

// Runs the passes of growth of a round; returns the number of points that got a shape. Young rounds have one pass: with
// more, faces are missed under noise. Later rounds have further passes as long as many cells have untried seeds; slow
// rounds, as long as any has. So patches too small for a shape do not delay the faces behind them. Nor do they enlarge
// the table of shapes in each round. See the manual, "Growth" and "End of the Loop".
template <class Backend>
std::size_t Engine<Backend>::grow()
{
  const bool is_young = state_.round < tuning::loop::young_rounds;
  if(!is_young)
    state_.options.growth.seeds_in_flight = tuning::growth::maximum_seeds_in_flight;
  Growth_counts grown = grow_shapes(state_.points, state_.shapes, state_.seeds, state_.options, !is_young);
  if(is_young)
    return grown.points;
  int passes = 1;
  sweep_untried_cells(state_.points.total_cells() / tuning::loop::cells_per_untried_cell, passes, grown);
  // Compared with the best round so far. Not in young rounds, so the first one counts all these points.
  const std::size_t best_before = std::exchange(maximum_large_, (std::max)(maximum_large_, grown.large_points));
  const bool is_slow =
    maximum_large_ - best_before <= state_.points.total_points() / tuning::loop::points_per_slow_point;
  if(is_slow)
    sweep_untried_cells(0, passes, grown);
  is_idle_ = is_slow && grown.untried_cells == 0;
  return grown.points;
}

// Runs further passes until at most so many cells have many untried seeds, or all passes are used. Between passes only
// shapes that have just started are fitted, to their local planes: fitting all shapes finds fewer faces on noisy scenes.
template <class Backend>
void Engine<Backend>::sweep_untried_cells(std::size_t maximum_untried_cells, int& passes, Growth_counts& grown)
{
  for(; grown.untried_cells > maximum_untried_cells && passes < tuning::loop::maximum_passes; ++passes) {
    take_local_planes(state_.points, state_.shapes);
    const std::size_t points = grown.points;
    grown = grow_shapes(state_.points, state_.shapes, state_.seeds, state_.options, true);
    grown.points += points;
  }
}

// Of more than one pass, and has stopped growing while it is small.
struct Is_fragment {
  std::int64_t minimum_size;

  CGAL_TANDEM_HD bool operator()(const Shape& shape, std::size_t) const
  {
    return !shape.is_active && shape.age > 1 && shape.moments.count < minimum_size;
  }
};

// Unites touching shapes where that gains, and finds relations. The links get the new ids.
template <class Backend>
Shape_relations Engine<Backend>::relate_shapes(Buffer_of<Backend, Link>& links)
{
  merge_by_gain(state_.points, state_.shapes, state_.options, links);
  const Stage_parameters& options = state_.options;
  const bool is_due = (state_.round + 1) % options.regularity_period == 0;
  return regularize_shapes(state_.points, state_.shapes, options, is_due, options.minimum_related_size);
}

struct Count_cells_with_seeds {
  const std::uint32_t* cursor;
  const std::uint32_t* count;

  CGAL_TANDEM_HD void operator()(std::size_t c, std::int64_t* sum) const { sum[0] += cursor[c] < count[c]; }
};

struct Count_restarted {
  const Shape* shape;
  const std::uint8_t* is_restarted;

  CGAL_TANDEM_HD void operator()(std::size_t id, std::int64_t* sum) const
  {
    sum[0] += shape[id].is_live() && is_restarted[id];
  }
};

// Whether another round may change something: points got a shape, seeds are left, or a shape restarts. Linear in the
// numbers of cells and shapes.
template <class Backend>
bool Engine<Backend>::is_going_on(std::size_t new_points) const
{
  if(is_idle_ || state_.round >= tuning::loop::maximum_rounds)
    return false;
  Backend& backend = state_.points.backend;
  const Seeds<Backend>& seeds = state_.seeds;
  const Shape_table<Backend>& shapes = state_.shapes;
  const auto count = [&](std::size_t n, auto f) { return backend.template sum<1>(n, f)[0]; };
  return new_points > 0 ||
         state_.points.ranks.total(std::size_t(
           count(seeds.count.size(), Count_cells_with_seeds{seeds.cursor.data(), seeds.count.data()}))) > 0 ||
         count(shapes.size, Count_restarted{shapes.counted(), shapes.is_restarted.data()}) > 0;
}

// One round. The order matters: small fragments go first, so that they need no links. Shapes unite before relations are
// found, so that the unions have relations. Labels follow at once for unions, and in apply_planes() for shapes that
// have become coplanar.
template <class Backend>
bool Engine<Backend>::iterate()
{
  Labeled_cloud<Backend>& points = state_.points;
  Shape_table<Backend>& shapes = state_.shapes;
  const Stage_parameters& options = state_.options;
  if(!is_prepared_)
    return false;
  Stage_timer growth(times_.growth);
  const std::size_t new_points = grow();
  growth.stop();
  progress_.show_rounds(state_.round + .4);

  Stage_timer regularity(times_.regularity);
  // The surfels of fragments are free for other shapes, but are no seeds any more.
  drop_shapes(points, shapes, Is_fragment{options.minimum_fragment_size});
  auto links = collect_links(points, shapes, Links::changed, Phase::loop);
  relations_ = relate_shapes(links);
  progress_.show_rounds(state_.round + .7);
  apply_planes(points, shapes, options, coplanar_targets(points.backend, shapes, links));
  ++state_.round;
  return progress_.show_rounds(state_.round) && is_going_on(new_points);
}

// Runs the end game and makes the result. A cloud that is empty, or was not prepared, has no relations, but an empty
// result.
template <class Backend>
void Engine<Backend>::finish()
{
  Stage_timer timer(times_.finish);
  if(is_prepared_) {
    state_.seeds = Seeds<Backend>(); // nothing grows any more
    state_.points.border.proposal.release();
    relations_ = end_game(state_.points, state_.shapes, state_.options, progress_);
    final_ = extract_shapes(state_.points, state_.shapes, state_.options, relations_, in_);
  }
  detection_.reset();
  is_finished_ = true;
}

// The result so far. Large tables of the result are shared, so copies are cheap. A call between rounds does not change
// the state.
template <class Backend>
Engine_result Engine<Backend>::result()
{
  Engine_result r = is_finished_ || !is_prepared_
                      ? final_
                      : extract_shapes(state_.points, state_.shapes, state_.options, relations_, in_);
  r.rounds = std::size_t(state_.round);
  r.is_coarse = in_.grid.is_coarse;
  r.times = times_;
  r.peak_bytes = state_.peak_bytes;
  r.line_spacing_steps = state_.points.cloud.line_spacing_steps;
  return r;
}

template <class Backend>
std::unique_ptr<Detection_engine> make_engine(Backend& backend, Import& in, const Parameters& parameters,
                                              Progress& progress)
{
  return std::make_unique<Engine<Backend>>(backend, in, parameters, progress);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_ENGINE_H
