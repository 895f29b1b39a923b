// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walls that no point covers, as in airborne scans: where a shape ends with another one below its border, a wall is assumed
// to go straight down from there.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_BORDER_WALLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_BORDER_WALLS_H

#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Point_blocks.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Ray_votes.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Site.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// What surfaces are made of. Lengths are in a unit of about the largest coordinate.
struct Surface_scene {
  const std::vector<Position>& points; // in units of the caller
  const outlines::Shapes& shapes;
  outlines::Unit unit;
  double maximum_distance;
  outlines::Polygon_table polygons; // the outlines of shapes
  std::vector<Coefficients> planes; // of shapes

  Surface_scene(const std::vector<Position>& points, const outlines::Shapes& shapes, outlines::Polygon_table polygons)
    : points(points), shapes(shapes), unit(points, shapes),
      maximum_distance(unit.in(shapes.parameters().maximum_distance)), polygons(std::move(polygons))
  {
    for(Position& p : this->polygons.points)
      for(double& x : p)
        x = unit.in(x);
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      planes.push_back(unit.in(shapes.coefficients(s)));
  }

  Point corner(std::uint32_t i) const { return outlines::point_at(polygons.points[i]); }

  template <class Corners>
  CGAL::Bbox_3 box_of(const Corners& corners) const
  {
    CGAL::Bbox_3 box;
    for(std::uint32_t i : corners)
      box += corner(i).bbox();
    return box;
  }
};

class Border_walls {
public:
  Border_walls(std::vector<Plane_coverage>& planes, const Site& site, double maximum_distance)
    : planes_(planes), site_(site), up_(site.up), near_(2 * maximum_distance)
  {}

  // A rectangle between two heights, in a plane of its own.
  void add_wall(const Plane_coverage::Corners& wall)
  {
    planes_.push_back(plane_of(wall));
    assume(wall, planes_.back());
  }

  // Below the borders of polygons in a box, from long ones to short ones, of the shapes that have a plane.
  void add(const Surface_scene& scene, const std::vector<int>& plane_of_shape, const CGAL::Bbox_3& box,
           const Model_progress& progress)
  {
    std::vector<Border> borders;
    for(std::size_t s = 0; s < scene.planes.size(); ++s, progress.check(0))
      if(plane_of_shape[s] >= 0 && !is_upright(scene.planes[s]))
        for(const Indexed_polygon& polygon : scene.polygons.polygons[s])
          if(CGAL::do_overlap(scene.box_of(polygon.outer), box))
            add_borders(scene.polygons, polygon, scene.planes[s], borders);
    std::stable_sort(borders.begin(), borders.end(),
                     [](const Border& a, const Border& b) { return a.length > b.length; });
    std::vector<Plane_coverage> with_walls = planes_;
    for(const Border& border : borders) {
      with_walls.push_back(plane_of(border.wall));
      with_walls.back().assume(border.wall);
    }
    const Ray_votes rays(with_walls, up_);
    std::vector<double> ratios(borders.size());
    for_each_in_parallel(borders.size(), progress, [&](std::size_t w) {
      const std::size_t plane = planes_.size() + w;
      ratios[w] = std::fabs(rays.balance(places_on(borders[w]), with_walls[plane].normal(), plane));
    });
    for(std::size_t w = 0; w < borders.size(); ++w)
      if(ratios[w] > Ray_votes::least_of_wall)
        add_to_any(borders[w].wall);
  }

private:
  struct Border {
    Point first, last;
    double drop;                  // to the plane below
    double length;                // seen from above
    Plane_coverage::Corners wall; // below it
  };

  bool is_upright(const Coefficients& c) const
  {
    return std::fabs(Vector(c[0], c[1], c[2]) * up_) < outlines::smallest_sine;
  }
  bool is_near(const Coefficients& c, const Point& p) const { return std::fabs(height(c, p)) < near_; }

