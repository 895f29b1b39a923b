// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the kernels of the neighbor search share: cloud, rows, tree, and the queries that one kernel defers to the next.
// Also the exact order of neighbors.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH

#include <CGAL/Tandem/internal/base/types.h>
#include <CGAL/Tandem/internal/cuda/execution/warp.cuh>

#include <cstddef>

namespace CGAL::Tandem::internal {

// --- The tree of boxes over the sorted cloud on a device. A bucket has eight successive points; a node has 32 children, so
// that a warp compares all of them at once. Needs 3.1 bytes a point. Bounds only prune the search, so other trees would
// give the same neighbors.

constexpr std::uint32_t bucket_points = 8;
constexpr std::uint32_t buckets_in_packet = warp_size / bucket_points;
constexpr int maximum_box_levels = 6; // 8 x 32^6 > 2^32

// Integer bounds, in grid steps.
struct Device_box {
  std::int32_t low[3], high[3];
};

// Level 0 has the buckets, the last one at most 32 nodes; the root above it is not stored. Node i has the children 32 i
// ... 32 i + 31 of the level below. The boxes of 32 siblings lie together: low x of all, low y of all, ..., high z of
// all. So a warp loads them in six wide reads.
struct Box_levels {
  static constexpr std::uint32_t group_words = 6 * warp_size;

  std::int32_t* box[maximum_box_levels];
  std::uint32_t count[maximum_box_levels];
  int levels;

  // The number of groups of 32 that so many nodes need.
  static std::uint32_t parents(std::uint32_t count) { return count / warp_size + (count % warp_size != 0); }

  // Fills in `count` and `levels`; returns how many words the boxes take.
  std::size_t shape(std::uint32_t n)
  {
    std::size_t words = 0;
    std::uint32_t size = n / bucket_points + (n % bucket_points != 0);
    for(levels = 0; levels == 0 || count[levels - 1] > warp_size; size = parents(size)) {
      words += std::size_t(parents(size)) * group_words;
      count[levels++] = size;
    }
    return words;
  }

  // Divides memory of as many words among the levels.
  void place(std::int32_t* memory)
  {
    for(int level = 0; level < levels; ++level) {
      box[level] = memory;
      memory += std::size_t(parents(count[level])) * group_words;
    }
  }

#ifdef __CUDACC__
  // A node may be any of the last group, also one beyond `count`: its box is that of the last node.
  __device__ Device_box load(int level, std::uint32_t node) const
  {
    const std::int32_t* b = box[level] + std::size_t(node / warp_size) * group_words + node % warp_size;
    return {{b[0], b[warp_size], b[2 * warp_size]}, {b[3 * warp_size], b[4 * warp_size], b[5 * warp_size]}};
  }

  __device__ void store(int level, std::uint32_t node, const Device_box& v) const
  {
    std::int32_t* b = box[level] + std::size_t(node / warp_size) * group_words + node % warp_size;
    for(int axis = 0; axis < 3; ++axis) {
      b[axis * warp_size] = v.low[axis];
      b[(axis + 3) * warp_size] = v.high[axis];
    }
  }
#endif
};

#ifdef __CUDACC__

// Level 0: a lane for each bucket. Places beyond the last bucket get the box of that bucket, so that whole groups have
// valid boxes.
static __global__ void fill_bucket_boxes(const int4* point, std::uint32_t n, Box_levels tree)
{
  const std::uint32_t bucket = blockIdx.x * blockDim.x + threadIdx.x;
  if(bucket / warp_size >= (tree.count[0] + warp_size - 1) / warp_size)
    return;
  const std::uint32_t first = min(bucket, tree.count[0] - 1) * bucket_points;
  int4 low = point[first], high = low;
  for(std::uint32_t j = 1; j < bucket_points; ++j) {
    const int4 p = point[min(first + j, n - 1)];
    low = make_int4(min(low.x, p.x), min(low.y, p.y), min(low.z, p.z), 0);
    high = make_int4(max(high.x, p.x), max(high.y, p.y), max(high.z, p.z), 0);
  }
  tree.store(0, bucket, {{low.x, low.y, low.z}, {high.x, high.y, high.z}});
}

// The next levels: a warp for each node, with a lane for each child. As above, places beyond the last node are filled.
static __global__ void join_boxes(Box_levels tree, int level)
{
  const std::uint32_t node = (blockIdx.x * blockDim.x + threadIdx.x) / warp_size, lane = threadIdx.x % warp_size;
  if(node / warp_size >= (tree.count[level] + warp_size - 1) / warp_size)
    return;
  Device_box b = tree.load(level - 1, min(node, tree.count[level] - 1) * warp_size + lane);
  for(int axis = 0; axis < 3; ++axis) {
    b.low[axis] = warp_min(b.low[axis]);
    b.high[axis] = warp_max(b.high[axis]);
  }
  if(lane == 0)
    tree.store(level, node, b);
}

#endif

// --- The task, and the order of neighbors.

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

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_TASK_CUH
