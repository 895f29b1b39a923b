// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A pass of growth, and what it changes in the table of shapes: ids, moments, boxes, ages. No plane is fitted here, but
// those of take_local_planes(). This is the only place where ids change.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/growth/grow_cell.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Seeds.h>
#include <CGAL/Tandem/internal/shapes/update_tables.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

#include <algorithm>
#include <array>
#include <utility>

namespace CGAL::Tandem::internal {

// --- The surfels at which shapes grow from one cell into the next. Computed once, as the neighbors and the cells stay.
// Fills the Border of the cloud, nothing else.

// Whether the surfels of a cell have a neighbor in another one. Only its own row counts, since proposals are
// made along that row.
struct Mark_border {
  Cloud_view cloud;
  const Range* cells;
  std::uint8_t* is_border; // by position

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, No_scratch&, std::uint32_t c) const
  {
    const Range cell = cells[c];
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t* row = cloud.row(cell.first + at);
      bool has_other = false;
      for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
        has_other |= row[j] - cell.first >= cell.size();
      is_border[cell.first + at] = has_other;
    });
  }
};

// The entries of `border` that lie in each cell, by binary search: they ascend, and so do the cells.
struct Find_cell_borders {
  const Range* cells;
  const std::uint32_t* border;
  std::uint32_t size;
  Range* cell_border;

  CGAL_TANDEM_HD void operator()(std::size_t c) const
  {
    cell_border[c] = {first_from(cells[c].first), first_from(cells[c].last)};
  }

private:
  CGAL_TANDEM_HD std::uint32_t first_from(std::uint32_t point) const
  {
    return partition_point(0, size, [&](std::uint32_t b) { return border[b] < point; });
  }
};

// Finds the border surfels of all cells. The marks take one byte a surfel meanwhile, the result 8 bytes a border surfel,
// in the end game 4.
template <class Backend>
void find_border(Labeled_cloud<Backend>& points)
{
  Backend& backend = points.backend;
  Border<Backend>& border = points.border;
  const std::size_t cells = points.number_of_cells();
  Buffer_of<Backend, std::uint8_t> mark(points.cloud.number_of_surfels());
  backend.template for_each_cell<No_scratch>(cells, Mark_border{points.cloud.view(), points.cells.data(), mark.data()});
  border.surfel = backend.compact(points.cloud.number_of_surfels(), Is_marked{mark.data()});
  border.range.reset(cells);
  backend.for_each(cells, Find_cell_borders{points.cells.data(), border.surfel.data(),
                                            std::uint32_t(border.surfel.size()), border.range.data()});
  border.proposal.reset(border.surfel.size());
}

// --- One pass of growth over all cells. Changes labels, states, seed cursors, proposals and the sums of the shapes. The
// table of shapes follows below. Also: which cells still have many untried seeds.

// The proposal for a free border surfel: the nearest shape among those of its neighbors that it fits, of equally near
// ones the smallest id. Labels and planes do not change meanwhile, so the surfels may come in any order.
struct Propose {
  Cloud_view cloud;
  const std::uint32_t* label; // by position
  const Plane* plane;         // by shape
  const std::uint32_t* border;
  std::uint32_t* proposal; // by entry of border
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
      if(!cloud.fits(plane[s], i, tolerance))
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

// The tables that cells keep from pass to pass.
struct Cell_tables {
  Cells_view cells;
  Border_view border;
  Seeds_view seeds;
};

// The body of a pass: makes the job of a cell from the tables.
template <class Backend>
struct Grow_cells {
  Cloud_view cloud;
  Shapes_view shapes;
  Labels_view labels;
  Growth_parameters options;
  Cell_tables tables;
  std::uint32_t first_new; // the ids from here on are those of new shapes, so many for each cell as may start there

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch& scratch, std::uint32_t c) const
  {
    const Range border = tables.border.range[c];
    const Cell_job job = {
      tables.cells[c],
      tables.border.surfel + border.first,
      tables.border.proposal + border.first,
      border.size(),
      tables.seeds.seed + tables.cells[c].first,
      tables.seeds.count[c],
      tables.seeds.cursor + c,
      first_new + c * tuning::growth::seeds_per_cell,
      tables.cells.may_have(block, c, [&](std::uint32_t s) { return shapes.is_restarted[s] != 0; })};
    Cell_growth<Backend, Block, Scratch>(block, scratch, {job, cloud, shapes, labels, options}).run();
  }
};

