// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bytes a point, on the host and on a device: of the tables of the size of the cloud. For the statistics, and for the
// number of points that fit a device. Tables of shapes are not included.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_MEMORY_USE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_MEMORY_USE_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/cloud/Import.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Bytes of a point of the sorted cloud: point, place of the imported one, neighbors.
inline std::size_t cloud_bytes_per_point(std::size_t k) { return sizeof(Grid_point) + (k + 1) * sizeof(std::uint32_t); }

// Bytes of a point on the host, in the stage where they are most: in the estimation of normals, or in the end game if
// normals are given. The imported coordinates and normals are included, the caller's range is not.
inline std::size_t host_bytes_per_point(int k, const Import& in)
{
  constexpr std::size_t labels = 2 * sizeof(std::uint32_t) + 1; // and seeds, states
  constexpr std::size_t end_game = sizeof(std::uint64_t) + 5 * sizeof(std::uint32_t);
  constexpr std::size_t neighborhoods = 100; // of estimate_normals()
  return in.value_bytes() + cloud_bytes_per_point(std::size_t(k)) +
         (in.has_normals ? labels + end_game : neighborhoods);
}

// Bytes of a point on a device, in the stage where they are most: the tests of planes, or the grouping of points with
// keys of 32 bits. Small cells cost more a point, as the tables of a cell do not depend on its points.
inline std::size_t device_bytes_per_point(const Parameters& p, bool has_normals)
{
  constexpr std::size_t cell = 3584;                // lists, links, sums of new shapes
  const std::size_t cells = 4 * cell / p.cell_size; // many are far from full
  return cloud_bytes_per_point(p.k_neighbors) + (has_normals ? 34 : 108) + cells + 1;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_MEMORY_USE_H
