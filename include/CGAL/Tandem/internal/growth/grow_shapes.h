// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One growth pass over all cells, and what it changes in the table of shapes.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H

#include <CGAL/Tandem/internal/growth/grow_cell.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int maximum_growth_rounds = 256;

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
    if(label[i] != free_label)
      return;
    const std::uint32_t* row = cloud.row(i);
    std::int64_t minimum = 0;
    std::uint32_t last = free_label; // most neighbors that have a shape have the same one
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t s = label[row[j]];
      if(s >= first_mark || s == last || s == proposal[b])
        continue;
      last = s;
      if(!fits(plane[s], cloud.point[i], tolerance))
        continue;
      const std::int64_t e = signed_distance(plane[s], cloud.point[i]);
      const std::int64_t distance = e < 0 ? -e : e;
      if(proposal[b] == no_index || distance < minimum || (distance == minimum && s < proposal[b])) {
        proposal[b] = s;
        minimum = distance;
      }
    }
  }
};

// What the cells have from pass to pass, by cell or by position.
struct Cell_tables {
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
  Cell_tables tables;
  const std::uint32_t* new_shape; // by cell: the first of the ids for what begins there

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch& scratch, std::uint32_t c) const
  {
    const Range border = tables.border_of[c];
    const Cell_job job = {
      tables.cells[c],
      tables.border + border.first,
      tables.proposal + border.first,
      border.size(),
      tables.seed + tables.cells[c].first,
      tables.seed_count[c],
      tables.seed_cursor + c,
      new_shape[c],
      tables.cells.shapes[c].may_have(block, [&](std::uint32_t s) { return shapes.is_restarted[s] != 0; })};
    Cell_growth<Backend, Block, Scratch>(block, scratch, job, cloud, shapes, labels, options).run();
  }
};

// Ids for as many shapes as may begin in each cell, behind those of the shapes that there are:
// where those of each cell begin, and at last the end of all ids.
template <class Backend>
std::vector<std::uint32_t> new_ids(const Tandem_state<Backend>& t)
{
  std::vector<std::uint32_t> first(t.number_of_cells + 1);
  first[0] = std::uint32_t(t.shapes.size());
  for(std::size_t c = 0; c < t.number_of_cells; ++c)
    first[c + 1] =
      first[c] + (std::min)(std::uint32_t(t.options.growth.seeds_in_flight), t.seeds.count[c] - t.seed_cursor[c]);
  return first;
}

template <class Backend>
void grow_cells(Tandem_state<Backend>& t, const std::vector<std::uint32_t>& first_id)
{
  const std::size_t ids = first_id.back();
  typename Backend::template Buffer<Plane> plane(ids);
  typename Backend::template Buffer<std::uint16_t> rounds(ids);
  t.backend.from_host(t.plane.data(), t.plane.size(), plane.data());
  t.backend.from_host(t.rounds.data(), t.rounds.size(), rounds.data());
  t.is_restarted.resize(ids, 0);
  auto cursor = t.backend.read_write_access(t.seed_cursor);
  const auto is_restarted = t.backend.read_access(t.is_restarted);
  const auto seed_count = t.backend.read_access(t.seeds.count);
  const auto first = t.backend.read_access(first_id);
  t.backend.for_each(t.border.size(), Propose{t.cloud, t.label.data(), plane.data(), t.border.data(), t.proposal.data(),
                                              t.options.growth.tolerance});
  const Shapes_view shapes = {plane.data(), rounds.data(), is_restarted.data(), start_deltas(t, ids)};
  const Cell_tables tables = {t.cells_view(),      t.cell_border.data(), t.border.data(), t.proposal.data(),
                              t.seeds.seed.data(), seed_count.data(),    cursor.data()};
  const Grow_cells<Backend> body = {t.cloud, shapes, t.labels(), t.options.growth, tables, first.data()};
  if(t.options.cell_size <= small_cell)
    t.backend.template for_each_cell<Growth_scratch<small_cell>>(t.number_of_cells, body);
  else
    t.backend.template for_each_cell<Growth_scratch<largest_cell>>(t.number_of_cells, body);
  cursor.copy_back();
}

struct Take_ids {
  const std::uint32_t* new_id; // by old id
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(label[i] < first_mark)
      label[i] = new_id[label[i]];
  }
};

