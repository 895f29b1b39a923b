// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where shapes begin: the most planar points of a leaf first, then those nearest
// to its center (section 3 of the paper). Of equally planar points, those that are
// so within tighter bounds come first: they lie away from edges and steps, where
// normals lean and a plane would bridge two surfaces.

#ifndef CGAL_TANDEM_INTERNAL_SEEDS_H
#define CGAL_TANDEM_INTERNAL_SEEDS_H

#include <CGAL/Tandem/internal/Cloud.h>
#include <CGAL/Tandem/internal/Shapes.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

CGAL_TANDEM_HD inline Plane own_plane(const Grid_point& p)
{
  const Int_vector m = decode_normal(p.normal);
  return make_plane(unit({double(m.x), double(m.y), double(m.z)}), {double(p.x), double(p.y), double(p.z)});
}

struct Planarity {
  int fitting = 0; // neighbors that fit the plane of the point itself
  int close = 0;   // ... that do so within tighter bounds
};

CGAL_TANDEM_HD inline Planarity planarity(const Cloud_view& cloud, std::uint32_t i, const Tolerance& tolerance,
                                          const Tolerance& tight)
{
  Planarity p;
  if(cloud.point[i].normal == no_normal)
    return p;
  const Plane plane = own_plane(cloud.point[i]);
  const std::uint32_t* row = cloud.row(i);
  for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
    if(fits(plane, cloud.point[row[j]], tolerance)) {
      ++p.fitting;
      p.close += fits(plane, cloud.point[row[j]], tight);
    }
  return p;
}

// The candidates of a leaf are seed[leaf.first] ... seed[leaf.first + count[c] - 1].
template <class Backend>
struct Seeds {
  typename Backend::template Buffer<std::uint32_t> seed;
  std::vector<std::uint32_t> count;
};

template <class Backend>
Seeds<Backend> order_seeds(Backend& backend, const Cloud_view& cloud, const std::vector<Range>& cells,
                           const Tolerance& tolerance, const Tolerance& tight)
{
  constexpr std::uint64_t not_a_seed = ~std::uint64_t(0);
  typename Backend::template Buffer<std::uint64_t> key(cloud.size);
  Seeds<Backend> seeds;
  seeds.seed.reset(cloud.size);
  seeds.count.resize(cells.size());
  backend.for_each_piece(cells.size(), 1, [&](std::size_t c, std::size_t) {
    const Range cell = cells[c];
    Box box;
    for(std::uint32_t i = cell.first; i < cell.last; ++i)
      box.add(cloud.point[i]);
    for(std::uint32_t i = cell.first; i < cell.last; ++i) {
      const Grid_point& p = cloud.point[i];
      const Planarity score = planarity(cloud, i, tolerance, tight);
      const std::int64_t x = p.x - (std::int64_t(box.low[0]) + box.high[0]) / 2;
      const std::int64_t y = p.y - (std::int64_t(box.low[1]) + box.high[1]) / 2;
      const std::int64_t z = p.z - (std::int64_t(box.low[2]) + box.high[2]) / 2;
      const std::uint64_t distance = std::uint64_t(x * x + y * y + z * z) >> 16; // < 2^34
      key[i] = 2 * score.fitting < cloud.k
                 ? not_a_seed
                 : std::uint64_t(cloud.k - score.fitting) << 57 | std::uint64_t(cloud.k - score.close) << 50 |
                     distance << 16 | (i - cell.first);
    }
    std::sort(key.begin() + cell.first, key.begin() + cell.last);
    std::uint32_t count = 0;
    for(; count < cell.size() && key[cell.first + count] != not_a_seed; ++count)
      seeds.seed[cell.first + count] = cell.first + std::uint32_t(key[cell.first + count] & 0xffffu);
    seeds.count[c] = count;
  });
  return seeds;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SEEDS_H
