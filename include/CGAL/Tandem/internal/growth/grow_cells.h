// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One pass of growth over all cells. Changes labels, states, seed cursors, proposals and the sums of the shapes. The
// table of shapes follows in grow_shapes.h. Also: which cells still have many untried seeds.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELLS_H
#define CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELLS_H

#include <CGAL/Tandem/internal/shapes/Seeds.h>
#include <CGAL/Tandem/internal/growth/grow_cell.h>
#include <CGAL/Tandem/internal/shapes/require.h>

#include <algorithm>

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
  Growth_options options;
  Cell_tables tables;
  std::uint32_t first_new; // the ids from here on are those of new shapes, so many for each cell as may start there

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch& scratch, std::uint32_t c) const
  {
    const Range border = tables.border.range[c];
    const Cell_job job = {
      tables.cells[c],
      tables.border.point + border.first,
      tables.border.proposal + border.first,
      border.size(),
      tables.seeds.seed + tables.cells[c].first,
      tables.seeds.count[c],
      tables.seeds.cursor + c,
      first_new + c * std::uint32_t(options.seeds_in_flight),
      tables.cells.may_have(block, c, [&](std::uint32_t s) { return shapes.is_restarted[s] != 0; })};
    Cell_growth<Backend, Block, Scratch>(block, scratch, {job, cloud, shapes, labels, options}).run();
  }
};

// Copies what growth reads of the shapes, as there has to be room for new ones.
struct Copy_for_growth {
  const Plane* plane;
  const std::uint16_t* steps;
  const std::uint8_t* is_restarted;
  std::size_t shapes;
  Shapes_view copy;
  std::uint8_t* is_restarted_copy;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    if(id < shapes) {
      copy.plane[id] = plane[id];
      copy.steps[id] = steps[id];
    }
    is_restarted_copy[id] = id < shapes ? is_restarted[id] : 0;
  }
};

// Runs one pass of growth over all cells. Returns the end of the ids: each cell has some of its own for shapes that may
// start, so that cells need no common counter, and new ids follow from the order of cells and seeds.
template <class Backend>
std::size_t grow_cells(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Seeds<Backend>& seeds,
                       const Growth_options& options)
{
  Backend& backend = points.backend;
  require(points, shapes, tables::moments | tables::lists); // the pass adds to the moments
  Border<Backend>& border = points.border;
  const std::size_t cells = points.number_of_cells();
  const std::size_t ids = shapes.size + cells * std::size_t(options.seeds_in_flight);
  const Cloud_view cloud = points.cloud.view();
  typename Backend::template Buffer<Plane> plane(ids);
  typename Backend::template Buffer<std::uint16_t> steps(ids);
  typename Backend::template Buffer<std::uint8_t> is_restarted(ids);
  const Shapes_view view = {plane.data(), steps.data(), is_restarted.data(), start_deltas(backend, shapes, ids)};
  backend.for_each(ids, Copy_for_growth{shapes.plane.data(), shapes.steps.data(), shapes.is_restarted.data(),
                                        shapes.size, view, is_restarted.data()});
  backend.for_each(border.point.size(), Propose{cloud, points.label(), plane.data(), border.point.data(),
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

// Whether a cell has many untried seeds: of as many points as the smallest shape has, or of more than a share of its points.
// Then faces may still be missing there; a few seeds in clutter are not worth a pass. See the manual, "Growth".
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
    const std::uint32_t share = points / tuning::loop::points_per_untried_point + 1;
    block.single([&] { untried = 0; });
    block.for_each(seeds.count[c] - seeds.cursor[c], [&](std::uint32_t at) {
      if(is_untried(label, state, seeds.seed[first + at]))
        block.add(untried, surfels.points(seeds.seed[first + at]).size());
    });
    block.single([&] {
      if(untried >= (share < smallest_shape ? share : smallest_shape))
        Backend::atomic_add(*found, 1u);
    });
  }
};

// Counts the cells that have many untried seeds, with one test for each seed from the cursors on. Changes nothing.
template <class Backend>
std::size_t count_untried_cells(Labeled_cloud<Backend>& points, Seeds<Backend>& seeds, std::int64_t minimum_region_size)
{
  auto found = filled_buffer(points.backend, 1, std::uint32_t(0));
  const std::uint32_t smallest =
    std::uint32_t((std::min)({minimum_region_size, std::int64_t(points.total_points()), std::int64_t(first_mark)}));
  points.backend.template for_each_cell<std::uint32_t>(
    points.number_of_cells(), Find_untried_cells<Backend>{points.cloud.surfels(), points.label(), points.state(),
                                                          points.cells.data(), seeds.view(), smallest, found.data()});
  return points.ranks.total(to_vector(points.backend, found).front());
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_GROW_CELLS_H
