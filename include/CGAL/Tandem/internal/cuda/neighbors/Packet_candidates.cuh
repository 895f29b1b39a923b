// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the lanes of a packet have found so far. Each lane has the smallest keys of its own query in registers; points
// come in batches of 32.
//
// Why no neighbor is lost, with u = 2^-24. The coordinates of the lanes are below 2^22, so they are exact. Those of a
// candidate are exact below 2^24. Beyond, they are off by a factor of 1 + u, where the difference is at least 3/4 of
// them. So squared distances are off by a factor of at most 1 + 12u. A key is a squared distance in units in which all
// that matter are below 2^22, hence off by 3.5 units. Keys that differ by key_margin are in the right order. A point
// beyond the K-th key and limit_margin is no neighbor.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_PACKET_CANDIDATES_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_PACKET_CANDIDATES_CUH

#include <CGAL/Tandem/internal/cuda/neighbors/Neighbor_task.cuh>

#include <cstdint>

namespace CGAL::Tandem::internal {

// --- Batcher's odd-even merge sort of an array in registers: all indices are constants of the compilation. The compiler
// removes the comparisons of results that are not used.

// Puts the smaller of two numbers first.
__device__ __forceinline__ void order(std::uint32_t& a, std::uint32_t& b)
{
  const std::uint32_t smaller = min(a, b);
  b = max(a, b);
  a = smaller;
}

// Merges the sorted halves of every Step-th entry of a[First .. First + Size).
template <int First, int Size, int Step, int N>
__device__ __forceinline__ void merge_odd_even(std::uint32_t (&a)[N])
{
  if constexpr(2 * Step < Size) {
    merge_odd_even<First, Size, 2 * Step>(a);
    merge_odd_even<First + Step, Size, 2 * Step>(a);
#pragma unroll
    for(int i = First + Step; i + Step < First + Size; i += 2 * Step)
      order(a[i], a[i + Step]);
  } else {
    order(a[First], a[First + Step]);
  }
}

// Sorts a[First .. First + Size); Size is a power of two.
template <int First, int Size, int N>
__device__ __forceinline__ void sort_odd_even(std::uint32_t (&a)[N])
{
  if constexpr(Size > 1) {
    sort_odd_even<First, Size / 2>(a);
    sort_odd_even<First + Size / 2, Size / 2>(a);
    merge_odd_even<First, Size, 1>(a);
  }
}

// --- The frame in which a packet is searched in float: relative to the middle of the box of its 32 queries. There,
// coordinates are small, so float is exact or nearly exact.

constexpr float far_away = 0x1p126f; // twice of it is finite

// A box by its center and half of its size, in two parts for wide loads.
struct Centered_box {
  float4 center_and_x; // half of the size in x
  float2 yz;           // and in y, z
};

// All lanes of the warp have the same frame.
class Packet_frame {
public:
  // From one query of each lane; all 32 lanes take part.
  __device__ __forceinline__ void set(const int4& q)
  {
    const int low_x = warp_min(q.x), low_y = warp_min(q.y), low_z = warp_min(q.z);
    const int high_x = warp_max(q.x), high_y = warp_max(q.y), high_z = warp_max(q.z);
    x_ = low_x + (high_x - low_x) / 2;
    y_ = low_y + (high_y - low_y) / 2;
    z_ = low_z + (high_z - low_z) / 2;
    half_x_ = float(high_x - x_);
    half_y_ = float(high_y - y_);
    half_z_ = float(high_z - z_);
  }

  // Whether the queries are exact in float, with room for the differences.
  __device__ __forceinline__ bool is_narrow() const { return fmaxf(half_x_, fmaxf(half_y_, half_z_)) < largest_exact; }

  // Of the box of the queries, from its middle to a corner.
  __device__ __forceinline__ float squared_radius() const
  {
    return half_x_ * half_x_ + half_y_ * half_y_ + half_z_ * half_z_;
  }

  __device__ __forceinline__ int4 middle() const { return make_int4(x_, y_, z_, 0); }

  // Differences are integers, rounded once to float. The last component is for the square.
  __device__ __forceinline__ float4 relative(const int4& p) const
  {
    return make_float4(float(p.x - x_), float(p.y - y_), float(p.z - z_), 0);
  }

