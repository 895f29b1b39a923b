// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The leaves of the octree over the points of all ranks. They are those of one process: see Cell_splitter, whose counts
// are summed here over ranks. All ranks have the same list of leaves; each also knows which of its points are in them.

#ifndef CGAL_TANDEM_INTERNAL_MPI_OCTANTS_H
#define CGAL_TANDEM_INTERNAL_MPI_OCTANTS_H

#include <CGAL/Tandem/internal/cloud/cells.h>
#include <CGAL/Tandem/internal/memory/Host_buffer.h>
#include <CGAL/Tandem/internal/mpi/Communicator.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// A cube of 2^(21 - level) finest octants a side: codes from `code` on.
struct Octant {
  std::uint64_t code;
  std::uint64_t total; // points, of all ranks
  Range own;           // points of this rank, in the order of codes
  int level;

  // Where leaves of more points are cut: finest octants.
  std::size_t number_of_cells(std::size_t cell_size) const
  {
    return level < curve_bits ? 1 : std::size_t((total + cell_size - 1) / cell_size);
  }
};

// The eight octants of one.
template <class Key>
void append_children(const Octant& parent, const Key& key, std::vector<Octant>& children)
{
  const int bits = 3 * (curve_bits - parent.level - 1);
  std::uint32_t first = parent.own.first;
  for(std::uint64_t child = 0; child < 8; ++child) {
    const std::uint64_t code = parent.code + (child << bits), end = parent.code + ((child + 1) << bits);
    const std::uint32_t last = partition_point(first, parent.own.last, [&](std::uint32_t i) { return key(i) < end; });
    children.push_back({code, 0, {first, last}, parent.level + 1});
    first = last;
  }
}

inline void count_octants(Communicator& communicator, std::vector<Octant>& octants)
{
  std::vector<std::uint64_t> counts;
  for(const Octant& o : octants)
    counts.push_back(o.own.size());
  communicator.sum(counts.data(), counts.size());
  for(std::size_t i = 0; i < octants.size(); ++i)
    octants[i].total = counts[i];
}

// The leaves with points, by code. key(i): the codes of the n points of this rank, ascending.
template <class Key>
std::vector<Octant> find_leaves(Communicator& communicator, std::size_t n, const Key& key, const Code_frame& frame,
                                std::size_t cell_size)
{
  std::vector<Octant> leaves, level = {{0, 0, {0, std::uint32_t(n)}, 0}};
  while(!level.empty()) {
    count_octants(communicator, level);
    std::vector<Octant> next;
    for(const Octant& o : level) {
      if(o.total == 0)
        continue;
      if(is_leaf(o.level, frame.shift, o.total, cell_size))
        leaves.push_back(o);
      else
        append_children(o, key, next);
    }
    level.swap(next);
  }
  std::sort(leaves.begin(), leaves.end(), [](const Octant& a, const Octant& b) { return a.code < b.code; });
  return leaves;
}

// The same from a sorted table of the host.
inline std::vector<Octant> find_leaves(Communicator& communicator, const Host_sort_table& sorted,
                                       const Code_frame& frame, std::size_t cell_size)
{
  const Host_sort_table::View order = sorted.view();
  return find_leaves(
    communicator, sorted.size(), [&](std::uint32_t i) { return order.key(i); }, frame, cell_size);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_OCTANTS_H
