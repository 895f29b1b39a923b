// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neighbor graph on which shapes grow, and by which a result is checked: of surfels, on both sides of thin walls
// apart. Fills the rows of the cloud, with ghosts, and joins surfels. See the manual, "Surfels" and
// "Sides of Walls".

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_CONNECT_CLOUD_H
#define CGAL_TANDEM_INTERNAL_ENGINE_CONNECT_CLOUD_H

#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>
#include <CGAL/Tandem/internal/neighbors/join_surfels.h>
#include <CGAL/Tandem/internal/neighbors/keep_to_sides.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Writes the rows of neighbors. meanwhile() is called while a device searches.
template <class Backend, class Meanwhile = Nothing>
void find_rows(Labeled_cloud<Backend>& points, int rings, Meanwhile meanwhile = Meanwhile())
{
  Sorted_cloud<Backend>& cloud = points.cloud;
  cloud.neighbor.reset(cloud.size() * std::size_t(cloud.k));
  find_neighbors(points.backend, cloud.point.data(), std::uint32_t(cloud.size()), cloud.k, cloud.neighbor.data());
  meanwhile();
  points.ranks.connect(cloud, rings);
}

// The points have been sorted, and cloud.k is set. The values that a device has are dropped.
template <class Backend>
void connect_cloud(Labeled_cloud<Backend>& points, Import& in, const Tolerance& tight)
{
  const int rings = in.has_normals ? 1 : 3;            // normals are estimated from neighbors of neighbors
  find_rows(points, rings, [&] { in.drop_upload(); }); // the values come back while a device searches
  if(join_surfels(points.backend, points.ranks, points.cloud, points.cells, in.surfel_cells))
    find_rows(points, rings);
  if(in.has_normals)
    keep_to_sides(points.backend, points.ranks, points.cloud, tight);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_CONNECT_CLOUD_H
