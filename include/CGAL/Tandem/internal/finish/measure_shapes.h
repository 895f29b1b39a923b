// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statistics of the final shapes: the mean distance of points, the terms of the score that depend on points, and how
// many normals are opposite to their planes. Computed on the grid by integer sums, so they are the same for every order
// of the points. Changes nothing else.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H

#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The sums over all points.
struct Point_measures {
  enum : std::size_t { distance, fit, links, free_links, size };
};

// The sums of one cell, before they are added to those of all cells. A point adds at most 2^15 to one of them, and a
// cell has at most 2^16 points, so they fit 32 bits.
struct Measure_scratch {
  Count_scratch opposed;
  std::uint32_t sum[Point_measures::size];
};

// For each cell, measures its points that belong to a shape of the result. opposed[s] counts the normals of shape s
// that are opposite to its plane.
template <class Backend>
struct Measure_points {
  Cloud_view cloud;
  const Range* cells;
  const std::uint32_t* label;
  const Plane* plane;         // by label
  const std::uint32_t* shape; // of each point, and of ghosts; no_index if there is none
  Score_item item;            // of all points
  std::uint64_t* opposed;     // by shape
  std::uint64_t* sum;         // Point_measures

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Measure_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    scratch.opposed.clear(block);
    block.for_each(Point_measures::size, [&](std::uint32_t m) { scratch.sum[m] = 0; });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      count_links(block, scratch, i);
      if(shape[i] == no_index)
        return;
      const std::uint64_t share = item.share_of(signed_distance(plane[label[i]], cloud.point[i]));
      block.add(scratch.sum[Point_measures::distance], std::uint32_t(share));
      block.add(scratch.sum[Point_measures::fit], std::uint32_t(Score::weight_at(item, share)));
      if(is_opposed(i))
        scratch.opposed.template add<Backend>(block, shape[i], opposed);
    });
    scratch.opposed.template flush<Backend>(block, opposed);
    block.for_each(Point_measures::size,
                   [&](std::uint32_t m) { Backend::atomic_add(sum[m], std::uint64_t(scratch.sum[m])); });
  }

private:
  template <class Block>
  CGAL_TANDEM_HD void count_links(Block& block, Measure_scratch& scratch, std::uint32_t i) const
  {
    std::uint32_t links = 0, free_links = 0;
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      if(shape[row[j]] == shape[i])
        continue;
      if(shape[i] == no_index || shape[row[j]] == no_index)
        ++free_links;
      else
        ++links;
    }
    if(links > 0)
      block.add(scratch.sum[Point_measures::links], links);
    if(free_links > 0)
      block.add(scratch.sum[Point_measures::free_links], free_links);
  }

  CGAL_TANDEM_HD bool is_opposed(std::uint32_t i) const
  {
    return normal_product(plane[label[i]], decode_normal(cloud.point[i].normal)) < 0;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H
