// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages between the last round and the extraction of the result. Moves of points and shapes raise the score, and
// relations are found once more. Changes labels, states, shapes, planes, and estimated normals near edges. Planes are
// final at its end. See the manual, "End Game".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
#define CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H

#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/finish/choose_sides.h>
#include <CGAL/Tandem/internal/finish/relabel_components.h>
#include <CGAL/Tandem/internal/rounds/merge_coplanar.h>
#include <CGAL/Tandem/internal/rounds/merge_shapes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Round_plane {
  Shape* shape;
  Plane* plane;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(!shape[id].is_live())
      return;
    plane[id] = rounded(shape[id].plane);
    shape[id].history.set_checked(shape[id].plane);
  }
};

// Rounds the planes of all live shapes for the tests of points. Then points that do not fit become free, and moments
// follow.
template <class Backend>
void detach_misfits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Tolerance& tolerance)
{
  Backend& backend = points.backend;
  require(points, shapes, tables::moments);
  for_each_shape(backend, shapes, Round_plane{shapes.counted(), shapes.plane.data()});
  const auto is_checked = filled_buffer(backend, shapes.size, std::uint8_t(1));
  update_points(points, shapes, identity_targets(backend, shapes.size), is_checked.data(), tolerance);
}

struct Fit_plane {
  Shape* shape;
  Plane* plane;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(!shape[id].is_live())
      return;
    Take_local{shape}(id);
    Round_plane{shape, plane}(id);
  }
};

// All shapes have the planes that fit their points best, without relations.
template <class Backend>
void fit_planes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes)
{
  require(points, shapes, tables::fits);
  for_each_shape(points.backend, shapes, Fit_plane{shapes.fitted(), shapes.plane.data()});
}

// Points go where they are worth most, and shapes unite where that gains, in turn.
template <class Backend>
void raise_score(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  for(int round = 0; round < tuning::moves::rounds; ++round) {
    fit_planes(points, shapes);
    assign(points, shapes, options);
    if(options.has_estimated_normals) {
      choose_sides(points, shapes, options.growth.tolerance);
      assign(points, shapes, options, tuning::moves::assignment_passes_after_sides);
    }
    auto links = collect_links(points, shapes, Links::all, Phase::end);
    merge_by_gain(points, shapes, options, links);
  }
  fit_planes(points, shapes);
  assign(points, shapes, options);
}

// The last regularization. Touching shapes of one plane are one; points that do not fit the planes of the relations are
// free. Returns the relations, by shape.
template <class Backend>
Shape_relations regularize_finally(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                   int round)
{
  Backend& backend = points.backend;
  Shape_relations relations = regularize_shapes(points, shapes, options, {round, true});
  const auto links = collect_links(points, shapes, Links::all, Phase::end);
  merge_points(points, shapes, coplanar_targets(backend, shapes, links));
  detach_misfits(points, shapes, options.growth.tolerance);
  return relations;
}

// Near edges, estimated normals are blended. Points go to their side of the edge. Then the normals near edges are those
// of one shape, and points that do not fit with them are free.
template <class Backend>
void sharpen_edges(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  const Tolerance& tolerance = options.growth.tolerance;
  choose_sides(points, shapes, tolerance);
  fit_normals_to_shapes(points, shapes, tolerance);
  detach_misfits(points, shapes, tolerance);
  drop_small(points, shapes, options.minimum_region_size);
}

// Returns the relations of the live shapes; `round` is the number of rounds of the loop. It runs to its end even if the
// callback cancels, so that what it has is verified. With the planes of the relations points are assigned twice: shapes
// that are too small leave theirs to others in between.
template <class Backend>
Shape_relations end_game(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                         int round, Progress& progress)
{
  const auto show = [&](double share) { progress.show(Detection_stage::end_game, share); };
  raise_score(points, shapes, options);
  drop_small(points, shapes, options.lasting_size);
  show(.5);
  Shape_relations relations = regularize_finally(points, shapes, options, round);
  show(.6);
  for(int repetition = 0; repetition < 2; ++repetition) {
    assign(points, shapes, options);
    drop_small(points, shapes, options.minimum_region_size);
  }
  show(.7);
  if(options.has_estimated_normals)
    sharpen_edges(points, shapes, options);
  show(.8);
  relabel_small_components(points, shapes, options);
  show(.9);
  return relations;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
