// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A warp searches for the neighbors of 32 successive points of the sorted cloud, one for each lane. It walks the tree
// together and loads four buckets at a time, which all lanes compare with their queries, in float. Where float cannot
// decide, integers do: resolve_order() for the order in a row. Where a lane has more candidates in question than it
// keeps, its query is deferred.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_PACKET_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_PACKET_CUH

#include <CGAL/Tandem/internal/cuda/neighbors/Neighbor_task.cuh>
#include <CGAL/Tandem/internal/cuda/neighbors/Packet_candidates.cuh>

namespace CGAL::Tandem::internal {

constexpr unsigned packets_in_block = 2;
constexpr unsigned blocks_in_processor = 16; // leaves 64 registers a lane
constexpr int maximum_steps = 512;           // nodes and buckets that a packet visits before it is deferred
constexpr int packet_stack = 192;            // 31 entries for each level, and one

// Shared memory of one warp: of the search, then of the rows that it writes.
template <int K>
union Packet_memory {
  struct {
    Candidate_memory candidates;
    float4 center_and_x[warp_size]; // Centered_box, of the buckets of a group
    float2 yz[warp_size];
    uint2 stack[packet_stack]; // node with its level, squared distance as bits
  } search;
  std::uint32_t row[warp_size][K + 1];
};

// The search of one packet, for rows of K. All members are called by the whole warp.
template <int K>
class Neighbor_packet {
public:
  __device__ __forceinline__ Neighbor_packet(const Neighbor_task& task, Packet_memory<K>& memory, std::uint32_t packet)
    : task_(task), memory_(memory), packet_(packet), lane_(threadIdx.x % warp_size), found_(memory.search.candidates)
  {}

  // Writes the rows of the lanes that are certain, and defers the others. Incomplete and wide packets are deferred as a
  // whole.
  __device__ __forceinline__ void run()
  {
    const std::uint32_t live = min(task_.n - packet_ * warp_size, warp_size);
    if(live < warp_size || !start()) {
      task_.defer(packet_, all_lanes >> (warp_size - live));
      return;
    }
    if(!drop_outliers())
      search();
    const bool is_done = steps_ <= maximum_steps && !found_.is_full() && found_.is_certain();
    if(__any_sync(all_lanes, is_done))
      write(is_done);
    task_.defer(packet_, __ballot_sync(all_lanes, !is_done));
  }

private:
  // False if the queries are too far apart for float.
  __device__ __forceinline__ bool start()
  {
    const int4 q = task_.point[packet_ * warp_size + lane_];
    frame_.set(q);
    if(!frame_.is_narrow())
      return false;
    found_.start(frame_.relative(q), packet_ * buckets_in_packet);
    return true;
  }

  // Drops lanes that would make the others visit too much: with a radius more than four times theirs, by the mean
  // logarithm. Also lanes with a radius so small that it vanishes in the slack of the tests. Returns whether no others
  // are left.
  __device__ __forceinline__ bool drop_outliers()
  {
    constexpr int log_bits = 16; // lower bits are cut off, so that the sum of 32 fits
    const std::uint32_t log2 = __float_as_uint(found_.limit()) >> log_bits;
    const std::uint32_t mean = warp_sum(log2) / warp_size;
    const bool is_outlier =
      log2 > mean + (4u << (23 - log_bits)) || found_.limit() < 0x1p-16f * frame_.squared_radius();
    if(is_outlier)
      found_.drop();
    update_reach();
    return __ballot_sync(all_lanes, is_outlier) == all_lanes;
  }

  // No lane needs a point beyond its limit. Bits of floats that are not negative compare like the floats.
  __device__ __forceinline__ void update_reach() { reach_ = warp_max(__float_as_uint(fmaxf(found_.limit(), 0))); }

  // The own group first, for good limits; then down from the root, without that group.
  __device__ __forceinline__ void search()
  {
    const std::uint32_t own = packet_ / (warp_size / buckets_in_packet);
    int size = 0, level = 1;
    std::uint32_t node = own;
    bool is_start = true;
    for(;;) {
      if(level == 1)
        visit_buckets(node);
      else
        size = push_children(level, node, size, own);
      if(is_start && task_.tree.levels > 1) {
        node = 0;
        level = task_.tree.levels;
        is_start = false;
        continue;
      }
      std::uint32_t squared = 0;
      do {
        if(size == 0 || is_dropped())
          return finish_search();
        const uint2 top = memory_.search.stack[--size];
        __syncwarp();
        node = top.x & 0x1fffffffu;
        level = int(top.x >> 29);
        squared = top.y;
      } while(squared > reach_);
    }
  }

  // Pushes the children within reach, in the order of the curve. search() tests them again when they are popped, since
  // limits have fallen.
  __device__ __forceinline__ int push_children(int level, std::uint32_t node, int size, std::uint32_t own)
  {
    ++steps_;
    const std::uint32_t child = node * warp_size + lane_;
    const std::uint32_t squared = __float_as_uint(frame_.squared_distance_to(task_.tree.load(level - 1, child)));
    const bool is_near = child < task_.tree.count[level - 1] && squared <= reach_ && !(level == 2 && child == own);
    const std::uint32_t near = __ballot_sync(all_lanes, is_near);
    if(is_near)
      memory_.search.stack[size + __popc(near & ((1u << lane_) - 1))] =
        make_uint2(child | std::uint32_t(level - 1) << 29, squared);
    __syncwarp();
    return size + __popc(near);
  }

