// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tree of boxes over the sorted cloud on a device. A bucket has eight successive points; a node has 32 children, so
// that a warp compares all of them at once. Needs 3.1 bytes a point. Bounds only prune the search, so other trees would
// give the same neighbors.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_BOX_LEVELS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_BOX_LEVELS_CUH

#include <CGAL/Tandem/internal/cuda/execution/warp.cuh>
#include <CGAL/Tandem/internal/base/types.h>

#include <cstddef>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_BOX_LEVELS_CUH
