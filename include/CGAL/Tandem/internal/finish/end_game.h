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
#include <CGAL/Tandem/internal/rounds/merge_shapes.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>
#include <CGAL/Tandem/internal/rounds/split_shapes.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

namespace CGAL::Tandem::internal {

// --- Surfels of small components become free, so that an assignment can give them to the shapes around: a component of
// less than the minimum number of points is no shape of the result. Changes labels only. See the manual, "Small
// Components".

// Surfels of small components become free. An item writes its own label only, so surfels may come in any order.
struct Free_small_components {
  const std::uint32_t* component;
  const std::uint32_t* size; // by root
  std::uint64_t minimum;
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(label[i] < first_mark && size[component[i]] < minimum)
      label[i] = free_label;
  }
};

// Afterwards each shape has the minimum size, or no surfel at all. Moments do not follow.
template <class Backend>
void free_small_components(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                           const Stage_parameters& options)
{
  const std::size_t n = points.cloud.number_of_surfels();
  Buffer_of<Backend, std::uint32_t> component(points.cloud.size_with_ghosts());
  auto borders = find_components(points, options.growth.cell_size, points.label(), component.data());
  const auto size =
    component_sizes(points, {points.cloud.surfels(), points.label(), nullptr}, component.data(), borders);
  const Labels_view labels = points.change_labels(true); // lists may have shapes without surfels
  shapes.invalidate_moments();
  points.backend.for_each(
    n, Free_small_components{component.data(), size.data(), std::uint64_t(options.minimum_region_size), labels.label});
  points.refresh_labels();
}

struct Round_plane {
  Shape* shape;
  Plane* plane;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(!shape[id].is_live())
      return;
    plane[id] = rounded(shape[id].plane);
    shape[id].history.checked = shape[id].plane;
  }
};

// Rounds the planes of all live shapes for the tests of surfels. Then surfels that do not fit become free, and moments
// follow.
template <class Backend>
void detach_misfits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Tolerance& tolerance)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::moments);
  for_each_shape(backend, shapes, Round_plane{shapes.counted(), shapes.plane.data()});
  const auto is_checked = filled_buffer(backend, shapes.size, std::uint8_t(1));
  update_surfels(points, shapes, identity_targets(backend, shapes.size), is_checked.data(), tolerance);
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
  update_tables(points, shapes, tables::fits);
  for_each_shape(points.backend, shapes, Fit_plane{shapes.fitted(), shapes.plane.data()});
}

// Shapes split, surfels go where they are worth most, and shapes unite, in turn, where that gains.
template <class Backend>
void raise_score(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                 Assignment<Backend>& assign)
{
  for(int round = 0; round < tuning::moves::rounds; ++round) {
    fit_planes(points, shapes);
    split_shapes(points, shapes, options);
    fit_planes(points, shapes);
    assign(shapes, options);
    if(options.has_estimated_normals) {
      choose_edge_sides(points, shapes, options.growth.tolerance);
      assign(shapes, options);
    }
    auto links = collect_links(points, shapes, Links::all, Phase::end);
    merge_by_gain(points, shapes, options, links);
  }
  fit_planes(points, shapes);
}

// Near edges, estimated normals are blended. Surfels go to their side of the edge. Then the normals near edges are
// those of one shape, and surfels that do not fit with them are free.
template <class Backend>
void sharpen_edges(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options)
{
  const Tolerance& tolerance = options.growth.tolerance;
  choose_edge_sides(points, shapes, tolerance);
  fit_normals_to_shapes(points, shapes, tolerance);
  detach_misfits(points, shapes, tolerance);
}

// The last regularization. Touching shapes of one plane are one, and surfels are assigned by the planes of the
// relations. Returns the relations, by shape.
template <class Backend>
Shape_relations regularize_finally(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                   const Stage_parameters& options, Assignment<Backend>& assign)
{
  Backend& backend = points.backend;
  Shape_relations relations = regularize_shapes(points, shapes, options, {true, 1});
  const auto links = collect_links(points, shapes, Links::all, Phase::end);
  merge_surfels(points, shapes, coplanar_targets(backend, shapes, links));
  for_each_shape(backend, shapes, Round_plane{shapes.table().data(), shapes.plane.data()});
  assign(shapes, options);
  drop_small(points, shapes, options.minimum_region_size);
  return relations;
}

// The offsets of planes become those that fit the points of their shapes best. Surfels that do not fit any more are
// free.
template <class Backend>
void center_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options,
                   Shape_relations& relations)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::fits);
  center_planes(summarize(backend, shapes, to_buffer(backend, relations.id)), relations.relations);
  apply_relations(backend, shapes, relations);
  detach_misfits(points, shapes, options.growth.tolerance);
  drop_small(points, shapes, options.minimum_region_size);
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
  show(.5);
  if(options.has_estimated_normals)
    sharpen_edges(points, shapes, options);
  show(.6);
  free_small_components(points, shapes, options);
  assign(shapes, options);
  show(.7);
  Shape_relations relations = regularize_finally(points, shapes, options, assign);
  show(.9);
  center_shapes(points, shapes, options, relations);
  return relations;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
