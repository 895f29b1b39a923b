// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A warp searches for the neighbors of a single query, in integers throughout. This serves points far from those beside
// them in the cloud, many points in one place, ties, and large k. The lanes hold the list: lane i has its entries i and 32
// + i. Visits nodes depth-first, nearest first, and prunes by the exact order.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_QUERY_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_QUERY_CUH

#include <CGAL/Tandem/internal/cuda/neighbors/Neighbor_task.cuh>

namespace CGAL::Tandem::internal {

constexpr int maximum_insertions = 8; // more candidates at a time are merged

// The stack of one warp, in shared memory.
struct Query_memory {
  static constexpr int stack_size = 192; // 31 for each level, and one
  Exact_distance near[stack_size];       // the box, its first point
  std::uint32_t node[stack_size];        // and the level in the upper bits
};

// Words: entries of the list in a lane, 1 for k <= 32, 2 for k <= 64.
template <int Words>
class Neighbor_query {
public:
  __device__ Neighbor_query(const Neighbor_task& task, Query_memory& memory, std::uint32_t query)
    : task_(task), memory_(memory), query_(query), lane_(threadIdx.x % warp_size), q_(task.point[query])
  {
    // Entries without a point are farther than all points; rows of small clouds end with them.
    worst_ = {~std::uint64_t(0), no_index};
    for(Exact_distance& d : list_)
      d = worst_;
  }

  // The 32 buckets around the query first, for a good bound; then down from the root, without these.
  __device__ void run()
  {
    const std::uint32_t own = query_ / (bucket_points * warp_size);
    visit_buckets(own);
    int size = task_.tree.levels > 1 ? push_children(task_.tree.levels, 0, 0, own) : 0;
    while(size > 0) {
      const Exact_distance near = memory_.near[--size];
      const std::uint32_t node = memory_.node[size] & 0x1fffffffu;
      const int level = int(memory_.node[size] >> 29);
      __syncwarp();
      if(!(near < worst_))
        continue;
      if(level == 1)
        visit_buckets(node);
      else
        size = push_children(level, node, size, own);
    }
    write();
  }

private:
  // A lower bound for the points of a node: squared distance to its box, and position of its first point. So a box at
  // the distance of the k-th neighbor counts only if its points may come before that.
  __device__ Exact_distance distance_to(int level, std::uint32_t node) const
  {
    if(node >= task_.tree.count[level])
      return {~std::uint64_t(0), no_index};
    const Device_box b = task_.tree.load(level, node);
    const std::int64_t x = max(max(b.low[0] - q_.x, q_.x - b.high[0]), 0);
    const std::int64_t y = max(max(b.low[1] - q_.y, q_.y - b.high[1]), 0);
    const std::int64_t z = max(max(b.low[2] - q_.z, q_.z - b.high[2]), 0);
    return {std::uint64_t(x * x + y * y + z * z), node << (3 + 5 * level)};
  }

  // Decides only the order of visits, so a float is enough; its lowest bits hold the lane.
  __device__ std::uint32_t rough_key(const Exact_distance& d) const
  {
    return (__float_as_uint(float(d.squared)) & ~(warp_size - 1)) | lane_;
  }

  // Pushes the children of a node that may have neighbors, the nearest one last. Returns the size of the stack.
  __device__ int push_children(int level, std::uint32_t node, int size, std::uint32_t own)
  {
    const std::uint32_t child = node * warp_size + lane_;
    const Exact_distance d = distance_to(level - 1, child);
    const bool is_near = d < worst_ && !(level == 2 && child == own);
    const std::uint32_t count = std::uint32_t(__popc(__ballot_sync(all_lanes, is_near)));
    std::uint32_t key = is_near ? rough_key(d) : no_index;
    for(std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t nearest = warp_min(key);
      if(nearest == key) {
        memory_.near[size + int(count - 1 - i)] = d;
        memory_.node[size + int(count - 1 - i)] = child | std::uint32_t(level - 1) << 29;
        key = no_index;
      }
    }
    __syncwarp();
    return size + int(count);
  }

  // Scans the buckets of a group, four at a time, nearest first, until all remaining ones are too far.
  __device__ void visit_buckets(std::uint32_t group)
  {
    const Exact_distance d = distance_to(0, group * warp_size + lane_);
    std::uint32_t key = d.index == no_index ? no_index : rough_key(d);
    while(__any_sync(all_lanes, key != no_index && d < worst_)) {
      std::uint32_t bucket = no_index;
      for(std::uint32_t i = 0; i < buckets_in_packet; ++i) {
        const std::uint32_t nearest = warp_min(key);
        if(nearest != no_index && lane_ / bucket_points == i)
          bucket = group * warp_size + nearest % warp_size;
        if(nearest == key)
          key = no_index;
      }
      const std::uint32_t index = bucket * bucket_points + lane_ % bucket_points;
      scan(index, bucket != no_index && index < task_.n && index != query_);
    }
  }

