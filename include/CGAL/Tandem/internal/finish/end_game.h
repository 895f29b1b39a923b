// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages between the last round and the extraction of the result. Fragments are merged or dropped, relations are
// found once more, free points are labeled, and points go to larger shapes. Changes labels, states, shapes, planes, and
// estimated normals near edges. Planes are final at its end. See the manual, "End Game".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
#define CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H

#include <CGAL/Tandem/internal/finish/choose_sides.h>
#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/finish/reassign.h>
#include <CGAL/Tandem/internal/finish/relabel_components.h>
#include <CGAL/Tandem/internal/finish/transfer_points.h>
#include <CGAL/Tandem/internal/rounds/merge_coplanar.h>
#include <CGAL/Tandem/internal/rounds/merge_by_joint_fit.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// By id: 1 for live shapes of less than `size` points, 0 for all other entries.
template <class Backend>
std::vector<std::uint8_t> shapes_below(Backend& backend, const Shape_table<Backend>& shapes, std::int64_t size)
{
  std::vector<std::uint8_t> is_below(shapes.size(), 0);
  backend.for_each_on_host(
    shapes.live.size(), [&](std::size_t l) { is_below[shapes.live[l]] = shapes[shapes.live[l]].moments.count < size; });
  return is_below;
}

// The table that selects every shape.
inline std::vector<std::uint8_t> all_shapes(std::size_t shapes) { return std::vector<std::uint8_t>(shapes, 1); }

// Rounds the planes of all live shapes for the tests of points. Then points of the checked shapes that do not fit
// become free, and the moments of these shapes follow.
template <class Backend>
void detach_misfits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Point_check& check)
{
  points.backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    Shape& shape = shapes[shapes.live[l]];
    shapes.plane[shapes.live[l]] = rounded(shape.plane);
    shape.checked = shape.plane;
  });
  update_points(points, shapes, identity_targets(shapes.size()), check);
}

// Fits all shapes whose points have changed. Fragments take their local planes, as after a rollback.
template <class Backend>
void refit_fragments(Backend& backend, Shape_table<Backend>& shapes, const std::vector<std::uint8_t>& is_fragment)
{
  refit_shapes(backend, shapes);
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    if(is_fragment[shapes.live[l]])
      shapes[shapes.live[l]].plane = shapes[shapes.live[l]].local;
  });
}

// Merges linked fragments by joint fit: see merge_by_joint_fit.h. Larger shapes take no part here; they take points of
// fragments in the reassignment that follows. More misfits are tolerated than in the loop, because fragments that stay
// small are dropped.
template <class Backend>
void join_fragments(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                    const std::vector<std::uint8_t>& is_fragment)
{
  Link_list links = collect_links(points, shapes, Links::all, [&] { refit_shapes(points.backend, shapes); });
  links.erase(std::remove_if(links.begin(), links.end(),
                             [&](const Link& l) { return !is_fragment[l.first()] || !is_fragment[l.second()]; }),
              links.end());
  if(merge_by_joint_fit(points, shapes, options, links, tuning::merging::final_misfit_share))
    refit_fragments(points.backend, shapes, is_fragment);
  points.sample.reset(0); // others need the memory
}

// Fragments are not dropped at once: they may be parts of one face, or of a larger neighbor. There are two rounds,
// because with one of them, faces behind many patches are lost. A round that changes little is the last one. Moments
// are summed again at its end.
template <class Backend>
void consolidate(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  using namespace tuning::end_game;
  const Tolerance& tolerance = options.growth.tolerance;
  for(int round = 0; round < consolidation_rounds; ++round) {
    const auto is_fragment = shapes_below(points.backend, shapes, options.minimum_region_size);
    const std::size_t shapes_before = shapes.live.size(), assigned_before = shapes.assigned;
    refit_fragments(points.backend, shapes, is_fragment);
    detach_misfits(points, shapes, {is_fragment, tolerance});
    join_fragments(points, shapes, options, is_fragment);
    detach_misfits(points, shapes, {is_fragment, tolerance});
    propagate_labels(points, shapes.plane, tolerance);
    const auto may_lose = shapes_below(points.backend, shapes, options.minimum_region_size);
    reassign(points, shapes, tolerance, {may_lose, all_shapes(shapes.size()), false});
    recount(points, shapes);
    if(kept_shapes.is_reached(std::int64_t(shapes.live.size()), std::int64_t(shapes_before)) &&
       !grown_points.is_reached(std::int64_t(shapes.assigned), std::int64_t(assigned_before)))
      break;
  }
}

