// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages between the last round and the extraction of the result. Moves of surfels and shapes raise the score, and
// relations are found once more. Changes labels, states, shapes, planes, and estimated normals near edges. Planes are
// final at its end. See the manual, "End Game".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
#define CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H

#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/finish/choose_edge_sides.h>
#include <CGAL/Tandem/internal/finish/components.h>
#include <CGAL/Tandem/internal/finish/free_clutter.h>
#include <CGAL/Tandem/internal/finish/measure_shapes.h>
#include <CGAL/Tandem/internal/rounds/merge_shapes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>
#include <CGAL/Tandem/internal/rounds/split_shapes.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Connected components. Changes labels and the table of shapes. See the manual, "Components".

// Components below the minimum size become free. The others become shapes, if that is wanted: the largest one of a shape
// keeps its id. Otherwise a shape may have several.
template <class Backend>
void separate_components(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                         bool become_shapes)
{
  Backend& backend = points.backend;
  const std::size_t n = points.cloud.number_of_surfels();
  Buffer_of<Backend, std::uint32_t> component(points.cloud.size_with_ghosts());
  std::vector<Component> components =
    large_components(points, options, {points.cloud.surfels(), points.label(), nullptr}, component.data());
  std::vector<char> has_id(shapes.size, 0);
  std::size_t next = shapes.size;
  for(Component& c : components)
    if(std::exchange(has_id[c.entry], 1) && become_shapes)
      c.entry = std::uint32_t(next++);
  add_shapes(backend, shapes, next - shapes.size);
  auto number = filled_buffer(backend, n, no_index);
  const auto named = to_buffer(backend, components);
  backend.for_each(components.size(), Number_roots{named.data(), number.data()});
  backend.for_each(n, Take_number{points.label(), component.data(), number.data(), component.data()});
  take_chosen(points, shapes, component.data());
}

struct Round_plane {
  const Shape* shape;
  Plane* plane;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(shape[id].is_live())
      plane[id] = rounded(shape[id].plane);
  }
};

// Rounds the planes of all live shapes for the tests of surfels. Then surfels that do not fit become free, and moments
// follow.
template <class Backend>
void detach_misfits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Tolerance& tolerance)
{
  Backend& backend = points.backend;
  for_each_shape(backend, shapes, Round_plane{shapes.counted(), shapes.plane.data()});
  const auto is_checked = filled_buffer(backend, shapes.size, std::uint8_t(1));
  update_surfels(points, shapes, identity_targets(backend, shapes.size), is_checked.data(), tolerance);
}

struct Fit_plane {
  Shape* shape;
  Plane* plane;
  double maximum_distance_steps;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    Shape& s = shape[id];
    s.plane_number = -1;
    if(!s.is_live())
      return;
    s.history.check_again(s.box, s.local, s.mean_distance_steps(maximum_distance_steps));
    s.plane = s.history.checked;
    plane[id] = rounded(s.plane);
  }
};

// All shapes have the planes that fit their points best, without relations. But a plane stays where it is until it moves
// by more than a negligible distance, so that the moves look at what has changed.
template <class Backend>
void fit_planes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options)
{
  update_tables(points, shapes, tables::fits);
  for_each_shape(points.backend, shapes,
                 Fit_plane{shapes.fitted(), shapes.plane.data(), options.maximum_distance_steps});
}

// --- With CGAL_TANDEM_CHECK_SCORE, debug builds compute the score anew after each stage of the moves. See the manual,
// "The Score".

#ifdef CGAL_TANDEM_CHECK_SCORE
#define CGAL_TANDEM_EXPENSIVE_ASSERT(condition) assert(condition)
#else
#define CGAL_TANDEM_EXPENSIVE_ASSERT(condition) static_cast<void>(0)
#endif

// The points of surfels that have other labels than before.
struct Count_relabeled {
  Surfels_view surfels;
  const std::uint32_t *before, *label;

  CGAL_TANDEM_HD void operator()(std::size_t i, std::int64_t* sums) const
  {
    sums[0] += before[i] != label[i] ? std::int64_t(surfels.points(std::uint32_t(i)).size()) : 0;
  }
};

// The points of surfels that do not fit the planes of their shapes. They leave these when surfels are assigned.
struct Count_misfits {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Plane* plane; // by shape
  Tolerance tolerance;

  CGAL_TANDEM_HD void operator()(std::size_t at, std::int64_t* sums) const
  {
    const std::uint32_t i = std::uint32_t(at), s = label[i];
    sums[0] += s < first_mark && !cloud.fits(plane[s], i, tolerance) ? std::int64_t(cloud.surfels.points(i).size()) : 0;
  }
};

// Planes become those that fit; nothing else changes.
template <class Backend>
class Score_watch {
public:
  Score_watch(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options)
    : points_(points), shapes_(shapes), options_(options)
  {}

  // Notes the score. True.
  bool begin()
  {
    fit_planes(points_, shapes_, options_);
    label_.reset(points_.cloud.number_of_surfels());
    points_.backend.for_each(label_.size(), Copy_items<std::uint32_t>{points_.label(), label_.data()});
    score_ = measure_score(points_, shapes_, options_);
    misfits_ =
      total_of(Count_misfits{points_.cloud.view(), points_.label(), shapes_.plane.data(), options_.growth.tolerance});
    return true;
  }