  // Between the box of the queries and another one, rounded by less than limit_margin. Every lane of the packet is at
  // least as far from the points of that box.
  __device__ __forceinline__ float squared_distance_to(const Device_box& b) const
  {
    const float x = fmaxf(float(max(b.low[0] - x_, x_ - b.high[0])) - half_x_, 0);
    const float y = fmaxf(float(max(b.low[1] - y_, y_ - b.high[1])) - half_y_, 0);
    const float z = fmaxf(float(max(b.low[2] - z_, z_ - b.high[2])) - half_z_, 0);
    return fmaf(x, x, fmaf(y, y, z * z));
  }

  // Boxes whose bounds float may not represent get an infinite size, so that they are never pruned.
  __device__ __forceinline__ Centered_box centered(const Device_box& b) const
  {
    const float low_x = float(b.low[0] - x_), low_y = float(b.low[1] - y_), low_z = float(b.low[2] - z_);
    const float high_x = float(b.high[0] - x_), high_y = float(b.high[1] - y_), high_z = float(b.high[2] - z_);
    const float highest = fmaxf(fmaxf(fmaxf(-low_x, high_x), fmaxf(-low_y, high_y)), fmaxf(-low_z, high_z));
    const float lowest = fminf(fminf(fminf(-low_x, high_x), fminf(-low_y, high_y)), fminf(-low_z, high_z));
    const float extra = fmaxf(highest, -lowest) < largest_exact ? 0 : far_away;
    return {make_float4(0.5f * (low_x + high_x), 0.5f * (low_y + high_y), 0.5f * (low_z + high_z),
                        0.5f * (high_x - low_x) + extra),
            make_float2(0.5f * (high_y - low_y) + extra, 0.5f * (high_z - low_z) + extra)};
  }

private:
  static constexpr float largest_exact = 0x1p22f; // sums of two of these are exact, too

  int x_, y_, z_;
  float half_x_, half_y_, half_z_;
};

// Batches with a candidate; a packet that needs more is searched in another way.
constexpr int maximum_batches = 32;
// Batches among them whose candidates are not in the lists yet.
constexpr int maximum_pending = 4;
// The lower bits of a key: batch and place in it, of 32 each.
constexpr int tag_bits = 10;
// The margins of the argument above; the second one is in units of a key without its tag.
constexpr std::uint32_t key_margin = 9u << tag_bits;
constexpr std::uint32_t limit_margin = 12;

// Shared memory of one warp. Points of pending batches are kept until their candidates are in the lists.
struct Candidate_memory {
  float4 point[maximum_pending * warp_size];                 // relative; in w the square
  std::uint32_t near[maximum_pending * warp_size];           // of a batch, for each lane: its candidates
  std::uint32_t bucket[maximum_batches * buckets_in_packet]; // of each batch, for the indices of its points
};

// The candidates of one packet for rows of K neighbors. All members are called by the whole warp. List and limits are
// those of a lane, batches those of the warp.
template <int K>
class Packet_candidates {
public:
  __device__ __forceinline__ explicit Packet_candidates(Candidate_memory& memory)
    : memory_(memory), lane_(threadIdx.x % warp_size)
  {}

  // The queries are the first batch: four buckets from first_bucket on. They give each lane a first limit.
  __device__ __forceinline__ void start(const float4& query, std::uint32_t first_bucket)
  {
    const float4 p = stage(0, query, true);
    minus_2x_ = -2 * p.x;
    minus_2y_ = -2 * p.y;
    minus_2z_ = -2 * p.z;
    squared_ = p.w;
    if(lane_ < buckets_in_packet)
      memory_.bucket[lane_] = first_bucket + lane_;
    sort_own_points();
  }

  // A squared distance: points beyond it are no neighbors of this lane. It only falls.
  __device__ __forceinline__ float limit() const { return limit_; }

  // This lane takes no further candidates; its row is left to the search for single queries.
  __device__ __forceinline__ void drop()
  {
    is_dropped_ = true;
    update_limit();
  }

  // There were more batches than tags; the lists have lost candidates.
  __device__ __forceinline__ bool is_full() const { return batches_ > maximum_batches; }

