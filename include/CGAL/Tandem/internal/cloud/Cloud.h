// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine's view of a point cloud, and how its grid lies in the caller's space.

#ifndef CGAL_TANDEM_INTERNAL_CLOUD_CLOUD_H
#define CGAL_TANDEM_INTERNAL_CLOUD_CLOUD_H

#include <CGAL/Tandem/internal/base/planes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// caller = origin + step * grid. The step is a power of two, the origin a
// multiple of it, so that moving a cloud by multiples of the step does not
// change the grid coordinates.
struct Grid {
  Vector origin = {0, 0, 0};
  double step = 1;
  bool is_coarse = false; // the step is larger than epsilon / 1024, because of the extent of the cloud
};

// Not -fma(...): g++ makes one instruction of it, and has the other zero than without that.
inline Coefficients to_caller(const Regular_plane& p, const Grid& grid)
{
  return {p.normal.x, p.normal.y, p.normal.z, 0. - std::fma(grid.step, p.offset, dot(p.normal, grid.origin))};
}

// Points in the order of the curve. All arrays are parallel.
struct Cloud_view {
  const Grid_point* point;
  const std::uint32_t* neighbor; // k consecutive entries a point: positions in this order, no_index if none
  std::uint32_t size;
  int k;

  CGAL_TANDEM_HD const std::uint32_t* row(std::uint32_t i) const { return neighbor + std::size_t(i) * std::size_t(k); }
};

// The sorted cloud: owns what a Cloud_view shows.
template <class Backend>
struct Sorted_cloud {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  std::size_t size() const { return point.size(); }

  Cloud_view view() const { return {point.data(), neighbor.data(), std::uint32_t(point.size()), k}; }

  Buffer<Grid_point> point;
  Buffer<std::uint32_t> neighbor;
  Buffer<std::uint32_t> order; // the imported point of each one
  int k = 0;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CLOUD_CLOUD_H
