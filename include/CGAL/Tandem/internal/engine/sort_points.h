// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points on the grid, in the order of the curve, and the octree cells. Fills the points, the order and the cells,
// nothing else. See the manual, "Grid and Units".

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_SORT_POINTS_H
#define CGAL_TANDEM_INTERNAL_ENGINE_SORT_POINTS_H

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/cloud/cells.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The caller's points on the grid, in their order. A device may do it where it has the values already.
template <class Backend>
typename Backend::template Buffer<Grid_point> import_points(Backend& backend, Import& in)
{
  if constexpr(Stage_overrides<Backend>::imports_points)
    return Stage_overrides<Backend>::import_points(backend, in);
  else {
    typename Backend::template Buffer<Grid_point> point(in.size());
    backend.for_each(in.size(), place_on_grid(in, point.data()));
    return point;
  }
}

// Moves the points to their places in the curve.
template <class Table>
struct Gather_sorted {
  Table sorted;             // by position: the code, and the imported point
  const Grid_point* source; // by imported point
  std::uint32_t* order;     // by position, as is the next one
  Grid_point* point;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    order[i] = sorted.index(i);
    point[i] = source[order[i]];
  }
};

// Ties of the curve are broken by the given values. So the order of the caller's range has no influence on shapes. Only
// ties need the values on the host.
template <class Backend>
void sort_points(Backend& backend, Import& in, std::size_t cell_size, Sorted_cloud<Backend>& cloud,
                 typename Backend::template Buffer<Range>& cells)
{
  const std::size_t n = in.size();
  const auto imported = import_points(backend, in);
  const Code_frame frame = make_code_frame(in.low, in.high);
  const auto sorted = sort_along_curve(
    backend, imported.data(), n, frame,
    make_tie_order([&](std::uint32_t i, std::uint32_t j) { return in.precedes(i, j); }, [&] { in.drop_upload(); }));
  const std::vector<Range> ranges = split_cells(backend, sorted, frame, cell_size);
  cells = to_buffer(backend, ranges);
  if constexpr(Stage_overrides<Backend>::expects_cells)
    Stage_overrides<Backend>::expect_cells(backend, cells);
  cloud.order.reset(n);
  cloud.point.reset(n);
  using Table = typename Backend::Sort_table::View;
  backend.for_each(n, Gather_sorted<Table>{sorted.view(), imported.data(), cloud.order.data(), cloud.point.data()});
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_SORT_POINTS_H
