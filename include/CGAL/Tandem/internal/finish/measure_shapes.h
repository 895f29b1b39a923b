// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statistics of the final shapes: the mean distance of points, and how many normals are opposite to their planes.
// Computed on the grid by integer sums, so they are the same for every order of the points. Changes nothing else.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H

#include <CGAL/Tandem/internal/base/types.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Distances are summed in units of epsilon / 2^15. A point adds at most 2^15, and a cell has at most 2^16 points, so a
// cell's sum fits 32 bits.
constexpr std::uint32_t distance_units = 1u << 15;

// The sums of one cell, before they are added to those of all cells.
struct Measure_scratch {
  Count_scratch opposed;
  std::uint32_t distance;
};

// For each cell, measures its points that belong to a shape of the result. opposed[s] counts the normals of shape s
// that are opposite to its plane.
template <class Backend>
struct Measure_points {
  const Grid_point* point;
  const Range* cells;
  const std::uint32_t* label;
  const Plane* plane;             // by label
  const std::uint32_t* component; // of each point
  const std::uint32_t* number;    // of the shape, by component; no_index if there is none
  std::int64_t epsilon;           // in 2^-28 grid steps, as signed distances
  std::uint64_t* opposed;         // by shape
  std::uint64_t* distance;        // one sum for all points

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Measure_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    scratch.opposed.clear(block);
    block.single([&] { scratch.distance = 0; });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at, shape = number[component[i]];
      if(shape == no_index)
        return;
      block.add(scratch.distance, distance_of(i));
      if(is_opposed(i))
        scratch.opposed.template add<Backend>(block, shape, opposed);
    });
    scratch.opposed.template flush<Backend>(block, opposed);
    block.single([&] { Backend::atomic_add(*distance, std::uint64_t(scratch.distance)); });
  }

private:
  // Rounded to the nearest unit. A point that only the exact check accepted may be a little farther than epsilon on the
  // grid, and counts as epsilon.
  CGAL_TANDEM_HD std::uint32_t distance_of(std::uint32_t i) const
  {
    const std::int64_t e = signed_distance(plane[label[i]], point[i]);
    const std::uint64_t size = std::uint64_t(e < 0 ? -e : e) * distance_units; // < 2^39 times 2^15
    const std::uint64_t units = (size + std::uint64_t(epsilon) / 2) / std::uint64_t(epsilon);
    return units < distance_units ? std::uint32_t(units) : distance_units;
  }

  CGAL_TANDEM_HD bool is_opposed(std::uint32_t i) const
  {
    return normal_product(plane[label[i]], decode_normal(point[i].normal)) < 0;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H