  // Compares one point of each lane with the query.
  __device__ void scan(std::uint32_t index, bool is_point)
  {
    Exact_distance d = {~std::uint64_t(0), no_index};
    if(is_point)
      d = exact_distance(task_, q_, index);
    std::uint32_t near = __ballot_sync(all_lanes, d < worst_);
    if(Words == 1 && __popc(near) > maximum_insertions)
      return merge(d);
    for(; near != 0; near &= near - 1)
      insert(shuffled(d, __ffs(int(near)) - 1));
  }

  // The 32 smallest of the list and of one more for each lane. With the latter in descending order, the smaller ones of
  // each pair are a bitonic sequence, which is then sorted.
  __device__ void merge(Exact_distance d)
  {
    for(unsigned size = 2; size <= warp_size; size *= 2)
      for(unsigned stride = size / 2; stride > 0; stride /= 2)
        order(d, stride, (lane_ & size) != 0 || size == warp_size);
    if(d < list_[0])
      list_[0] = d;
    for(unsigned stride = warp_size / 2; stride > 0; stride /= 2)
      order(list_[0], stride, false);
    worst_ = shuffled(list_[0], task_.k - 1);
  }

  // A step of a bitonic sort between two lanes: the smaller one goes to the lower lane, or to the upper one.
  __device__ void order(Exact_distance& d, unsigned stride, bool is_descending) const
  {
    const Exact_distance other = {__shfl_xor_sync(all_lanes, d.squared, int(stride)),
                                  __shfl_xor_sync(all_lanes, d.index, int(stride))};
    const bool takes_smaller = ((lane_ & stride) == 0) != is_descending;
    if((other < d) == takes_smaller)
      d = other;
  }

  // One candidate that all lanes have: entries behind its place move up by one lane, the last one to the next word.
  __device__ void insert(const Exact_distance& x)
  {
    if(!(x < worst_))
      return;
    Exact_distance pushed = x;
#pragma unroll
    for(int w = 0; w < Words; ++w) {
      const Exact_distance last = shuffled(list_[w], int(warp_size) - 1);
      const int position = __popc(__ballot_sync(all_lanes, list_[w] < pushed));
      const Exact_distance before = {__shfl_up_sync(all_lanes, list_[w].squared, 1),
                                     __shfl_up_sync(all_lanes, list_[w].index, 1)};
      if(int(lane_) >= position)
        list_[w] = int(lane_) == position ? pushed : before;
      if(position < int(warp_size))
        pushed = last;
    }
    worst_ = shuffled(list_[Words - 1], (task_.k - 1) % int(warp_size));
  }

  // The value that lane `from` has.
  __device__ static Exact_distance shuffled(const Exact_distance& d, int from)
  {
    return {__shfl_sync(all_lanes, d.squared, from), __shfl_sync(all_lanes, d.index, from)};
  }

  __device__ void write() const
  {
#pragma unroll
    for(int w = 0; w < Words; ++w)
      if(w * int(warp_size) + int(lane_) < task_.k)
        task_.row(query_)[w * warp_size + lane_] = list_[w].index;
  }

  const Neighbor_task& task_;
  Query_memory& memory_;
  std::uint32_t query_, lane_;
  int4 q_;
  Exact_distance list_[Words]; // ascending
  Exact_distance worst_;       // the k-th
};

// The deferred queries, or all. A job is a query of the list, or four lanes of a deferred packet; a warp takes one
// after the other. So warps with fast queries take more.
template <int Words>
__global__ void __launch_bounds__(128) find_single_neighbors(const __grid_constant__ Neighbor_task task, bool all)
{
  constexpr std::uint32_t parts = 8; // of a packet: four lanes
  __shared__ Query_memory memory[4];
  const unsigned long long queries =
    all ? 0 : min(task.counters->queries, (unsigned long long)(task.maximum_queries()));
  const unsigned long long packets = all ? task.packets() : task.counters->packets;
  for(;;) {
    unsigned long long job = 0;
    if(threadIdx.x % warp_size == 0)
      job = atomicAdd(&task.counters->jobs, 1ull);
    job = __shfl_sync(all_lanes, job, 0);
    std::uint32_t first = 0, lanes = 1;
    if(job < queries) {
      first = task.query[job];
      if(first == no_index)
        continue;
    } else {
      job -= queries;
      if(job >= packets * parts)
        return;
      const Deferred_lanes d = all ? Deferred_lanes{std::uint32_t(job / parts), all_lanes} : task.deferred[job / parts];
      const std::uint32_t shift = std::uint32_t(job % parts) * (warp_size / parts);
      first = d.packet * warp_size + shift;
      lanes = d.lanes >> shift & ((1u << (warp_size / parts)) - 1);
    }
    for(; lanes != 0; lanes &= lanes - 1) {
      const std::uint32_t query = first + std::uint32_t(__ffs(int(lanes))) - 1;
      if(query < task.n)
        Neighbor_query<Words>(task, memory[threadIdx.x / warp_size], query).run();
    }
  }
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_QUERY_CUH
