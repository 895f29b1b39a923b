// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels of the neighbor search share: cloud, rows, tree, and the queries that one kernel defers to the next.
// Also the exact order of neighbors.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH

#include <CGAL/Tandem/internal/cuda/neighbors/Box_levels.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// Queries of a packet that are searched one by one: bit i is point 32 packet + i.
struct Deferred_lanes {
  std::uint32_t packet, lanes;
};

// Zero before the search. Atomics decide only which warp has which query, so rows do not depend on their order.
struct Neighbor_counters {
  unsigned long long queries, packets; // deferred ones; `queries` counts also those without room
  unsigned long long jobs;             // that warps have taken
};

// Passed to kernels by value. Pointers are to memory of the device; rows have k entries each.
struct Neighbor_task {
  const int4* point; // Grid_point
  std::uint32_t n;
  int k;
  std::uint32_t* neighbor;
  Box_levels tree;
  Neighbor_counters* counters;
  std::uint32_t* query; // deferred ones, as long as there is room
  Deferred_lanes* deferred;

  // Packets of 32 successive points, the last one perhaps incomplete. Few queries are deferred, so the list of single
  // ones has room for an eighth of them.
  CGAL_TANDEM_HD std::uint32_t packets() const { return n / warp_size + (n % warp_size != 0); }
  CGAL_TANDEM_HD std::uint32_t maximum_queries() const { return packets() * 4; }

  __device__ std::uint32_t* row(std::uint32_t i) const { return neighbor + std::size_t(i) * std::uint32_t(k); }

  // Called by the whole warp: defers the given lanes of a packet. As single queries while the list has room for all of
  // them, since their work is then spread over more warps. Else as one entry for the packet; places of the list that it
  // leaves unused get no_index.
  __device__ void defer(std::uint32_t packet, std::uint32_t lanes) const
  {
    if(lanes == 0)
      return;
    const std::uint32_t lane = threadIdx.x % warp_size;
    unsigned long long first = 0;
    if(lane == 0)
      first = atomicAdd(&counters->queries, (unsigned long long)(__popc(lanes)));
    first = __shfl_sync(all_lanes, first, 0);
    const bool has_room = first + std::uint32_t(__popc(lanes)) <= maximum_queries();
    const unsigned long long place = first + std::uint32_t(__popc(lanes & ((1u << lane) - 1)));
    if((lanes >> lane & 1) != 0 && place < maximum_queries())
      query[place] = has_room ? packet * warp_size + lane : no_index;
    if(!has_room && lane == 0)
      deferred[atomicAdd(&counters->packets, 1ull)] = {packet, lanes};
  }
};

// The order that defines the neighbors: squared distance, then position in the sorted cloud. It is total.
struct Exact_distance {
  std::uint64_t squared;
  std::uint32_t index;

  __device__ bool operator<(const Exact_distance& d) const
  {
    return squared < d.squared || (squared == d.squared && index < d.index);
  }
};

// Differences of coordinates are at most 2^29, so the sum is below 2^60.
__device__ inline std::uint64_t squared_distance(const int4& p, const int4& q)
{
  const std::int64_t x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
  return std::uint64_t(x * x + y * y + z * z);
}

__device__ inline Exact_distance exact_distance(const Neighbor_task& task, const int4& query, std::uint32_t index)
{
  return {squared_distance(query, task.point[index]), index};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH
