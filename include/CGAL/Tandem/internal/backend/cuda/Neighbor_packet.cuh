// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A warp answers 32 consecutive points of the sorted cloud, each lane one of them.
// The warp walks the tree together, takes four leaves at a time into shared
// memory, and each lane keeps the smallest keys of its own in registers.
//
// Why the answer is exact, with u = 2^-24. Coordinates are relative to the middle
// of the packet. Those of the lanes are below 2^22, so exact; those of a candidate
// are exact below 2^24 and beyond off by 1 + u, where the difference is at least
// 3/4 of them. So squared distances are off by at most 1 + 12u. A key is a squared
// distance in units that are chosen so that all that matter are below 2^22, hence
// off by 3.5 units: keys that differ by key_margin are in the right order. Who is
// farther than the k-th key and limit_margin is no neighbor. Where keys are closer,
// integers decide: their order by settle_order(), and if more candidates than the
// list holds are in question, by the search for a single query.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_CUDA_NEIGHBOR_PACKET_CUH
#define CGAL_TANDEM_INTERNAL_BACKEND_CUDA_NEIGHBOR_PACKET_CUH

#include <CGAL/Tandem/internal/backend/cuda/Neighbor_task.cuh>
#include <CGAL/Tandem/internal/backend/cuda/sorting_network.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int tests_at_once = 32;
constexpr int most_batches = 32; // batches of 32 points that contain a candidate
constexpr int most_pending = 4; // of them, candidates not yet in the lists
constexpr int least_active = 4;
constexpr int most_steps = 512; // of the search: groups and leaves that are looked at
constexpr int packet_stack = 192; // 31 for each level, and one
constexpr int tag_bits = 10;      // the batch and the place in it
constexpr std::uint32_t key_margin = 9u << tag_bits;
constexpr std::uint32_t limit_margin = 12;

template <int K>
union Packet_memory {
  struct {
    float4 point[most_pending * warp_size];
    std::uint32_t near[most_pending * warp_size]; // of each batch: the points that are near a lane
    float4 box[warp_size];                        // of the leaves of a group: the center, half of the size
    float2 box_size[warp_size];
    std::uint32_t leaf[most_batches * leaves_in_packet];
    uint2 stack[packet_stack];
  } search;
  std::uint32_t row[warp_size][K + 1];
};

template <int K>
class Neighbor_packet {
public:
  __device__ Neighbor_packet(const Neighbor_task& task, Packet_memory<K>& memory, std::uint32_t packet)
    : task_(task), memory_(memory), packet_(packet), lane_(threadIdx.x % warp_size)
  {}

  __device__ __forceinline__ void run()
  {
    const std::uint32_t live = min(task_.n - packet_ * warp_size, warp_size);
    if(live < warp_size || !load_queries()) {
      task_.defer(packet_, all_lanes >> (warp_size - live));
      return;
    }
    sort_own_points();
    drop_outliers();
    if(dropped_ != all_lanes)
      search();
    const bool is_answered = (dropped_ >> lane_ & 1) == 0 && key_[list_size - 1] - key_[K - 1] >= key_margin;
    if(__any_sync(all_lanes, is_answered))
      write(is_answered);
    task_.defer(packet_, __ballot_sync(all_lanes, !is_answered));
  }

private:
  static constexpr int list_size = K + 2;
  static constexpr float half_range = 0x1p21f; // of a key without its tag
  static constexpr float infinite = 0x1p126f;
  static constexpr float slack = 0x1p-20f; // 16u, see is_near()

