// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// After the last round: fragments are consolidated, the relations are taken once
// more over what is left, and free points are absorbed.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
#define CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H

#include <CGAL/Tandem/internal/finish/propagate_labels.h>
#include <CGAL/Tandem/internal/finish/reassign.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int consolidation_rounds = 2;
constexpr double consolidation_misfit_share = 0.15;
constexpr int reassignment_rounds = 4;

template <class Backend>
std::vector<std::uint8_t> shapes_below(const Tandem_state<Backend>& t, std::int64_t size)
{
  std::vector<std::uint8_t> is_below(t.shapes.size(), 0);
  t.backend.for_each_on_host(t.live.size(),
                             [&](std::size_t l) { is_below[t.live[l]] = t.shapes[t.live[l]].moments.count < size; });
  return is_below;
}

// Checks the points of some shapes, by id, against their planes.
template <class Backend>
void detach_misfits(Tandem_state<Backend>& t, const std::vector<std::uint8_t>& is_checked)
{
  t.backend.for_each_on_host(t.live.size(), [&](std::size_t l) {
    Shape& shape = t.shapes[t.live[l]];
    t.plane[t.live[l]] = rounded(shape.plane);
    shape.checked = shape.plane;
  });
  update_points(t, identity_targets(t), is_checked);
}

template <class Backend>
std::vector<std::uint8_t> all_shapes(const Tandem_state<Backend>& t)
{
  return std::vector<std::uint8_t>(t.shapes.size(), 1);
}

template <class Backend>
void drop_small(Tandem_state<Backend>& t)
{
  drop_shapes(t,
              [&](const Shape& shape, std::uint32_t) { return shape.moments.count < t.options.minimum_region_size; });
}

template <class Backend>
void refit_fragments(Tandem_state<Backend>& t, const std::vector<std::uint8_t>& is_fragment)
{
  refit_shapes(t);
  t.backend.for_each_on_host(t.live.size(), [&](std::size_t l) {
    if(is_fragment[t.live[l]])
      t.shapes[t.live[l]].plane = t.shapes[t.live[l]].local;
  });
}

// Fragments below the minimum size are not lost at once: they may be parts of one
// shape, or of their neighbors.
template <class Backend>
void consolidate(Tandem_state<Backend>& t)
{
  for(int round = 0; round < consolidation_rounds; ++round) {
    const std::vector<std::uint8_t> is_fragment = shapes_below(t, t.options.minimum_region_size);
    const std::size_t shapes_before = t.live.size(), assigned_before = t.assigned;
    refit_fragments(t, is_fragment);
    detach_misfits(t, is_fragment);
    Link_list links = collect_links(t, minimum_links, Links::all, [&] { refit_shapes(t); });
    links.erase(std::remove_if(links.begin(), links.end(),
                               [&](const Link& l) { return !is_fragment[l.first()] || !is_fragment[l.second()]; }),
                links.end());
    if(merge_fragments(t, links, consolidation_misfit_share))
      refit_fragments(t, is_fragment);
    t.sample.reset(0); // others need the memory
    detach_misfits(t, is_fragment);
    propagate_labels(t);
    reassign(t, shapes_below(t, t.options.minimum_region_size), all_shapes(t), false);
    recount(t);
    if(t.live.size() * 50 >= shapes_before * 49 && t.assigned * 1000 < assigned_before * 1001)
      break;
  }
}

// A last regularity step over all shapes, which have just been counted; returns the
// relations, by shape. `before`: those of the last such step.
template <class Backend>
Shape_relations regularize_finally(Tandem_state<Backend>& t, const Shape_relations& before = {})
{
  refit_shapes(t);
  const Shape_relations relations = regularize_shapes(t, true, before);
  t.sample.reset(0); // others need the memory
  merge_points(t, coplanar_targets(t, relations, collect_links(t, minimum_links, Links::all)));
  detach_misfits(t, all_shapes(t));
  propagate_labels(t);
  recount(t);
  drop_small(t);
  return relations;
}

template <class Backend>
void reassign_to_larger(Tandem_state<Backend>& t)
{
  bool is_any = true;
  for(int round = 0; round < reassignment_rounds && is_any; ++round) {
    std::vector<std::uint8_t> may_lose(t.shapes.size(), 1);
    for(std::uint32_t id : t.live)
      may_lose[id] = 2 * t.shapes[id].moments.count >= 3 * t.options.minimum_region_size;
    is_any = reassign(t, may_lose, all_shapes(t), true);
    drop_empty_shapes(t);
  }
  list_shapes(t);
  drop_small(t);
}

// The loop takes a point for interior once all of its neighbors have had its label;
// some have lost it since.
struct Clear_interior {
  std::uint8_t* state;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { state[i] &= std::uint8_t(~interior_bit); }
};

template <class Backend>
void clear_interior(Tandem_state<Backend>& t)
{
  t.backend.for_each(t.cloud.size, Clear_interior{t.state.data()});
}

// Planes are final afterwards.
template <class Backend>
Shape_relations end_game(Tandem_state<Backend>& t)
{
  clear_interior(t);
  consolidate(t);
  drop_small(t);
  const Shape_relations relations = regularize_finally(t, regularize_finally(t));
  clear_interior(t);
  reassign_to_larger(t);
  return relations;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_END_GAME_H
