// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where shapes start: the most planar surfels of a cell first, then those nearest to its center (section 3 of the
// paper). Computed once, before the first round.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SEEDS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SEEDS_H

#include <CGAL/Tandem/internal/base/tuning/growth.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>

namespace CGAL::Tandem::internal {

// The plane through a surfel with its own normal. The surfel must have one.
CGAL_TANDEM_HD inline Plane own_plane(const Grid_point& p)
{
  const Int_vector m = decode_normal(p.normal);
  return make_plane(unit({double(m.x), double(m.y), double(m.z)}), {double(p.x), double(p.y), double(p.z)});
}

struct Planarity {
  int all = 0;     // neighbors
  int fitting = 0; // ... that fit the plane of the surfel itself, within its tolerance
};

// How planar the surface is at surfel i. All numbers are in [0, k]. A surfel without a normal has none of either.
CGAL_TANDEM_HD inline Planarity planarity(const Cloud_view& cloud, std::uint32_t i, const Tolerance& tolerance)
{
  Planarity p;
  if(cloud.point[i].normal == no_normal)
    return p;
  const Plane plane = own_plane(cloud.point[i]);
  const std::int64_t near = cloud.tolerance_of(i, tolerance).distance;
  const std::uint32_t* row = cloud.row(i);
  for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
    ++p.all;
    const std::int64_t e = signed_distance(plane, cloud.point[row[j]]);
    const Squared_cosine cosine = squared_cosine(plane, cloud.point[row[j]]);
    // as fits(); no branches, since half of them would be mispredicted
    p.fitting += int((e < 0 ? -e : e) <= near) & int(cosine.is_at_least(tolerance.squared_cosine));
  }
  return p;
}

// The candidates of a cell are seed[cell.first] ... seed[cell.first + count[c] - 1]; those before cursor[c] are used
// up. Candidates stay in their order; growth only moves the cursors. `count` and `cursor` are by cell.
struct Seeds_view {
  const std::uint32_t* seed;
  const std::uint32_t* count;
  std::uint32_t* cursor;
};

template <class Backend>
struct Seeds {
  Buffer_of<Backend, std::uint32_t> seed;
  Buffer_of<Backend, std::uint32_t> count;
  Buffer_of<Backend, std::uint32_t> cursor;

  Seeds_view view() { return {seed.data(), count.data(), cursor.data()}; }
};

// The key of a surfel that is no seed. It is above all keys of seeds, so these surfels are sorted to the end of their
// cell.
constexpr std::uint64_t not_a_seed = ~std::uint64_t(0);

// The box of the surfels of a cell. Its middle is the center by which seeds are ordered.
struct Box_scratch {
  Box box;
};

// Writes the key of each surfel, by position. The keys of a cell rise with falling planarity, then with the distance to
// the center, then with the position. So they are unique, and every way of sorting gives the same order.
struct Rate_seeds {
  Cloud_view cloud;
  const Range* cells;
  std::uint64_t* key;
  Tolerance tolerance;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Box_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    block.single([&] { scratch.box = Box(); });
    block.template accumulate<Box>(
      cell.size(), [&](std::uint32_t at, Box& box) { box.add(cloud.point[cell.first + at]); },
      [&](const Box& box) { block.add_box(scratch.box, box); });
    const Box box = scratch.box;
    block.for_each(cell.size(), [&](std::uint32_t at) { key[cell.first + at] = rate(cell.first + at, at, box); });
  }

private:
  // The key of a surfel. From the highest bit: 7 bits for the planarity, as k <= 64; 34 for the squared distance in units
  // of 2^16; 16 for the place in the cell.
  CGAL_TANDEM_HD std::uint64_t rate(std::uint32_t i, std::uint32_t at, const Box& box) const
  {
    const Planarity score = planarity(cloud, i, tolerance);
    constexpr tuning::Ratio ratio = tuning::growth::seed_ratio;
    if(score.all == 0 || !ratio.is_reached(score.fitting, score.all))
      return not_a_seed;
    const Grid_point& p = cloud.point[i];
    const std::int64_t x = p.x - (std::int64_t(box.low[0]) + box.high[0]) / 2;
    const std::int64_t y = p.y - (std::int64_t(box.low[1]) + box.high[1]) / 2;
    const std::int64_t z = p.z - (std::int64_t(box.low[2]) + box.high[2]) / 2;
    const std::uint64_t distance = std::uint64_t(x * x + y * y + z * z) >> 16; // < 2^34
    return std::uint64_t(cloud.k - score.fitting) << 50 | distance << 16 | at;
  }
};

// Turns the sorted keys of a cell into positions, and counts its seeds.
struct Take_seeds {
  const Range* cells;
  const std::uint64_t* key; // sorted
  std::uint32_t* seed;
  std::uint32_t* count;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Box_scratch&, std::uint32_t c) const
  {
    const Range cell = cells[c];
    const std::uint64_t* keys = key + cell.first;
    const std::uint32_t seeds =
      block.find_first(0, cell.size(), [&](std::uint32_t at) { return keys[at] == not_a_seed; });
    block.single([&] { count[c] = seeds; });
    block.for_each(seeds,
                   [&](std::uint32_t at) { seed[cell.first + at] = cell.first + std::uint32_t(keys[at] & 0xffffu); });
  }
};

// The seeds of all cells. The keys take 8 bytes a surfel meanwhile. cell_size: most surfels of a cell.
template <class Backend>
Seeds<Backend> order_seeds(Labeled_cloud<Backend>& points, const Tolerance& tolerance, std::size_t cell_size)
{
  Backend& backend = points.backend;
  const std::size_t n = points.cloud.number_of_surfels(), cells = points.number_of_cells();
  Buffer_of<Backend, std::uint64_t> key(n);
  Seeds<Backend> seeds;
  seeds.seed.reset(n);
  seeds.count.reset(cells);
  seeds.cursor = filled_buffer(backend, cells, std::uint32_t(0));
  backend.template for_each_cell<Box_scratch>(
    cells, Rate_seeds{points.cloud.view(), points.cells.data(), key.data(), tolerance});
  backend.sort_ranges(key.data(), points.cells.data(), cells, n, cell_size);
  backend.template for_each_cell<Box_scratch>(
    cells, Take_seeds{points.cells.data(), key.data(), seeds.seed.data(), seeds.count.data()});
  return seeds;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SEEDS_H