  // The frame of the packet and the query of the lane. False if the packet is too wide.
  __device__ __forceinline__ bool load_queries()
  {
    const int4 q = task_.point[packet_ * warp_size + lane_];
    const int low_x = warp_min(q.x), low_y = warp_min(q.y), low_z = warp_min(q.z);
    const int high_x = warp_max(q.x), high_y = warp_max(q.y), high_z = warp_max(q.z);
    x_ = low_x + (high_x - low_x) / 2;
    y_ = low_y + (high_y - low_y) / 2;
    z_ = low_z + (high_z - low_z) / 2;
    half_x_ = float(high_x - x_);
    half_y_ = float(high_y - y_);
    half_z_ = float(high_z - z_);
    if(fmaxf(half_x_, fmaxf(half_y_, half_z_)) >= 0x1p22f)
      return false;
    const float4 p = stage(0, q, true);
    minus_2x_ = -2 * p.x;
    minus_2y_ = -2 * p.y;
    minus_2z_ = -2 * p.z;
    squared_ = p.w;
    if(lane_ < leaves_in_packet)
      memory_.search.leaf[lane_] = packet_ * leaves_in_packet + lane_;
    return true;
  }

  // Puts one point for each lane where all lanes can read them.
  __device__ __forceinline__ float4 stage(int slot, const int4& p, bool is_point)
  {
    float4 f = make_float4(float(p.x - x_), float(p.y - y_), float(p.z - z_), infinite);
    if(is_point)
      f.w = fmaf(f.x, f.x, fmaf(f.y, f.y, f.z * f.z)) * (1 - slack);
    __syncwarp();
    memory_.search.point[std::uint32_t(slot) * warp_size + lane_] = f;
    __syncwarp();
    return f;
  }

  __device__ __forceinline__ float squared_distance_to(int j) const
  {
    const float4& p = memory_.search.point[j];
    const float dx = fmaf(0.5f, minus_2x_, p.x), dy = fmaf(0.5f, minus_2y_, p.y), dz = fmaf(0.5f, minus_2z_, p.z);
    return fmaf(dx, dx, fmaf(dy, dy, dz * dz));
  }

  // 2^23 makes an integer of it, rounded, in the low bits.
  __device__ __forceinline__ std::uint32_t make_key(float squared, std::uint32_t tag) const
  {
    return __float_as_uint(fmaf(squared, scale_, 0x1p23f)) << tag_bits | tag;
  }

  __device__ __forceinline__ void sort_own_points()
  {
    float squared[warp_size];
#pragma unroll
    for(int j = 0; j < int(warp_size); ++j)
      squared[j] = squared_distance_to(j);
    const float bound = fmaxf(bound_by_own_leaves(squared), 1);
    scale_ = half_range / bound;
    unscale_ = bound / half_range;
    std::uint32_t key[warp_size];
#pragma unroll
    for(int j = 0; j < int(warp_size); ++j)
      key[j] = j == int(lane_) ? no_index : make_key(fminf(squared[j], 1.5f * bound), j);
    sort_odd_even<0, int(warp_size)>(key);
#pragma unroll
    for(int i = 0; i < list_size; ++i)
      key_[i] = key[i];
    batches_ = first_pending_ = 1;
    update_limit();
  }

  // So many of the packet's leaves that they have K points beside the query lie
  // within this squared distance.
  __device__ __forceinline__ static float bound_by_own_leaves(const float (&squared)[warp_size])
  {
    static_assert(leaves_in_packet == 4 && K + 1 <= int(warp_size), "see below");
    float farthest[leaves_in_packet];
#pragma unroll
    for(int i = 0; i < int(leaves_in_packet); ++i) {
      farthest[i] = squared[i * int(leaf_points)];
#pragma unroll
      for(int j = 1; j < int(leaf_points); ++j)
        farthest[i] = fmaxf(farthest[i], squared[i * int(leaf_points) + j]);
    }
    const float a = fminf(farthest[0], farthest[1]), b = fmaxf(farthest[0], farthest[1]);
    const float c = fminf(farthest[2], farthest[3]), d = fmaxf(farthest[2], farthest[3]);
    constexpr int needed = (K + int(leaf_points)) / int(leaf_points);
    return needed == 1   ? fminf(a, c)
           : needed == 2 ? fminf(fmaxf(a, c), fminf(b, d))
           : needed == 3 ? fmaxf(fmaxf(a, c), fminf(b, d))
                         : fmaxf(b, d);
  }

  // Nothing farther than limit_ is a neighbor of this lane.
  __device__ __forceinline__ void update_limit()
  {
    limit_ = float((key_[K - 1] >> tag_bits) + limit_margin) * unscale_;
    update_reach();
  }

