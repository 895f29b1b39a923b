// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sorted cloud with its neighbor graph, as all stages read it, and the position of its grid in space. After the
// preparation no stage changes it, but for estimated normals: near edges (choose_edge_sides.h), and those that points
// take from their surfels (exact_check.h).

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_CLOUD_H
#define CGAL_TANDEM_INTERNAL_CLOUD_CLOUD_H

#include <CGAL/Tandem/internal/base/planes.h>

namespace CGAL::Tandem::internal {

// Caller's coordinates = origin + step * grid coordinates. The step is a power of two, the origin a multiple of it. So
// a translation of the cloud by multiples of the step does not change the grid coordinates.
struct Grid {
  Vector origin = {0, 0, 0};
  double step = 1;
  bool is_coarse = false; // the step is larger than epsilon / 1024, because of the extent of the cloud
};

// The cells whose points are one surfel. Where points have tolerances of their own, cells are smaller in each octave.
struct Surfel_cells {
  double width_steps = 0; // of the largest ones; 0: each point is a surfel
  int octaves = 0;        // of smaller ones

  double smallest_width_steps() const { return std::ldexp(width_steps, -octaves); }
};

// The plane in the caller's coordinates, with the same normal. It is 0. - fma(...) and not -fma(...): where g++ fuses
// the negation, the sign of a zero would change.
inline Coefficients to_caller(const Regular_plane& p, const Grid& grid)
{
  return {p.normal.x, p.normal.y, p.normal.z, 0. - fused(grid.step, p.offset, dot(p.normal, grid.origin))};
}

// The same plane on the grid.
inline Regular_plane to_grid(const Coefficients& c, const Grid& grid)
{
  const Vector normal = {c[0], c[1], c[2]};
  return {normal, -(c[3] + dot(normal, grid.origin)) / grid.step};
}

// What the stages work on: surfels in the order of the curve, as points with a normal, and their neighbor graph. Tables
// have the same index throughout the engine, the position in this order. Rows of neighbors ascend by squared distance,
// then by position.
struct Cloud_view {
  const Grid_point* point;
  const std::uint32_t* neighbor; // k consecutive entries a surfel: positions in this order, no_index if none
  std::uint32_t size;
  int k;
  Surfels_view surfels;
  std::uint32_t ghosts = 0;            // of other ranks, which follow the own ones: see Ranks.h
  std::uint32_t first = 0;             // position of the first one in the cloud of all ranks, lower 32 bits
  std::uint32_t first_point = 0;       // the same of its first point
  const std::uint8_t* level = nullptr; // by surfel: that of its smallest tolerance; null: all have that of a detection

  CGAL_TANDEM_HD const std::uint32_t* row(std::uint32_t i) const { return neighbor + std::size_t(i) * std::size_t(k); }

  // f(table[q]) for the neighbors q of surfel i, in their order. A device waits for memory once for several of them.
  template <class T, class F>
  CGAL_TANDEM_HD void for_each_neighbor(std::uint32_t i, const T* table, F f) const
  {
    const std::uint32_t* const neighbors = row(i);
#ifdef __CUDA_ARCH__
    constexpr int together = 6;
    bool is_any = true; // there are no others behind the first that is none
    for(int first = 0; is_any && first < k; first += together) {
      std::uint32_t q[together];
      T item[together];
#pragma unroll
      for(int j = 0; j < together; ++j)
        q[j] = first + j < k ? neighbors[first + j] : no_index;
#pragma unroll
      for(int j = 0; j < together; ++j)
        item[j] = table[q[j] != no_index ? q[j] : i];
#pragma unroll
      for(int j = 0; j < together; ++j)
        if((is_any = is_any && q[j] != no_index))
          f(item[j]);
    }
#else
    for(int j = 0; j < k && neighbors[j] != no_index; ++j)
      f(table[neighbors[j]]);
#endif
  }

  CGAL_TANDEM_HD std::uint8_t level_of(std::uint32_t i) const { return level != nullptr ? level[i] : 0; }
  CGAL_TANDEM_HD Tolerance tolerance_of(std::uint32_t i, const Tolerance& most) const
  {
    return level != nullptr ? most.at(level[i]) : most;
  }
  CGAL_TANDEM_HD bool fits(const Plane& plane, std::uint32_t i, const Tolerance& most) const
  {
    return internal::fits(plane, point[i], tolerance_of(i, most));
  }
};

// Owns the tables of a Cloud_view, where the functors of the back end run: 16 + 4 k bytes a surfel, and 4 bytes a point,
// or 24 bytes where points and surfels differ.
template <class Backend>
struct Sorted_cloud {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  std::size_t number_of_surfels() const { return point.size() - ghosts; }
  std::size_t size_with_ghosts() const { return point.size(); }
  std::size_t number_of_points() const { return has_surfels() ? all_points.size() : number_of_surfels(); }
  bool has_surfels() const { return first_point.size() > 0; }

  Surfels_view surfels() const
  {
    return has_surfels() ? Surfels_view{all_points.data(), first_point.data(), surfel.data(), all_levels()}
                         : Surfels_view{point.data(), nullptr, nullptr, levels()};
  }

  Cloud_view view() const
  {
    return {point.data(),          neighbor.data(), std::uint32_t(number_of_surfels()),      k,       surfels(),
            std::uint32_t(ghosts), first,           has_surfels() ? first_of_points : first, levels()};
  }

  // Null where all points have the tolerance of the detection.
  const std::uint8_t* levels() const { return has_levels ? level.data() : nullptr; }
  const std::uint8_t* all_levels() const { return has_levels ? level_of_point.data() : nullptr; }

  Buffer<Grid_point> point;
  Buffer<std::uint32_t> neighbor;
  Buffer<std::uint32_t> order;                // by point: its position in the import
  Buffer<Grid_point> all_points;              // these three as in Surfels_view, ...
  Buffer<std::uint32_t> first_point, surfel;  // ... and empty without surfels
  bool has_levels = false;                    // points have tolerances of their own
  Buffer<std::uint8_t> level, level_of_point; // these by surfel and by point; the latter is empty without surfels
  int k = 0;
  std::size_t ghosts = 0; // these two as those of Cloud_view
  std::uint32_t first = 0, first_of_points = 0;
  double line_spacing_steps = 0; // from one scan line to the next; 0 without scan lines
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CLOUD_CLOUD_H
