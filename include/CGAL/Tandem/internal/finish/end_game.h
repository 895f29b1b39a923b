// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// After the last round: fragments are consolidated, the relations are found once more over what is left, and free points
// are labeled.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
#define CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H

#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/finish/reassign.h>
#include <CGAL/Tandem/internal/rounds/merge_coplanar.h>
#include <CGAL/Tandem/internal/rounds/merge_fragments.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Backend>
std::vector<std::uint8_t> shapes_below(Backend& backend, const Shape_table<Backend>& shapes, std::int64_t size)
{
  std::vector<std::uint8_t> is_below(shapes.size(), 0);
  backend.for_each_on_host(
    shapes.live.size(), [&](std::size_t l) { is_below[shapes.live[l]] = shapes[shapes.live[l]].moments.count < size; });
  return is_below;
}

inline std::vector<std::uint8_t> all_shapes(std::size_t shapes) { return std::vector<std::uint8_t>(shapes, 1); }

// Hands the planes over to the points, and checks the points of some shapes against them.
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

template <class Backend>
void drop_small(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, std::int64_t minimum_size)
{
  drop_shapes(points, shapes, [&](const Shape& shape, std::uint32_t) { return shape.moments.count < minimum_size; });
}

template <class Backend>
void refit_fragments(Backend& backend, Shape_table<Backend>& shapes, const std::vector<std::uint8_t>& is_fragment)
{
  refit_shapes(backend, shapes);
  backend.for_each_on_host(shapes.live.size(), [&](std::size_t l) {
    if(is_fragment[shapes.live[l]])
      shapes[shapes.live[l]].plane = shapes[shapes.live[l]].local;
  });
}

// Fragments that touch become one shape where one plane fits them.
template <class Backend>
void join_fragments(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                    const std::vector<std::uint8_t>& is_fragment)
{
  Link_list links = collect_links(points, shapes, Links::all, [&] { refit_shapes(points.backend, shapes); });
  links.erase(std::remove_if(links.begin(), links.end(),
                             [&](const Link& l) { return !is_fragment[l.first()] || !is_fragment[l.second()]; }),
              links.end());
  if(merge_fragments(points, shapes, options, links, tuning::merging::final_misfit_share))
    refit_fragments(points.backend, shapes, is_fragment);
  points.sample.reset(0); // others need the memory
}

// Fragments below the minimum size are not lost at once: they may be parts of one shape, or of their neighbors.
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

// A last regularity step over all shapes, which have just been counted; returns the relations, by shape. `before`:
// those of the last such step.
template <class Backend>
Shape_relations regularize_finally(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                                   int round, const Shape_relations& before)
{
  Backend& backend = points.backend;
  const Tolerance& tolerance = options.growth.tolerance;
  refit_shapes(backend, shapes);
  const Shape_relations relations = regularize_shapes(points, shapes, options, {round, true}, before);
  points.sample.reset(0); // others need the memory
  const Link_list links = collect_links(points, shapes, Links::all);
  merge_points(points, shapes, coplanar_targets(backend, shapes, relations, links));
  detach_misfits(points, shapes, {all_shapes(shapes.size()), tolerance});
  propagate_labels(points, shapes.plane, tolerance);
  recount(points, shapes);
  drop_small(points, shapes, options.minimum_region_size);
  return relations;
}

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

// The loop takes a point for interior once all of its neighbors have had its label; some have lost it since.
struct Clear_interior {
  std::uint8_t* state;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { state[i] &= std::uint8_t(~interior_bit); }
};

template <class Backend>
void clear_interior(Labeled_cloud<Backend>& points)
{
  points.backend.for_each(points.cloud.size(), Clear_interior{points.state.data()});
}

// Planes are final afterwards. round: of the loop.
template <class Backend>
Shape_relations end_game(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options,
                         int round)
{
  clear_interior(points);
  consolidate(points, shapes, options);
  drop_small(points, shapes, options.minimum_region_size);
  const Shape_relations first = regularize_finally(points, shapes, options, round, {});
  const Shape_relations relations = regularize_finally(points, shapes, options, round, first);
  clear_interior(points);
  reassign_to_larger(points, shapes, options);
  return relations;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