  // Whether a box may have a neighbor of this lane.
  __device__ __forceinline__ bool is_near(const float4& center_and_x, const float2& yz) const
  {
    const float x = fmaxf(fabsf(fmaf(0.5f, minus_2x_, center_and_x.x)) - center_and_x.w, 0);
    const float y = fmaxf(fabsf(fmaf(0.5f, minus_2y_, center_and_x.y)) - yz.x, 0);
    const float z = fmaxf(fabsf(fmaf(0.5f, minus_2z_, center_and_x.z)) - yz.y, 0);
    return fmaf(x, x, fmaf(y, y, z * z)) <= limit_;
  }

  // Compares one point of each lane with all queries. `bucket`: lane i has the i-th bucket of the batch. A batch
  // without a candidate takes no tag. Candidates are inserted when enough lanes have some, or when no further batch can
  // be pending.
  __device__ __forceinline__ void add_batch(const float4& point, bool is_point, std::uint32_t bucket)
  {
    const int slot = batches_ - first_pending_;
    stage(slot, point, is_point);
    const std::uint32_t near = near_points(slot);
    if(!__any_sync(all_lanes, near != 0))
      return;
    if(batches_ >= maximum_batches) {
      batches_ = first_pending_ = maximum_batches + 1;
      pending_ = near_ = 0;
      return;
    }
    if(lane_ < buckets_in_packet)
      memory_.bucket[std::uint32_t(batches_) * buckets_in_packet + lane_] = bucket;
    memory_.near[std::uint32_t(slot) * warp_size + lane_] = near;
    pending_ |= (near != 0 ? 1u : 0u) << slot;
    ++batches_;
    insert_pending(batches_ - first_pending_ < maximum_pending ? minimum_active : 1);
  }

  // Inserts all candidates that are still pending.
  __device__ __forceinline__ void finish() { insert_pending(1); }

  // Whether every point outside of the list is farther than the K nearest, by the margins. Else integers have to
  // decide.
  __device__ __forceinline__ bool is_certain() const
  {
    return !is_dropped_ && key_[list_size - 1] - key_[K - 1] >= key_margin;
  }

  // Bit i: the order of entries i and i + 1 is not certain.
  __device__ __forceinline__ std::uint32_t uncertain_order() const
  {
    std::uint32_t bits = 0;
#pragma unroll
    for(int i = 0; i < K; ++i)
      bits |= (key_[i + 1] - key_[i] < key_margin ? 1u : 0u) << i;
    return bits;
  }

  // The position in the sorted cloud of entry i, from its tag.
  __device__ __forceinline__ std::uint32_t index(int i) const
  {
    return memory_.bucket[key_[i] % (1u << tag_bits) / bucket_points] * bucket_points + key_[i] % bucket_points;
  }

private:
  static constexpr int list_size = K + 2;      // K, a tie, and one more that shows whether there are others
  static constexpr int minimum_active = 4;     // lanes with candidates, below which insertion waits
  static constexpr float half_range = 0x1p21f; // of a key without its tag
  static constexpr float slack = 0x1p-20f;     // 16u, see near_points()

  // Puts one point of each lane where all lanes can read it. The square is made smaller by the slack, so that no test
  // misses a candidate.
  __device__ __forceinline__ float4 stage(int slot, float4 p, bool is_point)
  {
    p.w = is_point ? fmaf(p.x, p.x, fmaf(p.y, p.y, p.z * p.z)) * (1 - slack) : far_away;
    __syncwarp();
    memory_.point[std::uint32_t(slot) * warp_size + lane_] = p;
    __syncwarp();
    return p;
  }

  // From the query of this lane to a staged point.
  __device__ __forceinline__ float squared_distance_to(int j) const
  {
    const float4& p = memory_.point[j];
    const float dx = fmaf(0.5f, minus_2x_, p.x), dy = fmaf(0.5f, minus_2y_, p.y), dz = fmaf(0.5f, minus_2z_, p.z);
    return fmaf(dx, dx, fmaf(dy, dy, dz * dz));
  }

  // Adding 2^23 rounds to an integer, which is then in the low bits of the float.
  __device__ __forceinline__ std::uint32_t make_key(float squared, std::uint32_t tag) const
  {
    return __float_as_uint(fmaf(squared, scale_, 0x1p23f)) << tag_bits | tag;
  }

