// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages between the last round and the extraction of the result. Fragments are merged or dropped, relations are
// found once more, free points are labeled, and points go to larger shapes. Changes labels, states, shapes, planes, and
// estimated normals near edges. Planes are final at its end. See the manual, "End Game".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
#define CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H

#include <CGAL/Tandem/internal/base/Progress.h>
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

struct Mark_below {
  const std::int64_t* size;
  std::int64_t minimum;
  std::uint8_t* is_below;

  CGAL_TANDEM_HD void operator()(std::size_t id) const { is_below[id] = size[id] > 0 && size[id] < minimum; }
};

// By id.
template <class Backend>
using Marks = typename Backend::template Buffer<std::uint8_t>;
template <class Backend>
using Sizes = typename Backend::template Buffer<std::int64_t>;

// 1 for live shapes of less than `minimum` points, 0 for all other entries.
template <class Backend>
Marks<Backend> shapes_below(Backend& backend, const Sizes<Backend>& size, std::int64_t minimum)
{
  Marks<Backend> is_below(size.size());
  backend.for_each(size.size(), Mark_below{size.data(), minimum, is_below.data()}, shapes_per_thread);
  return is_below;
}

// The table that selects every shape.
template <class Backend>
Marks<Backend> all_shapes(Backend& backend, const Shape_table<Backend>& shapes)
{
  return filled_buffer(backend, shapes.size, std::uint8_t(1));
}

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

// Rounds the planes of all live shapes for the tests of points. Then points of the checked shapes that do not fit
// become free, and the moments of these shapes follow.
template <class Backend>
void detach_misfits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Marks<Backend>& is_checked,
                    const Tolerance& tolerance)
{
  require(points, shapes, tables::moments);
  for_each_shape(points.backend, shapes, Round_plane{shapes.counted(), shapes.plane.data()});
  update_points(points, shapes, identity_targets(points.backend, shapes.size), is_checked.data(), tolerance);
}

struct Take_local {
  Shape* shape;
  const std::uint8_t* is_fragment;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(is_fragment[id])
      shape[id].plane = shape[id].local;
  }
};

// Fragments take their local planes, as after a rollback.
template <class Backend>
void take_planes_of_fragments(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                              const Marks<Backend>& is_fragment)
{
  require(points, shapes, tables::fits);
  for_each_shape(points.backend, shapes, Take_local{shapes.fitted(), is_fragment.data()});
}

struct Take_links_of_fragments {
  const Link* link;
  const std::uint8_t* is_fragment;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const
  {
    return is_fragment[link[i].first()] && is_fragment[link[i].second()];
  }
  CGAL_TANDEM_HD Link take(std::uint32_t i) const { return link[i]; }
};

// Merges linked fragments by joint fit: see merge_by_joint_fit.h. Larger shapes take no part here; they take points of
// fragments in the reassignment that follows. More misfits are tolerated than in the loop, because fragments that stay
// small are dropped.
template <class Backend>
void join_fragments(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                    const Marks<Backend>& is_fragment)
{
  Backend& backend = points.backend;
  const auto all = collect_links(points, shapes, Links::all, Phase::end);
  auto links = backend.template collect<Link>(all.size(), Take_links_of_fragments{all.data(), is_fragment.data()});
  Sample_memory<Backend> memory;
  const Joint_fit_merge<Backend> merge = {tuning::merging::final_misfit_share, memory};
  if(is_any_joined(backend, merge_by_joint_fit(points, shapes, options, links, merge)))
    take_planes_of_fragments(points, shapes, is_fragment);
}

// Fragments are not dropped at once: they may be parts of one face, or of a larger neighbor. There are two rounds,
// because with one of them, faces behind many patches are lost. A round that changes little is the last one. The sizes
// by which points are reassigned are those before free points are labeled.
template <class Backend>
void consolidate(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  using namespace tuning::end_game;
  const Tolerance& tolerance = options.growth.tolerance;
  Backend& backend = points.backend;
  for(int round = 0; round < consolidation_rounds; ++round) {
    require(points, shapes, tables::moments);
    const Shape_counts before = count_live(backend, shapes);
    const auto is_fragment = shapes_below(backend, sizes_of(backend, shapes), options.minimum_region_size);
    take_planes_of_fragments(points, shapes, is_fragment);
    detach_misfits(points, shapes, is_fragment, tolerance);
    join_fragments(points, shapes, options, is_fragment);
    detach_misfits(points, shapes, is_fragment, tolerance);
    const auto size = sizes_of(backend, shapes);
    const auto may_lose = shapes_below(backend, size, options.minimum_region_size);
    propagate_labels(points, shapes, tolerance, Phase::end);
    reassign(points, shapes, tolerance, {size.data(), may_lose.data(), Phase::end, false});
    require(points, shapes, tables::moments);
    const Shape_counts now = count_live(backend, shapes);
    if(kept_shapes.is_reached(std::int64_t(now.shapes), std::int64_t(before.shapes)) &&
       !grown_points.is_reached(std::int64_t(now.points), std::int64_t(before.points)))
      break;
  }
}