  __device__ __forceinline__ void update_reach()
  {
    if(dropped_ >> lane_ & 1)
      limit_ = -infinite;
    threshold_ = squared_ - limit_;
    reach_ = warp_max(__float_as_uint(fmaxf(limit_, 0)));
  }

  // Lanes that would make the others look at too much: with a radius more than four
  // times as large as theirs (by the mean logarithm), or one so small that slack
  // hides it.
  __device__ __forceinline__ void drop_outliers()
  {
    constexpr int log_bits = 16; // dropped, so that the sum fits
    const std::uint32_t log2 = __float_as_uint(limit_) >> log_bits;
    const std::uint32_t mean = warp_sum(log2) / warp_size;
    const float widest = half_x_ * half_x_ + half_y_ * half_y_ + half_z_ * half_z_;
    const bool is_outlier = log2 > mean + (4u << (23 - log_bits)) || limit_ < 0x1p-16f * widest;
    dropped_ = __ballot_sync(all_lanes, is_outlier);
    update_reach();
  }

  // Rounded by less than limit_margin.
  __device__ __forceinline__ float squared_distance_to_packet(const Device_box& b) const
  {
    const float x = fmaxf(float(max(b.low[0] - x_, x_ - b.high[0])) - half_x_, 0);
    const float y = fmaxf(float(max(b.low[1] - y_, y_ - b.high[1])) - half_y_, 0);
    const float z = fmaxf(float(max(b.low[2] - z_, z_ - b.high[2])) - half_z_, 0);
    return fmaf(x, x, fmaf(y, y, z * z));
  }

  // Boxes that float may not represent are near everybody.
  __device__ __forceinline__ void stage_box(const Device_box& b)
  {
    const float low_x = float(b.low[0] - x_), low_y = float(b.low[1] - y_), low_z = float(b.low[2] - z_);
    const float high_x = float(b.high[0] - x_), high_y = float(b.high[1] - y_), high_z = float(b.high[2] - z_);
    const float widest = fmaxf(fmaxf(fmaxf(-low_x, high_x), fmaxf(-low_y, high_y)), fmaxf(-low_z, high_z));
    const float least = fminf(fminf(fminf(-low_x, high_x), fminf(-low_y, high_y)), fminf(-low_z, high_z));
    const float extra = fmaxf(widest, -least) < 0x1p22f ? 0 : infinite;
    __syncwarp();
    memory_.search.box[lane_] = make_float4(0.5f * (low_x + high_x), 0.5f * (low_y + high_y), 0.5f * (low_z + high_z),
                                            0.5f * (high_x - low_x) + extra);
    memory_.search.box_size[lane_] = make_float2(0.5f * (high_y - low_y) + extra, 0.5f * (high_z - low_z) + extra);
    __syncwarp();
  }

  __device__ __forceinline__ bool is_near_a_lane(std::uint32_t i) const
  {
    const float4 b = memory_.search.box[i];
    const float2 s = memory_.search.box_size[i];
    const float x = fmaxf(fabsf(fmaf(0.5f, minus_2x_, b.x)) - b.w, 0);
    const float y = fmaxf(fabsf(fmaf(0.5f, minus_2y_, b.y)) - s.x, 0);
    const float z = fmaxf(fabsf(fmaf(0.5f, minus_2z_, b.z)) - s.y, 0);
    return __any_sync(all_lanes, fmaf(x, x, fmaf(y, y, z * z)) <= limit_);
  }

