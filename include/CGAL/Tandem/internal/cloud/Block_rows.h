// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Blocks of successive points, and which blocks have neighbors of their points. So a pass can leave out blocks around
// which nothing has changed.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_BLOCK_ROWS_H
#define CGAL_TANDEM_INTERNAL_CLOUD_BLOCK_ROWS_H

#include <CGAL/Tandem/internal/cloud/Cloud.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The blocks that have neighbors of one block, itself among them. There are too many to be listed, or some belong to
// another rank, if `size` exceeds the capacity.
struct Block_row {
  static constexpr std::uint32_t points = 64, capacity = 15;
  std::uint32_t size;
  std::uint32_t block[capacity];

  CGAL_TANDEM_HD void add(std::uint32_t b)
  {
    for(std::uint32_t i = 0; i < size; ++i)
      if(block[i] == b)
        return;
    if(size < capacity)
      block[size] = b;
    ++size;
  }
};

CGAL_TANDEM_HD inline std::size_t number_of_blocks(std::size_t points)
{
  return (points + Block_row::points - 1) / Block_row::points;
}

struct Make_block_row {
  Cloud_view cloud;
  std::uint32_t own; // points; ghosts follow
  Block_row* row;

  CGAL_TANDEM_HD void operator()(std::size_t b) const
  {
    Block_row& r = row[b];
    r.size = 0;
    r.add(std::uint32_t(b));
    const std::uint32_t first = std::uint32_t(b) * Block_row::points;
    const std::uint32_t last = own - first < Block_row::points ? own : first + Block_row::points;
    for(std::uint32_t i = first; i < last && r.size <= Block_row::capacity; ++i)
      add_neighbors(r, cloud.row(i));
  }

private:
  CGAL_TANDEM_HD void add_neighbors(Block_row& r, const std::uint32_t* neighbor) const
  {
    for(int j = 0; j < cloud.k && neighbor[j] != no_index && r.size <= Block_row::capacity; ++j)
      if(neighbor[j] < own)
        r.add(neighbor[j] / Block_row::points);
      else
        r.size = Block_row::capacity + 1;
  }
};

template <class Backend>
typename Backend::template Buffer<Block_row> make_block_rows(Backend& backend, const Sorted_cloud<Backend>& cloud)
{
  typename Backend::template Buffer<Block_row> row(number_of_blocks(cloud.size()));
  backend.for_each(row.size(), Make_block_row{cloud.view(), std::uint32_t(cloud.size()), row.data()}, 64);
  return row;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CLOUD_BLOCK_ROWS_H
