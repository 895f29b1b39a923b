// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The number of points that are far from the plane that they belong to.

#ifndef TANDEM_EXAMPLES_FAR_POINTS_H
#define TANDEM_EXAMPLES_FAR_POINTS_H

#include "house_cloud.h"

#include <cstddef>
#include <vector>

// index_map: the position of the plane of each point, -1 for none.
template <class Planes, class Plane_map, class Index_map>
std::size_t number_of_far_points(const std::vector<house::Point_with_normal>& points, const Planes& planes,
                                 const Plane_map& plane_map, const Index_map& index_map)
{
  std::size_t count = 0;
  for(std::size_t i = 0; i < points.size(); ++i)
    if(get(index_map, i) >= 0) {
      const house::Kernel::Plane_3 plane = get(plane_map, *(planes.begin() + get(index_map, i)));
      count += CGAL::squared_distance(points[i].first, plane) > .05 * .05;
    }
  return count;
}

#endif // TANDEM_EXAMPLES_FAR_POINTS_H