// The shapes are those that were live, and those of the gains behind them. Those that have begun
// get the ids behind the others, in the labels and the gains; where most ids have gone out of use,
// all shapes get new ones, in the same order.
template <class Backend>
void number_shapes(Tandem_state<Backend>& t, std::size_t ids, Host_buffer<Shape_delta>& deltas)
{
  const std::size_t old_ids = t.shapes.size();
  const bool is_sparse = 2 * t.live.size() < old_ids;
  std::vector<std::uint32_t> new_id(ids, free_label);
  t.backend.for_each_on_host(t.live.size(),
                             [&](std::size_t l) { new_id[t.live[l]] = is_sparse ? std::uint32_t(l) : t.live[l]; });
  if(is_sparse) {
    t.shapes.keep(t.backend, t.live);
    for(std::size_t l = 0; l < t.live.size(); ++l)
      t.plane[l] = t.plane[t.live[l]]; // l <= live[l]
  }
  const std::size_t kept = t.shapes.size();
  const Shape_delta* const begun =
    std::partition_point(deltas.begin(), deltas.end(), [&](const Shape_delta& delta) { return delta.id < old_ids; });
  const std::size_t first_begun = std::size_t(begun - deltas.begin()), next = kept + deltas.size() - first_begun;
  t.backend.for_each_on_host(deltas.size(), [&](std::size_t g) {
    std::uint32_t& id = new_id[deltas[g].id];
    if(g >= first_begun)
      id = std::uint32_t(kept + (g - first_begun));
    deltas[g].id = id;
  });
  if(is_sparse || next > kept) {
    const auto numbers = t.backend.read_access(new_id);
    t.backend.for_each(t.cloud.size, Take_ids{numbers.data(), t.label.data()});
  }
  if(is_sparse)
    std::iota(t.live.begin(), t.live.end(), 0u);
  t.live.reserve(t.live.size() + (next - kept));
  for(std::size_t id = kept; id < next; ++id)
    t.live.push_back(std::uint32_t(id));
  t.shapes.resize(t.backend, next);
  t.plane.resize(next);
  t.rounds.resize(next);
  t.is_restarted.assign(next, 0);
}

// What the shapes gained, and their part in the next pass.
template <class Backend>
void apply_deltas(Tandem_state<Backend>& t, const Host_buffer<Shape_delta>& deltas)
{
  t.backend.for_each_on_host(t.live.size(), [&](std::size_t l) {
    const std::uint32_t id = t.live[l];
    Shape& shape = t.shapes[id];
    shape.is_active = false;
    ++shape.age;
    t.rounds[id] = std::uint16_t(shape.age < 9 ? 1 << shape.age : maximum_growth_rounds);
  });
  t.assigned += std::size_t(sum_on_host(t.backend, deltas.size(), [&](std::size_t g) {
    Shape& shape = t.shapes[deltas[g].id];
    shape.moments += deltas[g].sums.moments();
    shape.box.add(deltas[g].sums.box);
    shape.is_active = shape.is_dirty = shape.is_changed = true;
    return deltas[g].sums.count;
  }));
}

// Returns the number of points that were gained.
template <class Backend>
std::size_t grow_shapes(Tandem_state<Backend>& t)
{
  const std::size_t before = t.assigned;
  const std::vector<std::uint32_t> first_id = new_ids(t);
  grow_cells(t, first_id);
  Host_buffer<Shape_delta> deltas = take_deltas(t, first_id.back());
  number_shapes(t, first_id.back(), deltas);
  apply_deltas(t, deltas);
  list_shapes(t);
  return t.assigned - before;
}

// So that shapes that have just begun can go on growing before they have relations. They are on the frontier as a whole.
template <class Backend>
void take_local_planes(Tandem_state<Backend>& t)
{
  t.backend.for_each_on_host(t.live.size(), [&](std::size_t l) {
    Shape& shape = t.shapes[t.live[l]];
    if(shape.age != 1)
      return;
    refit_if_dirty(shape);
    t.plane[t.live[l]] = rounded(shape.local);
    shape.restarted = shape.local;
  });
}

// Whether a cell has many untried candidates: as many as the smallest shape has points, or more than a quarter of
// its points.
struct Find_untried_cells {
  Labels_view labels;
  Cells_view cells;
  const std::uint32_t* seed;
  const std::uint32_t* seed_count;
  const std::uint32_t* seed_cursor;
  std::uint32_t smallest_shape;
  std::uint8_t* is_found;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, std::uint32_t& untried, std::uint32_t c) const
  {
    const std::uint32_t first = cells[c].first + seed_cursor[c];
    const std::uint32_t quarter = cells[c].size() / 4 + 1;
    block.single([&] { untried = 0; });
    block.for_each(seed_count[c] - seed_cursor[c], [&](std::uint32_t at) {
      if(labels.is_untried(seed[first + at]))
        block.append(untried);
    });
    block.single([&] { is_found[c] = untried >= (quarter < smallest_shape ? quarter : smallest_shape); });
  }
};

template <class Backend>
std::size_t count_untried_cells(Tandem_state<Backend>& t)
{
  std::vector<std::uint8_t> is_untried(t.number_of_cells);
  const auto count = t.backend.read_access(t.seeds.count);
  const auto cursor = t.backend.read_access(t.seed_cursor);
  auto found = t.backend.write_access(is_untried);
  const std::uint32_t smallest = std::uint32_t((std::min)(t.options.minimum_region_size, std::int64_t(t.cloud.size)));
  t.backend.template for_each_cell<std::uint32_t>(
    t.number_of_cells, Find_untried_cells{t.labels(), t.cells_view(), t.seeds.seed.data(), count.data(), cursor.data(),
                                          smallest, found.data()});
  found.copy_back();
  return std::size_t(std::count(is_untried.begin(), is_untried.end(), 1));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