  // The buckets of a group, nearest first: limits fall, so far ones need no scan. Four that are near for any lane are
  // scanned at once.
  __device__ __forceinline__ void visit_buckets(std::uint32_t group)
  {
    const std::uint32_t bucket = group * warp_size + lane_;
    const Device_box box = task_.tree.load(0, bucket);
    const float squared = frame_.squared_distance_to(box);
    const bool is_own = bucket / buckets_in_packet == packet_;
    std::uint32_t key = (__float_as_uint(squared) & ~(warp_size - 1)) | lane_;
    if(bucket >= task_.tree.count[0] || is_own || __float_as_uint(squared) > reach_)
      key = no_index;
    if(!__any_sync(all_lanes, key != no_index))
      return;
    stage(frame_.centered(box));
    for(;;) {
      const std::uint32_t nearest = warp_min(key), who = nearest % warp_size;
      if(nearest == no_index || nearest - who > reach_ || is_dropped())
        return;
      ++steps_;
      if(lane_ == who)
        key = no_index;
      if(!__any_sync(all_lanes, found_.is_near(memory_.search.center_and_x[who], memory_.search.yz[who])))
        continue;
      if(lane_ == std::uint32_t(picked_))
        pick_ = group * warp_size + who;
      if(++picked_ == int(buckets_in_packet))
        scan();
    }
  }

  // Puts the box of each lane's bucket where all lanes can read it.
  __device__ __forceinline__ void stage(const Centered_box& b)
  {
    __syncwarp();
    memory_.search.center_and_x[lane_] = b.center_and_x;
    memory_.search.yz[lane_] = b.yz;
    __syncwarp();
  }

  // The search of the packet has failed: too many steps or candidates.
  __device__ __forceinline__ bool is_dropped() const { return steps_ > maximum_steps || found_.is_full(); }

  __device__ __forceinline__ void finish_search()
  {
    if(picked_ > 0)
      scan();
    found_.finish();
  }

  // Compares the points of the picked buckets with all queries.
  __device__ __forceinline__ void scan()
  {
    const std::uint32_t bucket = __shfl_sync(all_lanes, pick_, int(lane_ / bucket_points));
    const std::uint32_t index = bucket * bucket_points + lane_ % bucket_points;
    const bool is_point = int(lane_ / bucket_points) < picked_ && index < task_.n;
    const int4 p = is_point ? task_.point[index] : frame_.middle();
    picked_ = 0;
    found_.add_batch(frame_.relative(p), is_point, pick_);
    update_reach();
  }

  // The rows go to shared memory first, so that global memory is written in wide parts. The memory of the search is
  // reused for them, after all indices have been read.
  __device__ __forceinline__ void write(bool is_done)
  {
    __syncwarp();
    std::uint32_t index[K + 1];
#pragma unroll
    for(int i = 0; i <= K; ++i)
      index[i] = found_.index(i);
    __syncwarp();
    std::uint32_t* row = memory_.row[lane_];
#pragma unroll
    for(int i = 0; i <= K; ++i)
      row[i] = index[i];
    if(is_done)
      resolve_order(row);
    __syncwarp();
    if(task_.k == K)
      write_whole_rows();
    else
      write_beginning_of_rows();
  }

  // Insertion sort by exact distances of the entries whose keys are too close to those before them. Covers the entry
  // behind the last one, which a tie may bring into the row.
  __device__ __forceinline__ void resolve_order(std::uint32_t* row) const
  {
    std::uint32_t unsure = found_.uncertain_order();
    if(unsure == 0)
      return;
    const int4 query = task_.point[packet_ * warp_size + lane_];
    for(; unsure != 0; unsure &= unsure - 1) {
      int i = __ffs(int(unsure));
      const Exact_distance moved = exact_distance(task_, query, row[i]);
      for(; i > 0 && moved < exact_distance(task_, query, row[i - 1]); --i)
        row[i] = row[i - 1];
      row[i] = moved.index;
    }
  }

  // Four entries at a time. Rows of deferred lanes are written as well, with arbitrary entries; the search for single
  // queries runs later.
  __device__ __forceinline__ void write_whole_rows() const
  {
    static_assert(K % 4 == 0, "rows of whole uint4");
    uint4* out = reinterpret_cast<uint4*>(task_.row(packet_ * warp_size));
#pragma unroll
    for(std::uint32_t i = lane_; i < warp_size * K / 4; i += warp_size) {
      const std::uint32_t* r = memory_.row[i / (K / 4)] + i % (K / 4) * 4;
      out[i] = make_uint4(r[0], r[1], r[2], r[3]);
    }
  }

  // For k < K.
  __device__ __forceinline__ void write_beginning_of_rows() const
  {
    std::uint32_t* out = task_.row(packet_ * warp_size);
    const std::uint32_t k = std::uint32_t(task_.k);
    for(std::uint32_t i = lane_; i < warp_size * k; i += warp_size)
      out[i] = memory_.row[i / k][i % k];
  }

  const Neighbor_task& task_;
  Packet_memory<K>& memory_;
  std::uint32_t packet_, lane_;
  Packet_frame frame_;
  Packet_candidates<K> found_;
  std::uint32_t reach_; // the largest limit of all lanes, as bits
  int steps_ = 0;
  std::uint32_t pick_ = 0; // lane i: the i-th bucket to be scanned
  int picked_ = 0;
};

template <int K>
__global__ void __launch_bounds__(packets_in_block* warp_size, blocks_in_processor)
  find_packet_neighbors(const __grid_constant__ Neighbor_task task)
{
  __shared__ Packet_memory<K> memory[packets_in_block];
  const std::uint32_t warp = threadIdx.x / warp_size, packet = blockIdx.x * packets_in_block + warp;
  if(packet < task.packets())
    Neighbor_packet<K>(task, memory[warp], packet).run();
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_NEIGHBOR_PACKET_CUH