// One regularization of all shapes, with labels and shapes that follow from it. The moments have to be those of the
// points before, and are afterwards. Returns the relations, by shape; `before` has those of the last such step, which
// are kept where little has changed.
template <class Backend>
Shape_relations regularize_finally(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                   int round, const Shape_relations& before)
{
  Backend& backend = points.backend;
  const Tolerance& tolerance = options.growth.tolerance;
  refit_shapes(backend, shapes);
  Shape_relations relations = regularize_shapes(points, shapes, options, {round, true}, before);
  points.sample.reset(0); // others need the memory
  const Link_list links = collect_links(points, shapes, Links::all);
  merge_points(points, shapes, coplanar_targets(backend, shapes, relations, links));
  detach_misfits(points, shapes, {all_shapes(shapes.size()), tolerance});
  propagate_labels(points, shapes.plane, tolerance);
  recount(points, shapes);
  drop_small(points, shapes, options.lasting_size);
  return relations;
}

// Points go to the largest shape that they fit: see Choose_largest. Planes stay, since none is fitted afterwards.
// Only shapes well above the minimum size lose points; those that fall below it all the same are dropped.
template <class Backend>
void reassign_to_larger(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  using namespace tuning::end_game;
  bool is_any = true;
  for(int round = 0; round < reassignment_rounds && is_any; ++round) {
    std::vector<std::uint8_t> may_lose(shapes.size(), 1);
    for(std::uint32_t id : shapes.live)
      may_lose[id] = safe_size.is_reached(shapes[id].moments.count, options.minimum_region_size);
    is_any = reassign(points, shapes, options.growth.tolerance, {may_lose, all_shapes(shapes.size()), true});
    drop_empty_shapes(points.backend, shapes);
  }
  list_shapes(points);
  drop_small(points, shapes, options.minimum_region_size);
}

// Near edges, estimated normals are blended. Points go to their side of the edge. Then the normals near edges are those
// of one shape, and points that do not fit with them are free.
template <class Backend>
void sharpen_edges(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  const Tolerance& tolerance = options.growth.tolerance;
  choose_sides(points, shapes, tolerance);
  list_shapes(points);
  fit_normals_to_shapes(points, shapes, tolerance);
  detach_misfits(points, shapes, {all_shapes(shapes.size()), tolerance});
  drop_small(points, shapes, options.minimum_region_size);
}

// An interior point is skipped, since all of its neighbors have had its label. Neighbors may have lost it since, so the
// bit is cleared before the stages that rely on it.
struct Clear_interior {
  std::uint8_t* state;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { state[i] &= std::uint8_t(~interior_bit); }
};

template <class Backend>
void clear_interior(Labeled_cloud<Backend>& points)
{
  points.backend.for_each(points.cloud.size(), Clear_interior{points.state.data()});
}

// Returns the relations of the live shapes; `round` is the number of rounds of the loop. Two final regularizations
// follow the consolidation: the first one frees and labels points that change the fits of the second. With one of them,
// faces behind many patches are lost.
template <class Backend>
Shape_relations end_game(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                         int round)
{
  clear_interior(points);
  consolidate(points, shapes, options);
  drop_small(points, shapes, options.lasting_size);
  const Shape_relations first = regularize_finally(points, shapes, options, round, {});
  const int rounds = tuning::transfer::maximum_rounds;
  transfer_points(points, shapes, options, first, {Planes::may_change, rounds, options.lasting_size});
  Shape_relations relations = regularize_finally(points, shapes, options, round, first);
  transfer_points(points, shapes, options, relations, {Planes::are_fixed, rounds, options.lasting_size});
  clear_interior(points);
  reassign_to_larger(points, shapes, options);
  if(options.has_estimated_normals)
    sharpen_edges(points, shapes, options);
  clear_interior(points);
  relabel_small_components(points, shapes, options);
  return relations;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
