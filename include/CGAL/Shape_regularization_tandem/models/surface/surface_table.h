// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed surface of the planes of shapes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Point_blocks.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Boundary_faces.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// --- Walls that no point covers, as in airborne scans: where a shape ends with another one below its border, a wall is
// assumed to go straight down from there.

class Border_walls {
public:
  Border_walls(std::vector<Plane_coverage>& planes, const Vector& up, double maximum_distance)
    : planes_(planes), up_(up), near_(2 * maximum_distance)
  {}

  // Below the borders of these polygons, each of which has a plane of its own, from long ones to short ones.
  void add(const outlines::Polygon_table& polygons, const std::vector<Coefficients>& planes)
  {
    std::vector<Border> borders;
    for(std::size_t s = 0; s < polygons.polygons.size(); ++s)
      if(!is_upright(planes[s]))
        for(const Indexed_polygon& polygon : polygons.polygons[s])
          add_borders(polygons, polygon, planes[s], borders);
    std::stable_sort(borders.begin(), borders.end(),
                     [](const Border& a, const Border& b) { return a.length > b.length; });
    borders.resize((std::min)(borders.size(), most_borders));
    std::vector<Plane_coverage> walls;
    for(const Border& border : borders) {
      walls.push_back(plane_of(border));
      walls.back().reach(border.wall);
      walls.back().assume(border.wall);
    }
    Ray_votes rays(up_);
    rays.add_obstacles(planes_);
    rays.add_obstacles(walls);
    std::vector<double> ratios(walls.size());
    for_each_in_parallel(walls.size(), [&](std::size_t w) { ratios[w] = ratio_of_rays(borders[w], rays, walls[w]); });
    const std::size_t most = planes_.size() + most_planes;
    for(std::size_t w = 0; w < walls.size(); ++w)
      add_wall(borders[w], ratios[w] > least_ratio, most);
  }

private:
  struct Border {
    Point first, last;
    double drop;                     // to the plane below
    double length;                   // seen from above
    Plane_coverage::Quadrangle wall; // below it
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
        if(border.length < shortest_wall * near_ || ends_at_other(own, border))
          continue;
        border.drop = drop_at(CGAL::midpoint(border.first, border.last) + near_ / border.length * outward);
        border.wall = {border.first, border.last, border.last - border.drop * up_, border.first - border.drop * up_};
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
    return std::any_of(planes_.begin(), planes_.end(), [&](const Plane_coverage& p) {
      return p.plane() != own && is_near(p.plane(), border.first) && is_near(p.plane(), border.last) &&
             p.is_near_hull(CGAL::midpoint(border.first, border.last), near_);
    });
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

  Plane_coverage plane_of(const Border& border) const
  {
    const Vector normal = CGAL::cross_product(border.last - border.first, up_) / border.length;
    const double offset = -(normal * (CGAL::midpoint(border.first, border.last) - CGAL::ORIGIN));
    return Plane_coverage({normal.x(), normal.y(), normal.z(), offset});
  }

  // That say that it is between inside and outside.
  double ratio_of_rays(const Border& border, const Ray_votes& rays, const Plane_coverage& wall) const
  {
    constexpr int rows = 16;
    std::vector<Point> places;
    for(int i = 0; i < rows; ++i)
      for(int j = 0; j < rows; ++j)
        places.push_back(border.first + (i + .5) / rows * (border.last - border.first) -
                         (j + .5) / rows * border.drop * up_);
    return std::fabs(rays.balance(places, Vector(wall.plane()[0], wall.plane()[1], wall.plane()[2]), wall));
  }

  // In a plane that is there, or in a new one, which may be a boundary there even if the wall is not assumed.
  void add_wall(const Border& border, bool is_assumed, std::size_t most)
  {
    auto plane = std::find_if(planes_.begin(), planes_.end(), [&](const Plane_coverage& p) {
      return is_upright(p.plane()) && std::all_of(border.wall.begin(), border.wall.end(),
                                                  [&](const Point& corner) { return is_near(p.plane(), corner); });
    });
    if(plane == planes_.end()) {
      if(planes_.size() == most)
        return;
      plane = planes_.insert(planes_.end(), plane_of(border));
    }
    plane->reach(border.wall);
    if(is_assumed)
      plane->assume(border.wall);
  }

