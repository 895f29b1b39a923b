// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What CGAL::Kinetic_space_partition_3 takes: a convex polygon for each plane, no two of them coplanar.

#ifndef TANDEM_EXAMPLES_CONVEX_POLYGONS_H
#define TANDEM_EXAMPLES_CONVEX_POLYGONS_H

#include <CGAL/Shape_regularization_tandem/adapters.h>

#include <CGAL/Bbox_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <vector>

template <class Kernel>
struct Convex_polygons {
  std::vector<typename Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> corners; // of each polygon, positions in points
  std::vector<std::size_t> planes;               // of each polygon
};

// Points on a line have none but for rounding, and they define no plane.
template <class Kernel>
bool has_area(const std::vector<typename Kernel::Point_2>& hull)
{
  constexpr double smallest_fraction = 1e-6; // of the square of the extent
  if(hull.size() < 3)
    return false;
  const CGAL::Bbox_2 box = CGAL::bbox_2(hull.begin(), hull.end());
  const double extent = (std::max)(box.xmax() - box.xmin(), box.ymax() - box.ymin());
  return CGAL::polygon_area_2(hull.begin(), hull.end(), Kernel()) > smallest_fraction * extent * extent;
}

// The convex hull of the points of each plane. Planes whose hull has no area are left out.
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
    if(!has_area<Kernel>(hull))
      continue;
    polygons.planes.push_back(p);
    polygons.corners.emplace_back();
    for(const Point_2& corner : hull) {
      polygons.corners.back().push_back(polygons.points.size());
      polygons.points.push_back(planes[p].to_3d(corner));
    }
  }
  return polygons;
}

#endif // TANDEM_EXAMPLES_CONVEX_POLYGONS_H