  // The own group first, for a good limit; then down from the root.
  __device__ __forceinline__ void search()
  {
    const std::uint32_t own = packet_ / (warp_size / leaves_in_packet);
    int size = 0, level = 1;
    std::uint32_t node = own;
    bool is_start = true;
    for(;;) {
      if(level == 1)
        visit_leaves(node);
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
        if(size == 0 || steps_ > most_steps)
          return finish_search();
        const uint2 top = memory_.search.stack[--size];
        __syncwarp();
        node = top.x & 0x1fffffffu;
        level = int(top.x >> 29);
        squared = top.y;
      } while(squared > reach_);
    }
  }

  __device__ __forceinline__ int push_children(int level, std::uint32_t node, int size, std::uint32_t own)
  {
    ++steps_;
    const std::uint32_t child = node * warp_size + lane_;
    const std::uint32_t squared = __float_as_uint(squared_distance_to_packet(task_.tree.load(level - 1, child)));
    const bool is_near = child < task_.tree.count[level - 1] && squared <= reach_ && !(level == 2 && child == own);
    const std::uint32_t near = __ballot_sync(all_lanes, is_near);
    if(is_near)
      memory_.search.stack[size + __popc(near & ((1u << lane_) - 1))] =
        make_uint2(child | std::uint32_t(level - 1) << 29, squared);
    __syncwarp();
    return size + __popc(near);
  }

  // The leaves of a group, nearest first.
  __device__ __forceinline__ void visit_leaves(std::uint32_t group)
  {
    const std::uint32_t leaf = group * warp_size + lane_;
    const Device_box box = task_.tree.load(0, leaf);
    const float squared = squared_distance_to_packet(box);
    const bool is_own = leaf / leaves_in_packet == packet_;
    std::uint32_t key = (__float_as_uint(squared) & ~(warp_size - 1)) | lane_;
    if(leaf >= task_.tree.count[0] || is_own || __float_as_uint(squared) > reach_)
      key = no_index;
    if(!__any_sync(all_lanes, key != no_index))
      return;
    stage_box(box);
    for(;;) {
      const std::uint32_t nearest = warp_min(key), who = nearest % warp_size;
      if(nearest == no_index || nearest - who > reach_ || ++steps_ > most_steps)
        return;
      if(lane_ == who)
        key = no_index;
      if(!is_near_a_lane(who))
        continue;
      if(lane_ == std::uint32_t(picked_))
        pick_ = group * warp_size + who;
      if(++picked_ == int(leaves_in_packet))
        scan();
    }
  }

  __device__ __forceinline__ void finish_search()
  {
    if(picked_ > 0)
      scan();
    insert_pending(1);
    if(steps_ > most_steps)
      dropped_ = all_lanes;
  }

  // Compares the picked leaves with all queries.
  __device__ __forceinline__ void scan()
  {
    const std::uint32_t leaf = __shfl_sync(all_lanes, pick_, int(lane_ / leaf_points));
    const std::uint32_t index = leaf * leaf_points + lane_ % leaf_points;
    const bool is_point = int(lane_ / leaf_points) < picked_ && index < task_.n;
    const int slot = batches_ - first_pending_;
    stage(slot, is_point ? task_.point[index] : make_int4(x_, y_, z_, 0), is_point);
    picked_ = 0;
    const std::uint32_t near = near_points(slot);
    if(!__any_sync(all_lanes, near != 0))
      return;
    if(batches_ == most_batches) {
      steps_ = most_steps + 1;
      return;
    }
    if(lane_ < leaves_in_packet)
      memory_.search.leaf[std::uint32_t(batches_) * leaves_in_packet + lane_] = pick_;
    memory_.search.near[std::uint32_t(slot) * warp_size + lane_] = near;
    pending_ |= (near != 0 ? 1u : 0u) << slot;
    ++batches_;
    insert_pending(batches_ - first_pending_ < most_pending ? least_active : 1);
  }

  // Bit 31 - j: |p|^2 - 2pq + |q|^2 - limit < 0 for point j. The slack in the
  // squares is more than what is rounded, which may be much more than the limit.
  __device__ __forceinline__ std::uint32_t near_points(int slot) const
  {
    std::uint32_t near = 0;
#pragma unroll tests_at_once
    for(int j = 0; j < int(warp_size); ++j) {
      const float4& p = memory_.search.point[slot * int(warp_size) + j];
      const float d = fmaf(minus_2x_, p.x, fmaf(minus_2y_, p.y, fmaf(minus_2z_, p.z, p.w + threshold_)));
      near = __funnelshift_l(__float_as_uint(d), near, 1);
    }
    return near;
  }

  // Two candidates for each lane at a time, of whichever batch, while at least
  // `active` lanes have any: the others wait until more do.
  __device__ __forceinline__ void insert_pending(int active)
  {
    while(__popc(__ballot_sync(all_lanes, (near_ | pending_) != 0)) >= active) {
      if(near_ == 0 && pending_ != 0) {
        slot_ = __ffs(int(pending_)) - 1;
        pending_ &= pending_ - 1;
        near_ = memory_.search.near[std::uint32_t(slot_) * warp_size + lane_];
      }
      const std::uint32_t a = take_candidate(), b = take_candidate();
      insert(min(a, b), max(a, b));
    }
    if(active == 1)
      first_pending_ = batches_;
    update_limit();
  }

  // The key of the next point of slot_ that is near, no_index if there is none.
  __device__ __forceinline__ std::uint32_t take_candidate()
  {
    const int j = slot_ * int(warp_size) + __clz(int(near_)) % int(warp_size);
    const std::uint32_t tag = std::uint32_t(first_pending_) * warp_size + std::uint32_t(j);
    const std::uint32_t key = near_ != 0 ? make_key(squared_distance_to(j), tag) : no_index;
    near_ &= ~(0x80000000u >> (j % int(warp_size)));
    return key;
  }

  // a <= b.
  __device__ __forceinline__ void insert(std::uint32_t a, std::uint32_t b)
  {
#pragma unroll
    for(int i = list_size - 1; i > 1; --i)
      key_[i] = min(key_[i], min(max(key_[i - 1], a), max(key_[i - 2], b)));
    key_[1] = min(key_[1], min(max(key_[0], a), b));
    key_[0] = min(key_[0], a);
  }

  // The memory of the search is reused for the rows.
  __device__ __forceinline__ void write(bool is_answered)
  {
    __syncwarp();
    std::uint32_t index[K + 1];
#pragma unroll
    for(int i = 0; i <= K; ++i)
      index[i] = memory_.search.leaf[key_[i] % (1u << tag_bits) / leaf_points] * leaf_points + key_[i] % leaf_points;
    __syncwarp();
    std::uint32_t* row = memory_.row[lane_];
#pragma unroll
    for(int i = 0; i <= K; ++i)
      row[i] = index[i];
    if(is_answered)
      settle_order(row);
    __syncwarp();
    if(task_.k == K)
      write_whole_rows();
    else
      write_beginning_of_rows();
  }

  // Insertion sort of the entries whose keys are too close to those before them.
  __device__ __forceinline__ void settle_order(std::uint32_t* row) const
  {
    std::uint32_t unsure = 0;
#pragma unroll
    for(int i = 0; i < K; ++i)
      unsure |= (key_[i + 1] - key_[i] < key_margin ? 1u : 0u) << i;
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

  // Four entries at a time. Rows of dropped lanes are written as well; the search
  // for single queries runs later.
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
  std::uint32_t dropped_ = 0; // lanes whose answer is found in another way
  int x_, y_, z_;         // the middle of the packet, in grid steps
  float half_x_, half_y_, half_z_;
  float minus_2x_, minus_2y_, minus_2z_, squared_; // the query
  float scale_, unscale_, limit_, threshold_;
  std::uint32_t reach_;         // the largest limit of a lane, as bits
  std::uint32_t key_[list_size]; // the smallest, ascending
  int steps_ = 0;
  int batches_ = 0;             // with a candidate
  int first_pending_ = 0;       // of them
  std::uint32_t pending_ = 0;   // those of them with candidates of this lane, as bits
  std::uint32_t near_ = 0;      // the points of slot_ that are candidates
  int slot_ = 0;
  std::uint32_t pick_ = 0;      // lane i: the i-th leaf to be scanned
  int picked_ = 0;
};

template <int K>
__global__ void __launch_bounds__(warp_size, packets_in_processor) find_packet_neighbors(const __grid_constant__ Neighbor_task task)
{
  __shared__ Packet_memory<K> memory;
  Neighbor_packet<K>(task, memory, blockIdx.x).run();
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BACKEND_CUDA_NEIGHBOR_PACKET_CUH