// Copies what growth reads of the shapes, as there has to be room for new ones.
struct Copy_for_growth {
  const Plane* plane;
  const std::uint8_t* is_restarted;
  std::size_t shapes;
  Shapes_view copy;
  std::uint8_t* is_restarted_copy;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(id < shapes)
      copy.plane[id] = plane[id];
    is_restarted_copy[id] = id < shapes ? is_restarted[id] : 0;
  }
};

// Runs one pass of growth over all cells. Returns the end of the ids: each cell has some of its own for shapes that may
// start, so that cells need no common counter, and new ids follow from the order of cells and seeds.
template <class Backend>
std::size_t grow_cells(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Seeds<Backend>& seeds,
                       const Growth_parameters& options)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::lists);
  Border<Backend>& border = points.border;
  const std::size_t cells = points.number_of_cells();
  const std::size_t ids = shapes.size + cells * std::size_t(tuning::growth::seeds_per_cell);
  const Cloud_view cloud = points.cloud.view();
  Buffer_of<Backend, Plane> plane(ids);
  Buffer_of<Backend, std::uint8_t> is_restarted(ids);
  const Shapes_view view = {plane.data(), is_restarted.data(), start_deltas(backend, shapes, ids)};
  backend.for_each(
    ids, Copy_for_growth{shapes.plane.data(), shapes.is_restarted.data(), shapes.size, view, is_restarted.data()});
  backend.for_each(border.surfel.size(), Propose{cloud, points.label(), plane.data(), border.surfel.data(),
                                                 border.proposal.data(), options.tolerance});
  const Cell_tables tables = {points.listed_cells(), border.view(), seeds.view()};
  const Labels_view labels = points.change_labels(false);
  const Grow_cells<Backend> body = {cloud, view, labels, options, tables, std::uint32_t(shapes.size)};
  // Large cells need a larger queue, which does not fit into the fast memory of a device.
  if(options.cell_size <= small_cell)
    backend.template for_each_cell<Growth_scratch<small_cell>>(cells, body);
  else
    backend.template for_each_cell<Growth_scratch<largest_cell>>(cells, body);
  return ids;
}

// Whether a cell has many untried seeds: of as many points as the smallest shape has, or of more than a ratio of its
// points. Then faces may still be missing there; a few seeds in clutter are not worth a pass. See the manual, "Growth".
template <class Backend>
struct Find_untried_cells {
  Surfels_view surfels;
  const std::uint32_t* label; // by position, as is the next one
  const std::uint8_t* state;
  const Range* cells;
  Seeds_view seeds;
  std::uint32_t smallest_shape; // points
  std::uint32_t* found;         // number of cells

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, std::uint32_t& untried, std::uint32_t c) const
  {
    const std::uint32_t first = cells[c].first + seeds.cursor[c];
    const std::uint32_t points = surfels.points(cells[c].last - 1).last - surfels.points(cells[c].first).first;
    const std::uint32_t many = points / tuning::loop::points_per_untried_point + 1;
    block.single([&] { untried = 0; });
    block.for_each(seeds.count[c] - seeds.cursor[c], [&](std::uint32_t at) {
      if(is_untried(label, state, seeds.seed[first + at]))
        block.add(untried, surfels.points(seeds.seed[first + at]).size());
    });
    block.single([&] {
      if(untried >= (many < smallest_shape ? many : smallest_shape))
        Backend::atomic_add(*found, 1u);
    });
  }
};

// Adds the number of the cells that have many untried seeds, with one test for each seed from the cursors on.
template <class Backend>
void count_untried_cells(Labeled_cloud<Backend>& points, Seeds<Backend>& seeds, std::int64_t minimum_region_size,
                         std::uint32_t* found)
{
  const std::uint32_t smallest =
    std::uint32_t((std::min)({minimum_region_size, std::int64_t(points.total_points()), std::int64_t(first_mark)}));
  points.backend.template for_each_cell<std::uint32_t>(
    points.number_of_cells(), Find_untried_cells<Backend>{points.cloud.surfels(), points.label(), points.state(),
                                                          points.cells.data(), seeds.view(), smallest, found});
}

// What a pass of growth has found, and has left.
struct Growth_counts {
  std::size_t points;        // that got a shape
  std::size_t untried_cells; // that have many untried seeds
};

