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
  Shape_relations relate_shapes(Buffer_of<Backend, Link>& links);

  std::optional<Kept_pages::Detection> detection_{std::in_place}; // before the tables, which are freed first
  const Import& in_;
  Progress& progress_;
  Tandem_state<Backend> state_;
  Shape_relations relations_; // of the last round, or of the end game
  bool are_related_ = true;   // the shapes that there are
  Stage_times times_;
  Engine_result final_;
  bool is_prepared_ = false; // was not cancelled before there was anything to grow from
  bool is_finished_ = false;
};

// Not in the class, so that a program of many files may compile them once (`extern template class`).

template <class Backend>
Engine<Backend>::Engine(Backend& backend, Import& in, const Parameters& parameters, Progress& progress)
  : in_(in), progress_(progress), state_(backend)
{
  is_prepared_ = prepare(state_, in, parameters, times_, progress);
}

// Passes of growth, until no cell has many untried seeds, or all passes are used. Patches too small for a shape do not
// delay the faces behind them so. Between passes only shapes that have just started are fitted: fitting all shapes finds
// fewer faces on noisy scenes. Returns the number of points that got a shape. See the manual, "Growth".
template <class Backend>
std::size_t Engine<Backend>::grow()
{
  Growth_counts grown = grow_shapes(state_.points, state_.shapes, state_.seeds, state_.options);
  std::size_t points = grown.points;
  for(int pass = 1; grown.untried_cells > 0 && pass < tuning::loop::maximum_passes; ++pass) {
    take_local_planes(state_.points, state_.shapes);
    grown = grow_shapes(state_.points, state_.shapes, state_.seeds, state_.options);
    points += grown.points;
  }
  return points;
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

// One round. The order matters: small fragments go first, so that they need no links. Shapes unite before relations are
// found, so that the unions have relations. Labels follow at once for unions, and in apply_planes() for shapes that
// have become coplanar. The last round only grows: the end game unites and relates what it has grown.
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
  are_related_ = new_points > points.total_points() / tuning::loop::points_per_new_point;
  if(!are_related_) {
    progress_.show_rounds(++state_.round);
    return false;
  }
  progress_.show_rounds(state_.round + .4);

  Stage_timer regularity(times_.regularity);
  // The surfels of fragments are free for other shapes, but are no seeds any more.
  drop_shapes(points, shapes, Is_fragment{options.minimum_fragment_size});
  auto links = collect_links(points, shapes, Links::changed, Phase::loop);
  relations_ = relate_shapes(links);
  progress_.show_rounds(state_.round + .7);
  apply_planes(points, shapes, options, coplanar_targets(points.backend, shapes, links));
  ++state_.round;
  return progress_.show_rounds(state_.round) && state_.round < tuning::loop::maximum_rounds;
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
// the state; one after the last round gives shapes the planes that fit them, as the end game does.
template <class Backend>
Engine_result Engine<Backend>::result()
{
  const Stage_parameters& options = state_.options;
  const bool is_final = is_finished_ || !is_prepared_;
  if(!is_final && !std::exchange(are_related_, true))
    relations_ = regularize_shapes(state_.points, state_.shapes, options, false, options.minimum_related_size);
  Engine_result r = is_final ? final_ : extract_shapes(state_.points, state_.shapes, options, relations_, in_);
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
