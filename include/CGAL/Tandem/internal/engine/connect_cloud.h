// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sorted cloud, and the neighbor graph on which shapes grow, and by which a result is checked: of surfels, across scan
// lines, on both sides of thin walls apart. Fills the rows of the cloud, with ghosts, and joins surfels. See the manual,
// "Surfels", "Scan Lines" and "Wall Sides".

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_CONNECT_CLOUD_H
#define CGAL_TANDEM_INTERNAL_ENGINE_CONNECT_CLOUD_H

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/cloud/cells.h>
#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/cloud/make_surfels.h>
#include <CGAL/Tandem/internal/neighbors/cross_scan_lines.h>
#include <CGAL/Tandem/internal/neighbors/cut_wall_sides.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>
#include <CGAL/Tandem/internal/neighbors/join_surfels.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>

#include <vector>

namespace CGAL::Tandem::internal {

// --- The points on the grid, in the order of the curve, and the octree cells. Fills the points, the order and the cells,
// nothing else. See the manual, "Grid and Units".

// The caller's points on the grid, in their order. A device may do it where it has the values already.
template <class Backend>
Buffer_of<Backend, Grid_point> import_points(Backend& backend, Import& in)
{
  if constexpr(Stage_overrides<Backend>::imports_points)
    return Stage_overrides<Backend>::import_points(backend, in);
  else {
    Buffer_of<Backend, Grid_point> point(in.size());
    backend.for_each(in.size(), place_on_grid(in, point.data()));
    return point;
  }
}

// The levels of the tolerances of the caller's points, in their order; none without tolerances.
template <class Backend>
Buffer_of<Backend, std::uint8_t> import_levels(Backend& backend, const Import& in)
{
  std::vector<std::uint8_t> level(in.tolerances.size());
  backend.for_each_on_host(level.size(), [&](std::size_t i) { level[i] = level_of(in.tolerances[i], in.epsilon); });
  return to_buffer(backend, level);
}

// Ties of the curve are surfels. Without surfels they are broken by the given values, which only ties need on the host.
// So the order of the caller's range has no influence on shapes.
template <class Backend>
void sort_points(Backend& backend, Import& in, std::size_t cell_size, Sorted_cloud<Backend>& cloud,
                 Buffer_of<Backend, Range>& cells)
{
  const std::size_t n = in.size();
  const auto imported = import_points(backend, in);
  const auto imported_level = import_levels(backend, in);
  const std::uint8_t* const level_of_imported = in.has_tolerances ? imported_level.data() : nullptr;
  const Code_frame frame = make_code_frame(in.low, in.high, in.surfel_cells);
  const auto sorted = sort_along_curve(
    backend, {imported.data(), n, level_of_imported}, frame,
    make_tie_order([&](std::uint32_t i, std::uint32_t j) { return in.precedes(i, j); }, [&] { in.drop_upload(); }));
  const std::vector<Range> ranges = split_cells(backend, sorted, frame, cell_size);
  cells = to_buffer(backend, ranges);
  cloud.order.reset(n);
  auto& point = frame.has_surfels() ? cloud.all_points : cloud.point;
  point.reset(n);
  cloud.has_levels = in.has_tolerances;
  auto& level = frame.has_surfels() ? cloud.level_of_point : cloud.level;
  level.reset(in.has_tolerances ? n : 0);
  using Table = typename Backend::Sort_table::View;
  backend.for_each(n, Gather_points<Table>{sorted.view(),
                                           {imported.data(), nullptr, level_of_imported},
                                           {point.data(), cloud.order.data(), level.data()}});
  if(frame.has_surfels())
    make_surfels(backend, sorted, cloud, cells);
  if constexpr(Stage_overrides<Backend>::expects_cells)
    Stage_overrides<Backend>::expect_cells(backend, cells);
}

// --- The neighbor graph.

// The points have been sorted, and cloud.k is set. The values that a device has are dropped.
template <class Backend>
void connect_cloud(Labeled_cloud<Backend>& points, Import& in, double maximum_distance_steps)
{
  Backend& backend = points.backend;
  const int rings = in.has_normals ? 1 : 3; // normals are estimated from neighbors of neighbors
  find_rows(backend, points.ranks, points.cloud, rings,
            [&] { in.drop_upload(); }); // the values come back while a device searches
  if(join_surfels(backend, points.ranks, points.cloud, points.cells, in.surfel_cells))
    find_rows(backend, points.ranks, points.cloud, rings);
  cross_scan_lines(backend, points.ranks, points.cloud, points.cells,
                   make_code_frame(in.low, in.high, in.surfel_cells));
  if(in.has_normals)
    cut_wall_sides(backend, points.ranks, points.cloud, maximum_distance_steps);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_CONNECT_CLOUD_H