// Replaces old ids by new ones in the labels. No label has an id that is out of use.
struct Replace_ids {
  const std::uint32_t* new_id; // by old id
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(label[i] < first_mark)
      label[i] = new_id[label[i]];
  }
};

// Shapes that started in the pass have a delta: their core.
struct Has_started {
  const Shared_moments* delta; // from the first new id on

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return is_any(delta[i]); }
};

// Makes the entries of the new table, those of new shapes last, adds the points of the pass to them, and prepares them
// for the next pass.
struct Take_growth {
  const Shape* old_shape; // may be the new table: then ids stay
  const Plane* old_plane;
  Shape* shape;
  Plane* plane;
  std::uint8_t* is_restarted;
  Shared_moments* delta;        // by old id
  const std::uint32_t* kept;    // old ids; null if all are kept
  const std::uint32_t* started; // after the first new id
  std::uint32_t number_kept, first_new;
  std::uint32_t* new_id; // by old id

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const bool is_new = i >= number_kept;
    const std::uint32_t old = is_new            ? first_new + started[i - number_kept]
                              : kept != nullptr ? kept[i]
                                                : std::uint32_t(i);
    Shape& s = shape[i];
    if(is_new) {
      s = Shape();
      plane[i] = Plane();
    } else if(old_shape != shape) {
      s = old_shape[old];
      plane[i] = old_plane[old];
    }
    new_id[old] = std::uint32_t(i);
    is_restarted[i] = is_new;
    if(!is_new && !s.is_live())
      return;
    s.is_active = is_any(delta[old]);
    ++s.age;
    if(!s.is_active)
      return;
    s.moments += delta[old].moments();
    s.box.add(delta[old].box);
    s.history.is_fitted = false;
    s.history.is_linked = false;
    delta[old] = Shared_moments();
  }
};

// Growth_counts, then the live shapes before, and those that have started.
struct Count_grown {
  const Shape* shape;
  const Shared_moments* delta;
  std::size_t shapes;
  const std::uint32_t* untried_cells;

  CGAL_TANDEM_HD void operator()(std::size_t id, std::int64_t* sum) const
  {
    sum[0] += delta[id].count;
    sum[1] += id == 0 ? *untried_cells : 0;
    sum[2] += id < shapes && shape[id].is_live();
    sum[3] += id >= shapes && is_any(delta[id]);
  }
};

// Makes the list of the shapes that have started on this rank that of all ranks. The others get ids from `ids` on, with
// their sums. Returns the end of the ids.
template <class Backend>
std::size_t join_started(Backend& backend, const Ranks<Backend>& ranks, Shape_table<Backend>& shapes, std::size_t ids,
                         Buffer_of<Backend, std::uint32_t>& started)
{
  const std::vector<std::uint32_t> own = to_vector(backend, started);
  Buffer_of<Backend, Shared_moments> sums(own.size());
  backend.for_each(own.size(),
                   Gather_items<Shared_moments>{shapes.delta.data() + shapes.size, started.data(), sums.data()});
  std::vector<std::size_t> first;
  const std::vector<Shared_moments> all = ranks.gather(to_vector(backend, sums), &first);
  const std::size_t end = ids + all.size() - own.size(), own_first = first[ranks.own_items().rank];
  if(end >= first_mark)
    throw std::length_error("there are more than 2^31 shapes while they grow: minimum_region_size is too small");
  std::vector<Shared_moments> others;
  std::vector<std::uint32_t> joined;
  for(std::size_t i = 0; i < all.size(); ++i)
    if(i >= own_first && i < own_first + own.size())
      joined.push_back(own[i - own_first]);
    else {
      joined.push_back(std::uint32_t(ids - shapes.size + others.size()));
      others.push_back(all[i]);
    }
  started = to_buffer(backend, joined);
  const std::size_t old = shapes.delta.size();
  if(old < end) {
    shapes.delta = extended<Shared_moments>(backend, shapes.delta, end + end / 2);
    backend.for_each(shapes.delta.size() - old, Fill<Shared_moments>{shapes.delta.data() + old, Shared_moments()});
  }
  write_to(backend, others, shapes.delta.data() + ids);
  return end;
}

