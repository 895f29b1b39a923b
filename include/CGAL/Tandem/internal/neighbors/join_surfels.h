// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a dense cluster may still be several surfels, cut by the cells. Such surfels join the heaviest of them, so
// that a cluster is one neighbor and not many. See the manual, "Surfels".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_JOIN_SURFELS_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_JOIN_SURFELS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/make_surfels.h>
#include <CGAL/Tandem/internal/cloud/sort_along_curve.h>

namespace CGAL::Tandem::internal {

// Which surfel i would join: the heaviest of its cell among itself and its neighbors of the same face from whose center
// the points of both are less than the width of a cell. Ties go to the first one.
struct Surfel_targets {
  Cloud_view cloud;
  Surfel_cells cells;

  CGAL_TANDEM_HD std::uint32_t target(std::uint32_t i, const Range& cell) const
  {
    std::uint32_t best = i;
    const std::uint32_t* row = cloud.row(i);
    // Where all points are so near, their rounded centroid is as well, and rows ascend.
    const std::int64_t width = width_steps_of(i);
    for(int j = 0; j < cloud.k && row[j] != no_index && is_near(cloud.point[row[j]], cloud.point[i], width + 2); ++j)
      if(row[j] >= cell.first && row[j] < cell.last && is_heavier(row[j], best) && width_steps_of(row[j]) == width &&
         face_of(cloud.point[row[j]].normal) == face_of(cloud.point[i].normal) && covers(row[j], i, width) &&
         covers(row[j], row[j], width))
        best = row[j];
    return best;
  }

private:
  CGAL_TANDEM_HD bool is_heavier(std::uint32_t a, std::uint32_t b) const
  {
    const std::uint32_t wa = cloud.surfels.points(a).size(), wb = cloud.surfels.points(b).size();
    return wa != wb ? wa > wb : a < b;
  }

  // The width of the cell of a surfel, in steps, rounded down.
  CGAL_TANDEM_HD std::int64_t width_steps_of(std::uint32_t i) const
  {
    const int octave = octave_of(cloud.level_of(i));
    return std::int64_t(cells.width_steps) >> (octave < cells.octaves ? octave : cells.octaves);
  }

  // Whether two points are less than a distance apart.
  CGAL_TANDEM_HD static bool is_near(const Grid_point& p, const Grid_point& q, std::int64_t distance)
  {
    const std::int64_t x = std::int64_t(q.x) - p.x, y = std::int64_t(q.y) - p.y, z = std::int64_t(q.z) - p.z;
    return x * x + y * y + z * z < distance * distance;
  }

  CGAL_TANDEM_HD bool covers(std::uint32_t center, std::uint32_t i, std::int64_t width) const
  {
    const Range points = cloud.surfels.points(i);
    for(std::uint32_t p = points.first; p < points.last; ++p)
      if(!is_near(cloud.point[center], cloud.surfels.point[p], width))
        return false;
    return true;
  }
};

struct Choose_target {
  Surfel_targets targets;
  const Range* cells;
  std::uint32_t* target;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, No_scratch&, std::uint32_t c) const
  {
    const Range cell = cells[c];
    block.for_each(cell.size(),
                   [&](std::uint32_t at) { target[cell.first + at] = targets.target(cell.first + at, cell); });
  }
};

// A surfel whose target itself joins another one stays.
struct Stays_surfel {
  const std::uint32_t* target;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return target[i] == i || target[target[i]] != target[i]; }
};

template <class View>
struct Write_joined {
  const std::uint32_t* surfel;
  const std::uint32_t* target;
  View table;

  CGAL_TANDEM_HD void operator()(std::size_t p) const
  {
    const std::uint32_t i = surfel[p];
    table.set(p, Stays_surfel{target}(i) ? i : target[i], std::uint32_t(p));
  }
};

// From ranges of surfels to ranges of points.
struct Points_of_cell {
  Surfels_view surfels;
  Range* cell;

  CGAL_TANDEM_HD void operator()(std::size_t c) const
  {
    cell[c] = {surfels.points(cell[c].first).first, surfels.points(cell[c].last - 1).last};
  }
};

// Joins them where that is worth a second search of neighbors; returns whether it has. The rows are those of before.
template <class Backend>
bool join_surfels(Backend& backend, const Ranks<Backend>& ranks, Sorted_cloud<Backend>& cloud,
                  Buffer_of<Backend, Range>& cells, const Surfel_cells& surfel_cells)
{
  using View = typename Backend::Sort_table::View;
  if(!cloud.has_surfels()) // the same on all ranks
    return false;
  Buffer_of<Backend, std::uint32_t> target(cloud.number_of_surfels());
  backend.template for_each_cell<No_scratch>(cells.size(),
                                             Choose_target{{cloud.view(), surfel_cells}, cells.data(), target.data()});
  const std::size_t staying =
    ranks.total(backend.compact(cloud.number_of_surfels(), Stays_surfel{target.data()}).size());
  const std::size_t all = ranks.total(cloud.number_of_surfels());
  if(!tuning::surfels::joined.is_exceeded(std::int64_t(all - staying), std::int64_t(all)))
    return false;
  const std::size_t n = cloud.number_of_points();
  typename Backend::Sort_table table(n);
  backend.for_each(n, Write_joined<View>{cloud.surfel.data(), target.data(), table.view()});
  backend.sort(table);
  backend.for_each(cells.size(), Points_of_cell{cloud.surfels(), cells.data()});
  Buffer_of<Backend, std::uint32_t> order(n);
  Buffer_of<Backend, Grid_point> point(n);
  Buffer_of<Backend, std::uint8_t> level(cloud.level_of_point.size());
  backend.for_each(n, Gather_points<View>{table.view(),
                                          {cloud.all_points.data(), cloud.order.data(), cloud.all_levels()},
                                          {point.data(), order.data(), level.data()}});
  cloud.order = std::move(order);
  cloud.level_of_point = std::move(level);
  cloud.all_points = std::move(point);
  cloud.ghosts = 0;
  make_surfels(backend, table, cloud, cells);
  return true;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_JOIN_SURFELS_H
