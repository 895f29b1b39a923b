// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The frame in which a packet is searched in float: relative to the middle of the box of its 32 queries. There,
// coordinates are small, so float is exact or nearly exact.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_PACKET_FRAME_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_PACKET_FRAME_CUH

#include <CGAL/Tandem/internal/cuda/neighbors/Box_levels.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_NEIGHBORS_PACKET_FRAME_CUH
