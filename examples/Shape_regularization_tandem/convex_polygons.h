// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What CGAL::Kinetic_space_partition_3 takes: a convex polygon for each plane, no two of them coplanar.

#ifndef TANDEM_EXAMPLES_CONVEX_POLYGONS_H
#define TANDEM_EXAMPLES_CONVEX_POLYGONS_H

#include <CGAL/Shape_regularization_tandem/adapters.h>

#include <CGAL/convex_hull_2.h>

#include <cstddef>
#include <iterator>
#include <tuple>
#include <vector>

template <class Kernel>
struct Convex_polygons {
  std::vector<typename Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> corners; // of each polygon, positions in points
};

// The convex hull of the points of each plane.
template <class Kernel>
Convex_polygons<Kernel> convex_polygons(const std::vector<CGAL::Tandem::Point_with_plane<Kernel>>& items,
                                        const std::vector<typename Kernel::Plane_3>& planes)
{
  using Point_2 = typename Kernel::Point_2;
  std::vector<std::vector<Point_2>> members(planes.size());
  for(const auto& [point, normal, plane] : items)
    members[std::size_t(plane)].push_back(planes[std::size_t(plane)].to_2d(point));
  Convex_polygons<Kernel> polygons;
  for(std::size_t p = 0; p < planes.size(); ++p) {
    std::vector<Point_2> hull;
    CGAL::convex_hull_2(members[p].begin(), members[p].end(), std::back_inserter(hull));
    polygons.corners.emplace_back();
    for(const Point_2& corner : hull) {
      polygons.corners.back().push_back(polygons.points.size());
      polygons.points.push_back(planes[p].to_3d(corner));
    }
  }
  return polygons;
}

#endif // TANDEM_EXAMPLES_CONVEX_POLYGONS_H
