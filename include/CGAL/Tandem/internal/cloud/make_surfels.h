// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfels: the points of one cell of a grid whose normals point to one face of it, as one point at their centroid with
// their mean normal. So what is near is known by lengths, whatever the number of points there, and copies of points are
// one. See the manual, "Surfels".

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_MAKE_SURFELS_H
#define CGAL_TANDEM_INTERNAL_CLOUD_MAKE_SURFELS_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>

#include <utility>

namespace CGAL::Tandem::internal {

// The points at which a surfel begins: where the code of the sort is another one than before.
template <class Table>
struct Begins_surfel {
  Table sorted;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return i == 0 || sorted.key(i - 1) != sorted.key(i); }
};

// The quotient of a sum and a positive number, rounded to the nearest integer, halves up. Unlike that of the language
// it moves with the points.
CGAL_TANDEM_HD inline std::int32_t rounded_mean(std::int64_t sum, std::int64_t n)
{
  const std::int64_t twice = 2 * sum + n, quotient = twice / (2 * n);
  return std::int32_t(quotient - (twice % (2 * n) < 0));
}

// Of item i: the place of its surfel, its centroid and its mean normal. Sums of integers, so that the order of the
// points does not matter.
struct Make_surfel {
  const Grid_point* all;
  const std::uint32_t* first;     // by surfel, and the end
  const std::uint8_t* all_levels; // of tolerances; null: all points have that of the detection
  std::uint32_t* surfel;          // by point
  Grid_point* point;              // by surfel
  std::uint8_t* level;            // by surfel: of its smallest tolerance

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t size = first[i + 1] - first[i];
    std::int64_t sum[3] = {0, 0, 0}, normal[3] = {0, 0, 0};
    std::uint8_t smallest = 0;
    for(std::uint32_t p = first[i]; p < first[i + 1]; ++p) {
      const Int_vector n = decode_normal(all[p].normal);
      sum[0] += all[p].x;
      sum[1] += all[p].y;
      sum[2] += all[p].z;
      normal[0] += n.x;
      normal[1] += n.y;
      normal[2] += n.z;
      surfel[p] = std::uint32_t(i);
      if(all_levels != nullptr && all_levels[p] > smallest)
        smallest = all_levels[p];
    }
    if(all_levels != nullptr)
      level[i] = smallest;
    point[i] = all[first[i]];
    if(size == 1)
      return;
    point[i].x = rounded_mean(sum[0], size);
    point[i].y = rounded_mean(sum[1], size);
    point[i].z = rounded_mean(sum[2], size);
    if(point[i].normal != no_normal)
      point[i].normal = encode_normal(unit({double(normal[0]), double(normal[1]), double(normal[2])}));
  }
};

// From cells as ranges of points to ranges of surfels. Cells have whole surfels.
struct Place_cell {
  const std::uint32_t* surfel; // by point
  Range* cell;

  CGAL_TANDEM_HD void operator()(std::size_t c) const
  {
    cell[c] = {surfel[cell[c].first], surfel[cell[c].last - 1] + 1};
  }
};

// Points, with their places in the import and the levels of their tolerances, which may be null.
template <class Point, class Index, class Level>
struct Point_tables {
  Point* point;
  Index* order;
  Level* level;
};

using Source_tables = Point_tables<const Grid_point, const std::uint32_t, const std::uint8_t>;
using Target_tables = Point_tables<Grid_point, std::uint32_t, std::uint8_t>;

// Moves the points to their places in the curve, or from one order to the next.
template <class Table>
struct Gather_points {
  Table sorted;
  Source_tables from; // without an order: that of the import
  Target_tables to;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t at = sorted.index(i);
    to.order[i] = from.order != nullptr ? from.order[at] : at;
    to.point[i] = from.point[at];
    if(from.level != nullptr)
      to.level[i] = from.level[at];
  }
};

// Makes the surfels of points with equal keys, from the points in the order of the sort. cells: ranges of points, which
// become those of surfels.
template <class Backend>
void make_surfels(Backend& backend, const typename Backend::Sort_table& sorted, Sorted_cloud<Backend>& cloud,
                  Buffer_of<Backend, Range>& cells)
{
  using Table = typename Backend::Sort_table::View;
  const std::size_t n = cloud.all_points.size();
  auto first = backend.compact(n, Begins_surfel<Table>{sorted.view()});
  const std::size_t size = first.size();
  cloud.first_point = extended<std::uint32_t>(backend, first, size + 1);
  first.release();
  backend.for_each(1, Fill<std::uint32_t>{cloud.first_point.data() + size, std::uint32_t(n)});
  cloud.surfel.reset(n);
  cloud.point.reset(size);
  cloud.level.reset(cloud.has_levels ? size : 0);
  backend.for_each(size, Make_surfel{cloud.all_points.data(), cloud.first_point.data(), cloud.all_levels(),
                                     cloud.surfel.data(), cloud.point.data(), cloud.level.data()});
  backend.for_each(cells.size(), Place_cell{cloud.surfel.data(), cells.data()});
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_MAKE_SURFELS_H
