// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pass of growth over all cells. Changes labels, states, seed cursors, proposals and the sums of the shapes. The
// table of shapes follows in grow_shapes.h. Also: which cells still have many untried seeds.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELLS_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELLS_H

#include <CGAL/Tandem/internal/shapes/Seeds.h>
#include <CGAL/Tandem/internal/growth/grow_cell.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/shape_deltas.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The proposal for a free border point: the nearest shape among those of its neighbors that it fits, of equally near
// ones the smallest id. Labels and planes do not change meanwhile, so the points may come in any order.
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

// What the cells have from pass to pass. border_of, seed_count and seed_cursor are by cell, seed is by position.
struct Cell_tables {
  Cells_view cells;
  const Range* border_of; // in `border`
  const std::uint32_t* border;
  const std::uint32_t* proposal;
  const std::uint32_t* seed;
  const std::uint32_t* seed_count;
  std::uint32_t* seed_cursor;
};

// The body of a pass: makes the job of a cell from the tables.
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
    Cell_growth<Backend, Block, Scratch>(block, scratch, {job, cloud, shapes, labels, options}).run();
  }
};

// By cell: the first id for shapes that start there, and at last the end of all ids. Each cell has ids for as many as
// may start: not more than it has seeds left. So new ids follow from the order of cells and seeds, and cells need no
// common counter.
template <class Backend>
std::vector<std::uint32_t> new_ids(const Seeds<Backend>& seeds, std::size_t shapes, int seeds_in_flight)
{
  std::vector<std::uint32_t> first(seeds.count.size() + 1);
  first[0] = std::uint32_t(shapes);
  for(std::size_t c = 0; c < seeds.count.size(); ++c)
    first[c + 1] = first[c] + (std::min)(std::uint32_t(seeds_in_flight), seeds.count[c] - seeds.cursor[c]);
  return first;
}

// One pass. first_id: of new_ids(). The tables of planes and steps are copied, as they need room for all these ids.
template <class Backend>
void grow_cells(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Seeds<Backend>& seeds,
                const Growth_options& options, const std::vector<std::uint32_t>& first_id)
{
  Backend& backend = points.backend;
  Border<Backend>& border = points.border;
  const std::size_t ids = first_id.back(), cells = points.number_of_cells();
  const Cloud_view cloud = points.cloud.view();
  typename Backend::template Buffer<Plane> plane(ids);
  typename Backend::template Buffer<std::uint16_t> steps(ids);
  backend.from_host(shapes.plane.data(), shapes.plane.size(), plane.data());
  backend.from_host(shapes.steps.data(), shapes.steps.size(), steps.data());
  shapes.is_restarted.resize(ids, 0);
  auto cursor = backend.read_write_access(seeds.cursor);
  const auto is_restarted = backend.read_access(shapes.is_restarted);
  const auto seed_count = backend.read_access(seeds.count);
  const auto first = backend.read_access(first_id);
  backend.for_each(border.point.size(), Propose{cloud, points.label.data(), plane.data(), border.point.data(),
                                                border.proposal.data(), options.tolerance});
  const Shapes_view view = {plane.data(), steps.data(), is_restarted.data(), start_deltas(backend, shapes, ids)};
  const Cell_tables tables = {points.cells_view(), border.range.data(), border.point.data(), border.proposal.data(),
                              seeds.seed.data(),   seed_count.data(),   cursor.data()};
  const Grow_cells<Backend> body = {cloud, view, points.labels(), options, tables, first.data()};
  // Large cells need a larger queue, which does not fit into the fast memory of a device.
  if(options.cell_size <= small_cell)
    backend.template for_each_cell<Growth_scratch<small_cell>>(cells, body);
  else
    backend.template for_each_cell<Growth_scratch<largest_cell>>(cells, body);
  cursor.copy_back();
}

// Whether a cell has many untried seeds: as many as the smallest shape has points, or more than a share of its points.
// Then faces may still be missing there; a few seeds in clutter are not worth a pass. See the manual, "Growth".
struct Find_untried_cells {
  Labels_view labels;
  Cells_view cells;
  const std::uint32_t* seed;       // by position
  const std::uint32_t* seed_count; // by cell, as are these
  const std::uint32_t* seed_cursor;
  std::uint32_t smallest_shape; // points
  std::uint8_t* is_found;       // by cell

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, std::uint32_t& untried, std::uint32_t c) const
  {
    const std::uint32_t first = cells[c].first + seed_cursor[c];
    const std::uint32_t share = cells[c].size() / tuning::loop::points_per_untried_point + 1;
    block.single([&] { untried = 0; });
    block.for_each(seed_count[c] - seed_cursor[c], [&](std::uint32_t at) {
      if(labels.is_untried(seed[first + at]))
        block.append(untried);
    });
    block.single([&] { is_found[c] = untried >= (share < smallest_shape ? share : smallest_shape); });
  }
};

// Counts these cells, with one test for each seed from the cursors on. Changes nothing.
template <class Backend>
std::size_t count_untried_cells(Labeled_cloud<Backend>& points, const Seeds<Backend>& seeds,
                                std::int64_t minimum_region_size)
{
  std::vector<std::uint8_t> is_untried(points.number_of_cells());
  const auto count = points.backend.read_access(seeds.count);
  const auto cursor = points.backend.read_access(seeds.cursor);
  auto found = points.backend.write_access(is_untried);
  const std::uint32_t smallest = std::uint32_t((std::min)(minimum_region_size, std::int64_t(points.cloud.size())));
  points.backend.template for_each_cell<std::uint32_t>(
    is_untried.size(), Find_untried_cells{points.labels(), points.cells_view(), seeds.seed.data(), count.data(),
                                          cursor.data(), smallest, found.data()});
  found.copy_back();
  return std::size_t(std::count(is_untried.begin(), is_untried.end(), 1));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELLS_H