// One regularization of all shapes, with labels and shapes that follow from it. Returns the relations, by shape.
// `before`: those of the last such step, which are kept where little has changed.
template <class Backend>
Shape_relations regularize_finally(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                   int round, const Shape_relations& before)
{
  Backend& backend = points.backend;
  const Tolerance& tolerance = options.growth.tolerance;
  Sample_memory<Backend> memory;
  Shape_relations relations = regularize_shapes(points, shapes, options, {round, true, memory}, before);
  memory.sample.release();
  const auto links = collect_links(points, shapes, Links::all, Phase::end);
  merge_points(points, shapes, coplanar_targets(backend, shapes, links));
  detach_misfits(points, shapes, all_shapes(backend, shapes), tolerance);
  propagate_labels(points, shapes, tolerance, Phase::end);
  drop_small(points, shapes, options.lasting_size);
  return relations;
}

struct Mark_safe {
  const std::int64_t* size;
  std::int64_t minimum_size;
  std::uint8_t* is_safe;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    constexpr tuning::Share safe_size = tuning::end_game::safe_size;
    is_safe[id] = safe_size.is_reached(size[id], minimum_size);
  }
};

// Points go to the largest shape that they fit: see Choose_largest. Planes stay, since none is fitted afterwards.
// Only shapes well above the minimum size lose points; those that fall below it all the same are dropped.
template <class Backend>
void reassign_to_larger(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  Marks<Backend> may_lose(shapes.size);
  bool is_any = true;
  for(int round = 0; round < tuning::end_game::reassignment_rounds && is_any; ++round) {
    require(points, shapes, tables::moments);
    const auto size = sizes_of(points.backend, shapes);
    for_each_shape(points.backend, shapes, Mark_safe{size.data(), options.minimum_region_size, may_lose.data()});
    is_any =
      reassign(points, shapes, options.growth.tolerance, {size.data(), may_lose.data(), Phase::reassignment, true});
  }
  drop_small(points, shapes, options.minimum_region_size);
}

// Near edges, estimated normals are blended. Points go to their side of the edge. Then the normals near edges are those
// of one shape, and points that do not fit with them are free.
template <class Backend>
void sharpen_edges(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  const Tolerance& tolerance = options.growth.tolerance;
  choose_sides(points, shapes, tolerance);
  fit_normals_to_shapes(points, shapes, tolerance);
  detach_misfits(points, shapes, all_shapes(points.backend, shapes), tolerance);
  drop_small(points, shapes, options.minimum_region_size);
}

// Returns the relations of the live shapes; `round` is the number of rounds of the loop. It runs to its end even if the
// callback cancels, so that what it has is verified. Two final regularizations
// follow the consolidation: the first one frees and labels points that change the fits of the second. With one of them,
// faces behind many patches are lost.
template <class Backend>
Shape_relations end_game(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                         int round, Progress& progress)
{
  const auto show = [&](double share) { progress.show(Detection_stage::end_game, share); };
  consolidate(points, shapes, options);
  drop_small(points, shapes, options.lasting_size);
  show(.2);
  const Shape_relations first = regularize_finally(points, shapes, options, round, {});
  show(.4);
  const int rounds = tuning::transfer::maximum_rounds;
  transfer_points(points, shapes, options, {Planes::may_change, rounds, options.lasting_size, Phase::end});
  Shape_relations relations = regularize_finally(points, shapes, options, round, first);
  show(.6);
  transfer_points(points, shapes, options, {Planes::are_fixed, rounds, options.lasting_size, Phase::end});
  reassign_to_larger(points, shapes, options);
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
