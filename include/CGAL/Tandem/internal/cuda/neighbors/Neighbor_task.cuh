// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels of the neighbor search share.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH

#include <CGAL/Tandem/internal/cuda/neighbors/Box_levels.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// Lanes of a packet that are to be answered one by one.
struct Deferred_lanes {
  std::uint32_t packet, lanes;
};

struct Neighbor_counters {
  unsigned long long queries, packets; // deferred ones
  unsigned long long jobs;             // that are taken
};

struct Neighbor_task {
  const int4* point; // Grid_point
  std::uint32_t n;
  int k;
  std::uint32_t* neighbor;
  Box_levels tree;
  Neighbor_counters* counters;
  std::uint32_t* query; // deferred ones, as long as there is room
  Deferred_lanes* deferred;

  CGAL_TANDEM_HD std::uint32_t packets() const { return n / warp_size + (n % warp_size != 0); }
  CGAL_TANDEM_HD std::uint32_t maximum_queries() const { return packets() * 4; }

  __device__ std::uint32_t* row(std::uint32_t i) const { return neighbor + std::size_t(i) * std::uint32_t(k); }

  // By the whole warp.
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

// The order that defines the answer.
struct Exact_distance {
  std::uint64_t squared;
  std::uint32_t index;

  __device__ bool operator<(const Exact_distance& d) const
  {
    return squared < d.squared || (squared == d.squared && index < d.index);
  }
};

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