  static constexpr std::size_t most_borders = 1000; // the longest ones, as each is asked about with all of them
  static constexpr std::size_t most_planes = 200;   // that are new
  static constexpr double shortest_wall = 5;        // times the distance within which two places are one
  static constexpr double least_ratio = .25; // of rays: they say nothing of a border within a room or below a roof

  std::vector<Plane_coverage>& planes_;
  Vector up_;
  double near_;
};

// --- What a closed surface is made of: the distinct planes of shapes that have an area, those with most points first, and
// walls behind them.

// Lengths are in a unit of about the largest coordinate.
struct Surface_input {
  static constexpr std::size_t fewest_planes = 4; // that enclose something

  outlines::Unit unit;
  std::vector<Plane_coverage> planes;
  std::vector<int> groups; // the coplanar groups of the planes that have points, which come first
  CGAL::Bbox_3 box;        // of the points, and somewhat around them

  // At most `most` planes that have points.
  Surface_input(const std::vector<Position>& points, const outlines::Shapes& shapes, std::size_t most)
    : unit(points, shapes)
  {
    const double maximum_distance = unit.in(shapes.parameters().maximum_distance);
    const std::vector<std::size_t> shape_of_group = shapes.distinct_planes();
    std::vector<std::vector<Point>> of_group(shape_of_group.size());
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::uint32_t i : shapes.points(s))
        of_group[shapes.coplanar_group(s)].push_back(unit.in(points[i]));
    std::vector<std::size_t> order(of_group.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return of_group[a].size() > of_group[b].size(); });
    for(std::size_t g : order) {
      if(planes.size() == most || of_group[g].empty())
        break;
      Plane_coverage plane(unit.in(shapes.coefficients(shape_of_group[g])), std::move(of_group[g]), maximum_distance);
      if(!plane.has_area())
        continue;
      for(const Point& p : plane.points())
        box += p.bbox();
      planes.push_back(std::move(plane));
      groups.push_back(int(g));
    }
    box = outlines::grown(box, 2 * maximum_distance);
  }

  // Below the borders of these outlines of the shapes.
  void add_walls(outlines::Polygon_table polygons, const outlines::Shapes& shapes, const Vector& up)
  {
    for(Position& p : polygons.points)
      for(double& x : p)
        x = unit.in(x);
    std::vector<Coefficients> of_shapes;
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      of_shapes.push_back(unit.in(shapes.coefficients(s)));
    Border_walls(planes, up, unit.in(shapes.parameters().maximum_distance)).add(polygons, of_shapes);
  }

  // The coplanar group of a plane; none if it has no points, or is a face of the box.
  int group(int plane) const
  {
    return plane >= 0 && std::size_t(plane) < groups.size() ? groups[std::size_t(plane)] : none;
  }
};

// NOLINTNEXTLINE(misc-definitions-in-headers): inline where no library is linked
CGAL_TANDEM_MODELS_INLINE Surface_table surface_table(const std::vector<Position>& points, const Shapes_data& data,
                                                      std::size_t most_planes, const internal::Vector& upward)
{
  const Vector up(upward.x, upward.y, upward.z);
  const outlines::Shapes shapes(data);
  Surface_input input(points, shapes, most_planes);
  input.add_walls(outlines::outline_table(points, data), shapes, up);
  Surface_table result;
  result.number_of_planes = input.groups.size();
  if(input.planes.size() < Surface_input::fewest_planes)
    return result;
  const Cells cells = cut_cells(input.planes, input.box);
  const Inside_cost cost(cells, input.planes, up);
  const Inside_cells inside(cells, cost);
  for(std::size_t f = 0; f < cells.facets.size(); ++f)
    if(inside.is_boundary(int(f)))
      result.number_of_points += cost.number_of_points[f];
  const double shortest = 1e-9 * extent_of(input.box); // what is closer is an effect of rounding
  const Short_edges edges(cells.points, Boundary_faces(cells, inside).faces(), shortest);
  const auto out = [&](const Point& p) { return input.unit.out(Position{p.x(), p.y(), p.z()}); };
  std::map<int, std::size_t> number;
  for(const Face& face : edges.faces()) {
    result.plane_of_face.push_back(input.group(face.plane));
    result.faces.emplace_back();
    for(int v : face.vertices) {
      const auto added = number.emplace(v, result.points.size());
      if(added.second)
        result.points.push_back(out(cells.points[std::size_t(v)]));
      result.faces.back().push_back(added.first->second);
    }
  }
  return result;
}

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SURFACE_TABLE_H
