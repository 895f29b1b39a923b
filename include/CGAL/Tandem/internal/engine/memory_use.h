// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bytes on the host, and a point on a device: of the tables of the size of the cloud. For the statistics, and for the
// number of points that fit a device. Tables of shapes are not included.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_MEMORY_USE_H
#define CGAL_TANDEM_INTERNAL_ENGINE_MEMORY_USE_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/cloud/Import.h>

namespace CGAL::Tandem::internal {

// Bytes of a surfel, with its row of neighbors; and of a point that is not itself one: on the grid, its surfel, and its
// place among the points of that.
inline std::size_t surfel_bytes(std::size_t k) { return sizeof(Grid_point) + k * sizeof(std::uint32_t); }
constexpr std::size_t member_bytes = sizeof(Grid_point) + 2 * sizeof(std::uint32_t);

// Bytes on the host, in the stage where they are most: in the estimation of normals, or in the end game if normals are
// given. The imported coordinates and normals are included, the caller's range is not.
template <class Backend>
std::size_t host_bytes(const Sorted_cloud<Backend>& cloud, const Import& in)
{
  constexpr std::size_t labels = sizeof(std::uint32_t) + 1;   // and states
  constexpr std::size_t end_game = 6 * sizeof(std::uint32_t); // components, and the tables of an Assignment
  constexpr std::size_t neighborhoods = 100;                  // of estimate_normals()
  const std::size_t level = in.has_tolerances ? 1 : 0;
  return in.size() * (in.value_bytes() + 2 * sizeof(std::uint32_t) + level + (cloud.has_surfels() ? member_bytes : 0)) +
         cloud.number_of_surfels() *
           (surfel_bytes(std::size_t(cloud.k)) + level + (in.has_normals ? labels + end_game : neighborhoods));
}

// Bytes of a point on a device, in the stage where they are most: the tests of planes, or the grouping of points with
// keys of 32 bits. Small cells cost more a point, as the tables of a cell do not depend on its points. How many surfels
// there will be is not known, so each point counts as one.
inline std::size_t device_bytes_per_point(const Parameters& p, bool has_normals)
{
  constexpr std::size_t cell = 3584;                // lists, links, sums of new shapes
  const std::size_t cells = 4 * cell / p.cell_size; // many are far from full
  constexpr std::size_t levels = 2;                 // of tolerances, whether there are any or not
  return surfel_bytes(p.k_neighbors) + levels + sizeof(std::uint32_t) + (p.surfel_size > 0 ? member_bytes : 0) +
         (has_normals ? 34 : 112) + cells + 1;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_MEMORY_USE_H
