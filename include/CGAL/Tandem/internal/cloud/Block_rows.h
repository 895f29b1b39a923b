// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Blocks of successive surfels, and which blocks have neighbors of their surfels. So a pass can leave out blocks around
// which nothing has changed.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_BLOCK_ROWS_H
#define CGAL_TANDEM_INTERNAL_CLOUD_BLOCK_ROWS_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/backend/lanes.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>

namespace CGAL::Tandem::internal {

// Some entries of a row of blocks, a bit each.
using Block_entries = std::uint32_t;

// The blocks that have neighbors of one block, itself first. Ghosts are in blocks, too. There are too many to be listed
// if `size` exceeds the capacity.
struct Block_row {
  static constexpr std::uint32_t surfels = 64, capacity = 31;
  static constexpr Block_entries all = (Block_entries(1) << capacity) - 1;
  std::uint32_t size;
  std::uint32_t block[capacity];

  // The entry of a block; none if it is not listed, or the row is not.
  CGAL_TANDEM_HD Block_entries entry(std::uint32_t b) const
  {
    for(std::uint32_t i = 0; i < size && size <= capacity; ++i)
      if(block[i] == b)
        return 1u << i;
    return 0;
  }

  // A block that it does not have.
  CGAL_TANDEM_HD void add(std::uint32_t b)
  {
    if(size < capacity)
      block[size] = b;
    ++size;
  }
};

CGAL_TANDEM_HD inline std::size_t number_of_blocks(std::size_t surfels)
{
  return (surfels + Block_row::surfels - 1) / Block_row::surfels;
}

CGAL_TANDEM_HD inline Range surfels_of_block(std::uint32_t b, std::uint32_t surfels)
{
  const std::uint32_t first = b * Block_row::surfels;
  return {first, surfels - first < Block_row::surfels ? surfels : first + Block_row::surfels};
}

// By groups of lanes: each lane has a surfel.
struct Make_block_row {
  Cloud_view cloud;
  Block_row* row;
  Block_entries* of_surfel; // those that have its neighbors, or itself

  CGAL_TANDEM_HD void operator()(std::size_t b) const
  {
    Block_row r = {}; // the same in all lanes
    r.add(std::uint32_t(b));
    const Range surfels = surfels_of_block(std::uint32_t(b), cloud.size);
    for(std::uint32_t i = surfels.first; i < surfels.last; i += Lane_group::size())
      add_neighbors(r, i + Lane_group::rank(), surfels.last);
    Lane_group::single([&] { row[b] = r; });
  }

private:
  // Of the surfel of each lane, if it is before the last one.
  CGAL_TANDEM_HD void add_neighbors(Block_row& r, std::uint32_t i, std::uint32_t last) const
  {
    Block_entries entries = 1;
    bool is_any = i < last;
    std::uint64_t last_other = i / Block_row::surfels; // the next neighbor is mostly in the same block
    const std::uint32_t* const neighbor = cloud.row(is_any ? i : 0);
    for(int j = 0; j < cloud.k; ++j) {
      is_any = is_any && neighbor[j] != no_index;
      if(Lane_group::count(is_any) == 0)
        break;
      const std::uint64_t b = is_any ? neighbor[j] / Block_row::surfels : i / Block_row::surfels;
      const bool is_other = b != i / Block_row::surfels && b != last_other;
      if(Lane_group::count(is_other) == 0)
        continue;
      Block_entries entry = is_other ? r.entry(std::uint32_t(b)) : 0;
      Lane_group::for_each_in_order(is_other && entry == 0, b, [&](std::uint64_t other) {
        if(r.size <= Block_row::capacity && r.entry(std::uint32_t(other)) == 0)
          r.add(std::uint32_t(other));
      });
      last_other = is_other ? b : last_other;
      if(is_other && entry == 0)
        entry = r.size > Block_row::capacity ? Block_row::all : r.entry(std::uint32_t(b));
      entries |= entry;
    }
    if(i < last)
      of_surfel[i] = entries;
  }
};

template <class Backend>
struct Block_rows {
  Buffer_of<Backend, Block_row> row;
  Buffer_of<Backend, Block_entries> of_surfel;

  Block_rows(Backend& backend, const Sorted_cloud<Backend>& cloud)
    : row(number_of_blocks(cloud.number_of_surfels())), of_surfel(cloud.number_of_surfels())
  {
    for_each_by_group(backend, row.size(), Make_block_row{cloud.view(), row.data(), of_surfel.data()});
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_BLOCK_ROWS_H
