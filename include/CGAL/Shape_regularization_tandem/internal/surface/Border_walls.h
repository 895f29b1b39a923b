// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls that no point covers, as in airborne scans: where a shape ends with another one below its border, a plane goes
// straight down from there.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_BORDER_WALLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_BORDER_WALLS_H

#include <CGAL/Shape_regularization_tandem/internal/surface/Plane_coverage.h>
#include <CGAL/Shape_regularization_tandem/internal/outlines/Polygon_parts.h>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Border_walls {
public:
  Border_walls(const std::vector<Plane_coverage>& planes, const Vector& up, double maximum_distance)
    : planes_(planes), up_(up), near_(2 * maximum_distance)
  {}

  // Of these polygons, each of which has a plane of its own: at most so many, from long borders to short ones.
  std::vector<Plane_coverage> of(const outlines::Polygon_table& polygons, const std::vector<Coefficients>& planes,
                                 std::size_t most) const
  {
    std::vector<Border> borders;
    for(std::size_t s = 0; s < polygons.polygons.size(); ++s)
      if(!is_upright(planes[s]))
        for(const Indexed_polygon& polygon : polygons.polygons[s])
          add_borders(polygons, polygon, planes[s], borders);
    std::stable_sort(borders.begin(), borders.end(),
                     [](const Border& a, const Border& b) { return a.length > b.length; });
    std::vector<Wall> walls;
    for(const Border& border : borders)
      add_to(walls, border, most);
    std::vector<Plane_coverage> result;
    for(const Wall& wall : walls)
      result.push_back(Plane_coverage::without_points(wall.plane, wall.corners));
    return result;
  }

private:
  struct Border {
    Point first, last;
    double drop;   // to the plane below
    double length; // seen from above
  };
  struct Wall {
    Coefficients plane;
    std::vector<Point> corners;
  };

  static double height(const Coefficients& c, const Point& p)
  {
    return c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3];
  }

  // Within 15 degrees.
  bool is_upright(const Coefficients& c) const { return std::fabs(Vector(c[0], c[1], c[2]) * up_) < .26; }
  bool is_near(const Coefficients& c, const Border& b) const
  {
    return std::fabs(height(c, b.first)) < near_ && std::fabs(height(c, b.last)) < near_;
  }

  void add_borders(const outlines::Polygon_table& polygons, const Indexed_polygon& polygon, const Coefficients& own,
                   std::vector<Border>& borders) const
  {
    const auto point = [&](std::uint32_t i) {
      const auto& p = polygons.points[i];
      return Point(p[0], p[1], p[2]);
    };
    Vector area = CGAL::NULL_VECTOR;
    for(const auto& t : polygon.triangles)
      area = area + CGAL::cross_product(point(t[1]) - point(t[0]), point(t[2]) - point(t[0]));
    const Vector left = (area * up_ > 0 ? 1 : -1) * up_; // the polygon is on the left side of its edges
    const auto add = [&](const auto& loop) {
      for(std::size_t i = 0; i < loop.size(); ++i) {
        Border border = {point(loop[i]), point(loop[(i + 1) % loop.size()]), 0, 0};
        const Vector outward = CGAL::cross_product(border.last - border.first, left);
        border.length = std::sqrt(outward.squared_length());
        if(border.length < 5 * near_ || ends_at_other(own, border))
          continue;
        border.drop = drop_at(CGAL::midpoint(border.first, border.last) + near_ / border.length * outward);
        if(border.drop > 0)
          borders.push_back(border);
      }
    };
    add(polygon.outer);
    for(const auto& hole : polygon.holes)
      add(hole);
  }

  bool ends_at_other(const Coefficients& own, const Border& border) const
  {
    return std::any_of(planes_.begin(), planes_.end(),
                       [&](const Plane_coverage& p) { return p.plane() != own && is_near(p.plane(), border); });
  }

  // To the lowest plane that is below a point; 0 if there is none.
  double drop_at(const Point& p) const
  {
    double result = 0;
    for(const Plane_coverage& plane : planes_) {
      const Coefficients& c = plane.plane();
      if(is_upright(c))
        continue;
      const double drop = height(c, p) / (Vector(c[0], c[1], c[2]) * up_);
      if(drop > near_ && drop > result && plane.is_in_hull(p - drop * up_))
        result = drop;
    }
    return result;
  }

  // To a wall in the same plane, if there is one.
  void add_to(std::vector<Wall>& walls, const Border& border, std::size_t most) const
  {
    auto wall = std::find_if(walls.begin(), walls.end(), [&](const Wall& w) { return is_near(w.plane, border); });
    if(wall == walls.end()) {
      if(walls.size() == most)
        return;
      const Vector normal = CGAL::cross_product(border.last - border.first, up_) / border.length;
      const double offset = -(normal * (CGAL::midpoint(border.first, border.last) - CGAL::ORIGIN));
      wall = walls.insert(walls.end(), Wall{{normal.x(), normal.y(), normal.z(), offset}, {}});
    }
    for(const Point& p : {border.first, border.last}) {
      wall->corners.push_back(p);
      wall->corners.push_back(p - border.drop * up_);
    }
  }

  const std::vector<Plane_coverage>& planes_;
  Vector up_;
  double near_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_SURFACE_BORDER_WALLS_H