  // Whether it has not fallen since, but for what the moves count less or not, the bonus of sizes and links to free
  // points; for points that did not fit; and for the error of samples, by which unions estimate how many points will not
  // fit: a third of the points that change their label, and what three shapes cost. Then notes it again.
  bool rises()
  {
    const std::int64_t relabeled = total_of(Count_relabeled{points_.cloud.surfels(), label_.data(), points_.label()});
    const std::int64_t misfits = misfits_;
    const Measured_score before = score_;
    begin();
    const auto fall = [](std::int64_t of, std::int64_t to) { return (std::max)(of - to, std::int64_t(0)); };
    return score_.terms.total() + fall(before.terms.size, score_.terms.size) +
             fall(before.free_links, score_.free_links) + Score::unit * (misfits + relabeled / 3) -
             3 * options_.score.price() >=
           before.terms.total();
  }

private:
  // Over all surfels of all ranks.
  template <class F>
  std::int64_t total_of(F count)
  {
    return std::int64_t(
      points_.ranks.total(std::size_t(points_.backend.template sum<1>(points_.cloud.number_of_surfels(), count)[0])));
  }

  Labeled_cloud<Backend>& points_;
  Shape_table<Backend>& shapes_;
  const Stage_parameters& options_;
  Buffer_of<Backend, std::uint32_t> label_;
  Measured_score score_;
  std::int64_t misfits_ = 0; // when it was noted
};

// Touching shapes unite where that gains, of which one has moved or united since unions were last sought. Returns what
// merge_by_gain() does.
template <class Backend>
Buffer_of<Backend, std::uint32_t> unite(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                        const Stage_parameters& options)
{
  fit_planes(points, shapes, options);
  auto links = collect_links(points, shapes, Links::changed, Phase::end);
  return merge_by_gain(points, shapes, options, links);
}

// Surfels go where they are worth most. Where normals are estimated, those at edges then choose their side.
template <class Backend>
void place_surfels(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                   Assignment<Backend>& assign)
{
  fit_planes(points, shapes, options);
  assign(shapes, options);
  if(!options.has_estimated_normals)
    return;
  choose_edge_sides(points, shapes, options.growth.tolerance);
  assign(shapes, options);
}

// Shapes split, surfels are placed, shapes unite where that gains, and surfels are placed anew. Then components become
// shapes, clutter becomes free, and shapes unite as long as that gains.
template <class Backend>
void raise_score(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                 Assignment<Backend>& assign)
{
  Score_watch<Backend> watch(points, shapes, options);
  CGAL_TANDEM_EXPENSIVE_ASSERT(watch.begin());
  fit_planes(points, shapes, options);
  split_shapes(points, shapes, options);
  place_surfels(points, shapes, options, assign);
  CGAL_TANDEM_EXPENSIVE_ASSERT(watch.rises());
  unite(points, shapes, options);
  CGAL_TANDEM_EXPENSIVE_ASSERT(watch.rises());
  place_surfels(points, shapes, options, assign);
  separate_components(points, shapes, options, true);
  fit_planes(points, shapes, options);
  free_clutter(points, shapes, options.growth.tolerance);
  assign(shapes, options);
  CGAL_TANDEM_EXPENSIVE_ASSERT(watch.begin()); // small components and clutter may have been worth something
  // Ends, since unions leave fewer shapes, and an assignment makes none.
  while(are_any(points.backend, unite(points, shapes, options))) {
    fit_planes(points, shapes, options);
    assign(shapes, options);
    CGAL_TANDEM_EXPENSIVE_ASSERT(watch.rises());
  }
}

// The last regularization. Touching shapes of one plane are one, and surfels are assigned by the planes of the
// relations. Returns the relations, by shape.
template <class Backend>
Shape_relations regularize_finally(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                   const Stage_parameters& options, Assignment<Backend>& assign)
{
  Backend& backend = points.backend;
  Shape_relations relations = regularize_shapes(points, shapes, options, true, 1);
  const auto links = collect_links(points, shapes, Links::all, Phase::end);
  merge_surfels(points, shapes, coplanar_targets(backend, shapes, links));
  for_each_shape(backend, shapes, Round_plane{shapes.table().data(), shapes.plane.data()});
  assign(shapes, options);
  return relations;
}

// The offsets of planes become those that fit the points of their shapes best, but for small components, which the result
// does not have. Surfels that do not fit any more are free.
template <class Backend>
void center_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                   Shape_relations& relations)
{
  Backend& backend = points.backend;
  separate_components(points, shapes, options, false);
  update_tables(points, shapes, tables::fits);
  center_planes(summarize(backend, shapes, 1), relations);
  apply_relations(backend, shapes, relations);
  detach_misfits(points, shapes, options.growth.tolerance);
}

// Returns the relations of the live shapes. It runs to its end even if the callback cancels, so that what it has is
// verified.
template <class Backend>
Shape_relations end_game(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                         Progress& progress)
{
  const auto show = [&](double fraction) { progress.show(Detection_stage::end_game, fraction); };
  Assignment<Backend> assign(points);
  raise_score(points, shapes, options, assign);
  show(.6);
  Shape_relations relations = regularize_finally(points, shapes, options, assign);
  show(.9);
  center_shapes(points, shapes, options, relations);
  return relations;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