  void add_borders(const outlines::Polygon_table& polygons, const Indexed_polygon& polygon, const Coefficients& own,
                   std::vector<Border>& borders) const
  {
    const auto point = [&](std::uint32_t i) { return outlines::point_at(polygons.points[i]); };
    Vector area = CGAL::NULL_VECTOR;
    for(const auto& t : polygon.triangles)
      area = area + CGAL::cross_product(point(t[1]) - point(t[0]), point(t[2]) - point(t[0]));
    const Vector left = (area * up_ > 0 ? 1 : -1) * up_; // the polygon is on the left side of its edges
    const auto add = [&](const auto& loop) {
      for(std::size_t i = 0; i < loop.size(); ++i) {
        Border border = {point(loop[i]), point(loop[(i + 1) % loop.size()]), 0, 0, {}};
        const Vector outward = CGAL::cross_product(border.last - border.first, left);
        border.length = std::sqrt(outward.squared_length());
        const Point middle = CGAL::midpoint(border.first, border.last);
        if(border.length < shortest_wall * near_ || ends_at_other(own, border) ||
           site_.has_edge_near(middle, shortest_wall * near_)) // where the footprint has a wall
          continue;
        const Plane_coverage* const below = plane_below(middle + near_ / border.length * outward, border.drop);
        if(below == nullptr || is_seen_behind(border, *below, -1 / border.length * outward))
          continue;
        border.wall = {border.first, border.last, border.last - border.drop * up_, border.first - border.drop * up_};
        borders.push_back(border);
      }
    };
    add(polygon.outer);
    for(const auto& hole : polygon.holes)
      add(hole);
  }

  bool ends_at_other(const Coefficients& own, const Border& border) const
  {
    return std::any_of(planes_.begin(), planes_.end(), [&](const Plane_coverage& p) {
      return p.plane() != own && is_near(p.plane(), border.first) && is_near(p.plane(), border.last) &&
             p.is_near_hull(CGAL::midpoint(border.first, border.last), near_);
    });
  }

  // The lowest plane that is below a point, and how far.
  const Plane_coverage* plane_below(const Point& p, double& drop) const
  {
    const Plane_coverage* result = nullptr;
    for(const Plane_coverage& plane : planes_)
      if(const double d = is_upright(plane.plane()) ? 0 : drop_to(plane, p);
         d > near_ && (result == nullptr || d > drop) && plane.is_near_hull(p - d * up_, 0)) {
        result = &plane;
        drop = d;
      }
    return result;
  }

  double drop_to(const Plane_coverage& plane, const Point& p) const { return plane.height(p) / (plane.normal() * up_); }

  // Whether more than a quarter of the plane below is covered behind the wall: what saw it would have seen the wall.
  bool is_seen_behind(const Border& border, const Plane_coverage& below, const Vector& inward) const
  {
    constexpr int rows = 4;
    const double depth = (std::min)(border.drop, border.length) / 2;
    int seen = 0;
    for(int i = 0; i < rows; ++i)
      for(int j = 0; j < rows; ++j) {
        const Point p =
          border.first + (i + .5) / rows * (border.last - border.first) + (j + .5) / rows * depth * inward;
        seen += below.is_covered(p - drop_to(below, p) * up_);
      }
    return 4 * seen > rows * rows;
  }

  // In a plane that is there, or in a new one.
  void add_to_any(const Plane_coverage::Corners& wall)
  {
    const auto plane = std::find_if(planes_.begin(), planes_.end(), [&](const Plane_coverage& p) {
      return is_upright(p.plane()) &&
             std::all_of(wall.begin(), wall.end(), [&](const Point& corner) { return is_near(p.plane(), corner); });
    });
    if(plane == planes_.end())
      add_wall(wall);
    else
      assume(wall, *plane);
  }

  static void assume(const Plane_coverage::Corners& wall, Plane_coverage& plane)
  {
    plane.reach(wall);
    plane.assume(wall);
  }

  Plane_coverage plane_of(const Plane_coverage::Corners& wall) const
  {
    const Vector across = CGAL::cross_product(wall[1] - wall[0], up_),
                 normal = across / std::sqrt(across.squared_length());
    const double offset = -(normal * (CGAL::midpoint(wall[0], wall[1]) - CGAL::ORIGIN));
    return Plane_coverage({normal.x(), normal.y(), normal.z(), offset});
  }

  // On the wall.
  std::vector<Point> places_on(const Border& border) const
  {
    constexpr int rows = 16;
    std::vector<Point> places;
    for(int i = 0; i < rows; ++i)
      for(int j = 0; j < rows; ++j)
        places.push_back(border.first + (i + .5) / rows * (border.last - border.first) -
                         (j + .5) / rows * border.drop * up_);
    return places;
  }

  static constexpr double shortest_wall = 5; // times the distance within which two places are one

  std::vector<Plane_coverage>& planes_;
  const Site& site_;
  Vector up_;
  double near_;
};

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_BORDER_WALLS_H
