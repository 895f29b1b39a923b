// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One growth pass over all leaves, and what it changes in the table of shapes.

#ifndef CGAL_TANDEM_INTERNAL_GROW_SHAPES_H
#define CGAL_TANDEM_INTERNAL_GROW_SHAPES_H

#include <CGAL/Tandem/internal/gains.h>
#include <CGAL/Tandem/internal/leaf_shapes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int most_growth_rounds = 256;

// A free border point proposes to join the nearest shape among those of its
// neighbors that it fits. Labels and planes do not change meanwhile.
struct Propose {
  Cloud_view cloud;
  const std::uint32_t* label;
  const Plane* plane;
  const std::uint32_t* border;
  std::uint32_t* proposal;
  Tolerance tolerance;

  CGAL_TANDEM_HD void operator()(std::size_t b) const
  {
    const std::uint32_t i = border[b];
    proposal[b] = no_index;
    if(label[i] != is_free)
      return;
    const std::uint32_t* row = cloud.row(i);
    std::int64_t least = 0;
    std::uint32_t last = is_free; // most neighbors that have a shape have the same one
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t s = label[row[j]];
      if(s >= first_mark || s == last || s == proposal[b])
        continue;
      last = s;
      if(!fits(plane[s], cloud.point[i], tolerance))
        continue;
      const std::int64_t e = signed_distance(plane[s], cloud.point[i]);
      const std::int64_t distance = e < 0 ? -e : e;
      if(proposal[b] == no_index || distance < least || (distance == least && s < proposal[b])) {
        proposal[b] = s;
        least = distance;
      }
    }
  }
};

// What the leaves have from pass to pass, by leaf or by position.
struct Leaves_view {
  Cells_view cells;
  const Range* border_of; // in `border`
  const std::uint32_t* border;
  const std::uint32_t* proposal;
  const std::uint32_t* seed;
  const std::uint32_t* seed_count;
  std::uint32_t* seed_cursor;
};

template <class Backend>
struct Grow_cells {
  Cloud_view cloud;
  Shapes_view shapes;
  Labels_view labels;
  Growth_options options;
  Leaves_view leaves;
  const std::uint32_t* new_shape;
  const std::uint32_t* first_new; // of each leaf, in new_shape

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch& scratch, std::uint32_t c) const
  {
    const Range border = leaves.border_of[c];
    const Cell_job job = {
      leaves.cells[c],
      leaves.border + border.first,
      leaves.proposal + border.first,
      border.size(),
      leaves.seed + leaves.cells[c].first,
      leaves.seed_count[c],
      leaves.seed_cursor + c,
      new_shape + first_new[c],
      leaves.cells.shapes[c].may_have([&](std::uint32_t s) { return shapes.is_restarted[s] != 0; })};
    Cell_growth<Backend, Block, Scratch>(block, scratch, job, cloud, shapes, labels, options).run();
  }
};

// As many new shapes as may begin in each leaf: where its ids begin in the list of all.
template <class Backend>
std::vector<std::uint32_t> number_new_shapes(Tandem_state<Backend>& t, std::vector<std::uint32_t>& new_ids)
{
  std::vector<std::uint32_t> first(t.number_of_cells);
  std::uint32_t wanted = 0;
  for(std::size_t c = 0; c < first.size(); ++c) {
    first[c] = wanted;
    wanted += t.seed_cursor[c] < t.seeds.count[c] ? std::uint32_t(t.options.growth.seeds_in_flight) : 0;
  }
  new_ids = spare_ids(t, wanted);
  return first;
}

// A growth pass later: what the shape gained, and its part in the next pass.
template <class Backend>
void take_gain(Tandem_state<Backend>& t, std::uint32_t id, const Shared_moments* gain)
{
  Shape& shape = t.shapes[id];
  shape.gained = gain != nullptr ? gain->count : 0;
  if(gain != nullptr) {
    shape.moments += gain->moments();
    shape.box.add(gain->box);
    shape.is_dirty = shape.is_changed = true;
    t.assigned += std::size_t(gain->count);
  }
  shape.is_active = shape.gained > 0;
  ++shape.age;
  t.is_restarted[id] = 0;
  t.rounds[id] = std::uint16_t(shape.age < 9 ? 1 << shape.age : most_growth_rounds);
}

// Of all shapes; those that have just begun become live.
template <class Backend>
void take_all_gains(Tandem_state<Backend>& t)
{
  const std::vector<Gain> gains = take_gains(t);
  std::vector<std::uint32_t> live;
  auto next = gains.begin();
  for(std::size_t l = 0; l < t.live.size() || next != gains.end();) {
    const std::uint32_t id = l < t.live.size() ? t.live[l] : no_index;
    const bool has_gain = next != gains.end() && next->id <= id;
    live.push_back(has_gain ? next->id : id);
    take_gain(t, live.back(), has_gain ? &next->sums : nullptr);
    l += live.back() == id;
    next += has_gain;
  }
  t.live.swap(live);
}

template <class Backend>
void grow_cells(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& new_ids,
                const std::vector<std::uint32_t>& first_new)
{
  auto plane = t.backend.lend_out(t.plane);
  auto rounds = t.backend.lend_out(t.rounds);
  auto cursor = t.backend.lend_out(t.seed_cursor);
  const auto is_restarted = t.backend.lend(t.is_restarted);
  const auto seed_count = t.backend.lend(t.seeds.count);
  const auto ids = t.backend.lend(new_ids);
  const auto first = t.backend.lend(first_new);
  t.backend.for_each(t.border.size(), Propose{t.cloud, t.label.data(), plane.data(), t.border.data(), t.proposal.data(),
                                              t.options.growth.tolerance});
  const Shapes_view shapes = {plane.data(), rounds.data(), is_restarted.data(), start_gains(t)};
  const Leaves_view leaves = {t.cells_view(),      t.cell_border.data(), t.border.data(), t.proposal.data(),
                              t.seeds.seed.data(), seed_count.data(),    cursor.data()};
  const Grow_cells<Backend> body = {t.cloud, shapes, t.labels(), t.options.growth, leaves, ids.data(), first.data()};
  if(t.options.cell_size <= small_cell)
    t.backend.template for_each_cell<Growth_scratch<small_cell>>(t.number_of_cells, body);
  else
    t.backend.template for_each_cell<Growth_scratch<largest_cell>>(t.number_of_cells, body);
  cursor.take_back();
}

// Returns the number of points that were gained.
template <class Backend>
std::size_t grow_shapes(Tandem_state<Backend>& t)
{
  const std::size_t before = t.assigned;
  std::vector<std::uint32_t> new_ids;
  const std::vector<std::uint32_t> first_new = number_new_shapes(t, new_ids);
  grow_cells(t, new_ids, first_new);
  take_all_gains(t);
  list_shapes(t);
  return t.assigned - before;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROW_SHAPES_H
