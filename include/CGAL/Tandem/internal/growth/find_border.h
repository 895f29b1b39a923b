// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points at which shapes grow from one cell into the next. Computed once, as the neighbors and the cells stay.
// Fills the Border of the cloud, nothing else.

#ifndef CGAL_TANDEM_INTERNAL_GROWTH_FIND_BORDER_H
#define CGAL_TANDEM_INTERNAL_GROWTH_FIND_BORDER_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Whether the points of a cell have a neighbor in another one. Only its own row counts, since proposals are
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
        has_other |= row[j] < cell.first || row[j] >= cell.last;
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

// Finds the border points of all cells. The marks take one byte a point meanwhile, the result 8 bytes a border point.
template <class Backend>
void find_border(Labeled_cloud<Backend>& points)
{
  Backend& backend = points.backend;
  Border<Backend>& border = points.border;
  const std::size_t cells = points.number_of_cells();
  typename Backend::template Buffer<std::uint8_t> mark(points.cloud.size());
  backend.template for_each_cell<No_scratch>(cells, Mark_border{points.cloud.view(), points.cells.data(), mark.data()});
  border.point = backend.compact(points.cloud.size(), Is_marked{mark.data()});
  border.range.reset(cells);
  backend.for_each(cells, Find_cell_borders{points.cells.data(), border.point.data(),
                                            std::uint32_t(border.point.size()), border.range.data()});
  border.proposal.reset(border.point.size());
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_GROWTH_FIND_BORDER_H