// Makes the table of shapes after a pass, of which `ids` is the end of the ids. New shapes get consecutive ids behind
// the others. Where most ids are out of use, all shapes get new ones, in the same order: ties are broken by id, so that
// keeps all results. So the tables stay proportional to the live shapes. Labels are rewritten only if some id is new.
// untried_cells: of this rank, where the functors run.
template <class Backend>
Growth_counts take_growth(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, std::size_t ids,
                          const std::uint32_t* untried_cells)
{
  using Ids = Buffer_of<Backend, std::uint32_t>;
  Backend& backend = points.backend;
  const std::size_t first_new = shapes.size;
  sum_deltas(backend, points.ranks, shapes);
  const auto count = [&] {
    return backend.template sum<4>(ids, Count_grown{shapes.counted(), shapes.delta.data(), first_new, untried_cells});
  };
  const Has_started has_started = {shapes.delta.data() + first_new};
  Ids started;
  std::array<std::int64_t, 4> sums;
  if constexpr(Ranks<Backend>::are_many) {
    started = backend.compact(ids - first_new, has_started);
    ids = join_started(backend, points.ranks, shapes, ids, started);
    sums = count();
  } else {
    sums = count();
    started = backend.compact(ids - first_new, has_started, std::size_t(sums[3]));
  }
  const std::size_t live = std::size_t(sums[2]);
  Shared_moments* const delta = shapes.delta.data();
  const bool is_sparse = 2 * live < first_new;
  const Ids kept = is_sparse ? backend.compact(first_new, Has_points{shapes.counted(), 1}, live) : Ids();
  const std::size_t number_kept = is_sparse ? live : first_new, size = number_kept + started.size();
  Buffer_of<Backend, Shape> shape;
  Buffer_of<Backend, Plane> plane;
  const bool moves = is_sparse || size > shapes.table().size();
  if(moves) {
    shape.reset(size + size / 2);
    plane.reset(size + size / 2);
    shapes.is_restarted.reset(size + size / 2);
  }
  Shape* const table = shapes.change_moments(); // also where they move
  Ids new_id(ids);
  Take_growth take = {};
  take.old_shape = shapes.table().data();
  take.old_plane = shapes.plane.data();
  take.shape = moves ? shape.data() : table;
  take.plane = moves ? plane.data() : shapes.plane.data();
  take.is_restarted = shapes.is_restarted.data();
  take.delta = delta;
  take.kept = is_sparse ? kept.data() : nullptr;
  take.started = started.data();
  take.number_kept = std::uint32_t(number_kept);
  take.first_new = std::uint32_t(first_new);
  take.new_id = new_id.data();
  backend.for_each(size, take, shapes_per_thread);
  if(moves) {
    shapes.table() = std::move(shape);
    shapes.plane = std::move(plane);
  }
  shapes.size = size;
  const Labels_view labels = points.change_labels(false);
  if(is_sparse || started.size() > 0)
    backend.for_each(points.cloud.number_of_surfels(), Replace_ids{new_id.data(), labels.label});
  points.refresh_labels();
  return {std::size_t(sums[0]), points.ranks.total(std::size_t(sums[1]))};
}

// Runs one pass of growth, from proposals to the table of shapes.
template <class Backend>
Growth_counts grow_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Seeds<Backend>& seeds,
                          const Stage_parameters& options)
{
  const std::size_t ids = grow_cells(points, shapes, seeds, options.growth);
  auto untried_cells = filled_buffer(points.backend, 1, std::uint32_t(0));
  count_untried_cells(points, seeds, options.minimum_region_size, untried_cells.data());
  return take_growth(points, shapes, ids, untried_cells.data());
}

// The fits of shapes that started in the last pass, as their planes.
struct Started_shapes : Changed_shapes {
  Plane* plane;

  CGAL_TANDEM_HD bool has(std::size_t id) const { return shape[id].age == 1 && Changed_shapes::has(id); }
  CGAL_TANDEM_HD void set_made(std::size_t id) const
  {
    Changed_shapes::set_made(id);
    plane[id] = rounded(shape[id].local);
    shape[id].history.restarted = shape[id].local;
  }
};

// Gives shapes that started in the last pass their local planes, between two passes of a round. So they can go on
// before they have relations.
template <class Backend>
void take_local_planes(const Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes)
{
  make_fits(points.backend, points.ranks, shapes.size, Started_shapes{{shapes.counted()}, shapes.plane.data()});
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_SHAPES_H
