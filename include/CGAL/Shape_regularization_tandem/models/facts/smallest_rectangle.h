// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rectangle of smallest area around points of a plane.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SMALLEST_RECTANGLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SMALLEST_RECTANGLE_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace facts {

using Flat_point = outlines::Kernel::Point_2;
using Flat_vector = outlines::Kernel::Vector_2;

struct Rectangle_sides {
  double length = 0, width = 0; // length >= width
};

// The corner of a convex polygon, counterclockwise, that is farthest in a direction. The directions that it is asked for
// turn counterclockwise, once around, so that all questions together take one round of the polygon.
class Farthest_corner {
public:
  Farthest_corner(const std::vector<Flat_point>& polygon, const Flat_vector& direction) : polygon(polygon)
  {
    for(std::size_t i = 1; i < polygon.size(); ++i)
      if((polygon[i] - polygon[corner]) * direction > 0)
        corner = i;
  }

  const Flat_point& operator()(const Flat_vector& direction)
  {
    for(std::size_t step = 0; step < polygon.size(); ++step) {
      const std::size_t next = (corner + 1) % polygon.size();
      if(!((polygon[next] - polygon[corner]) * direction > 0))
        break;
      corner = next;
    }
    return polygon[corner];
  }

private:
  const std::vector<Flat_point>& polygon;
  std::size_t corner = 0;
};

// The smallest rectangle has a side on an edge of the convex hull. Of points on a line, the width is 0.
inline Rectangle_sides smallest_rectangle(const std::vector<Flat_point>& points)
{
  std::vector<Flat_point> hull;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(hull));
  Rectangle_sides best;
  if(hull.size() < 2)
    return best;
  const Flat_vector first = hull[1] - hull[0], left = first.perpendicular(CGAL::COUNTERCLOCKWISE);
  Farthest_corner front(hull, first), opposite(hull, left), back(hull, -first);
  for(std::size_t i = 0; i < hull.size(); ++i) {
    const Flat_vector edge = hull[(i + 1) % hull.size()] - hull[i];
    const Flat_vector u = edge / std::hypot(edge.x(), edge.y()), v = u.perpendicular(CGAL::COUNTERCLOCKWISE);
    const double along = (front(u) - back(-u)) * u, across = (std::max)((opposite(v) - hull[i]) * v, 0.);
    if(i == 0 || along * across < best.length * best.width)
      best = {along, across};
  }
  if(best.length < best.width)
    std::swap(best.length, best.width);
  return best;
}

} // namespace facts
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SMALLEST_RECTANGLE_H