  // The other queries of the packet are the first list. Their bound fixes the unit of the keys, which then have 21 bits
  // up to it. Farther ones are clamped to 1.5 times the bound: they stay behind all that matter.
  __device__ __forceinline__ void sort_own_points()
  {
    float squared[warp_size];
#pragma unroll
    for(int j = 0; j < int(warp_size); ++j)
      squared[j] = squared_distance_to(j);
    const float bound = fmaxf(bound_by_own_buckets(squared), 1);
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

  // A squared distance within which the packet's own buckets have K points besides the query. For each bucket the
  // farthest point counts, and as many buckets as K points need are taken, nearest first.
  __device__ __forceinline__ static float bound_by_own_buckets(const float (&squared)[warp_size])
  {
    static_assert(buckets_in_packet == 4 && K + 1 <= int(warp_size), "see below");
    float farthest[buckets_in_packet];
#pragma unroll
    for(int i = 0; i < int(buckets_in_packet); ++i) {
      farthest[i] = squared[i * int(bucket_points)];
#pragma unroll
      for(int j = 1; j < int(bucket_points); ++j)
        farthest[i] = fmaxf(farthest[i], squared[i * int(bucket_points) + j]);
    }
    const float a = fminf(farthest[0], farthest[1]), b = fmaxf(farthest[0], farthest[1]);
    const float c = fminf(farthest[2], farthest[3]), d = fmaxf(farthest[2], farthest[3]);
    constexpr int needed = (K + int(bucket_points)) / int(bucket_points);
    return needed == 1   ? fminf(a, c)
           : needed == 2 ? fminf(fmaxf(a, c), fminf(b, d))
           : needed == 3 ? fmaxf(fmaxf(a, c), fminf(b, d))
                         : fmaxf(b, d);
  }

  // After changes of the list: the distance of the K-th key and the margin.
  __device__ __forceinline__ void update_limit()
  {
    limit_ = is_dropped_ ? -far_away : float((key_[K - 1] >> tag_bits) + limit_margin) * unscale_;
    threshold_ = squared_ - limit_;
  }

  // Bit 31 - j: |p|^2 - 2pq + |q|^2 - limit < 0 for point j. The slack in the
  // squares is more than what is rounded, which may be much more than the limit.
  __device__ __forceinline__ std::uint32_t near_points(int slot) const
  {
    std::uint32_t near = 0;
#pragma unroll
    for(int j = 0; j < int(warp_size); ++j) {
      const float4& p = memory_.point[slot * int(warp_size) + j];
      const float d = fmaf(minus_2x_, p.x, fmaf(minus_2y_, p.y, fmaf(minus_2z_, p.z, p.w + threshold_)));
      near = __funnelshift_l(__float_as_uint(d), near, 1);
    }
    return near;
  }

  // Two candidates for each lane at a time, of whichever batch, while at least `active` lanes have any. The remaining
  // ones wait until more lanes have some.
  __device__ __forceinline__ void insert_pending(int active)
  {
    while(__popc(__ballot_sync(all_lanes, (near_ | pending_) != 0)) >= active) {
      if(near_ == 0 && pending_ != 0) {
        slot_ = __ffs(int(pending_)) - 1;
        pending_ &= pending_ - 1;
        near_ = memory_.near[std::uint32_t(slot_) * warp_size + lane_];
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

  // Inserts two keys, a <= b, at once; those that fall off the end are lost. No branches, and all indices are
  // constants, so the list stays in registers.
  __device__ __forceinline__ void insert(std::uint32_t a, std::uint32_t b)
  {
#pragma unroll
    for(int i = list_size - 1; i > 1; --i)
      key_[i] = min(key_[i], min(max(key_[i - 1], a), max(key_[i - 2], b)));
    key_[1] = min(key_[1], min(max(key_[0], a), b));
    key_[0] = min(key_[0], a);
  }

  Candidate_memory& memory_;
  std::uint32_t lane_;
  float minus_2x_, minus_2y_, minus_2z_, squared_; // the query
  float scale_, unscale_, limit_, threshold_;
  std::uint32_t key_[list_size]; // ascending
  bool is_dropped_ = false;
  int batches_ = 0, first_pending_ = 0;
  std::uint32_t pending_ = 0; // bit i: batch first_pending_ + i has candidates of this lane
  std::uint32_t near_ = 0;    // those of slot_ that are not in the list yet
  int slot_ = 0;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_PACKET_CANDIDATES_CUH
