// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facts of shapes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/facts/Point_columns.h>
#include <CGAL/Shape_regularization_tandem/models/facts/Sight.h>
#include <CGAL/Shape_regularization_tandem/models/facts/curvature.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>
#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::facts {

// --- How planes lie to the level: inclination, and direction of the compass

inline double degrees(double radians) { return radians / angles::radians_per_degree; }

// The upward direction, and north and east: the axes z, y and x after the smallest rotation that takes z upward.
class Level_frame {
public:
  explicit Level_frame(const Vector& up) : up(up)
  {
    const double factor = up.z > -1 ? up.y / (1 + up.z) : 0;
    north = unit(Vector{-factor * up.x, 1 - factor * up.y, -up.y});
    east = cross(north, up);
  }

  double height(const Vector& p) const { return dot(up, p); }

  // Of this width.
  Point_columns columns(double width) const { return Point_columns(east, north, up, width); }

  // Of a plane whose outward unit normal this is. Planes that were made level or vertical are so up to rounding, which
  // must not choose their azimuth.
  Shape_facts facts_of_plane(const Vector& normal) const
  {
    Shape_facts f;
    const double cosine = dot(up, normal);
    const Vector level = add_scaled(normal, -cosine, up);
    const double sine = length(level);
    if(sine <= rounding) {
      f.tilt_deg = cosine < 0 ? 180 : 0;
      return f;
    }
    const bool is_vertical = std::fabs(cosine) <= rounding;
    f.tilt_deg = is_vertical ? 90 : degrees(std::atan2(sine, cosine));
    f.dip_deg = (std::min)(f.tilt_deg, 180 - f.tilt_deg);
    f.azimuth_deg = azimuth(is_vertical || cosine > 0 ? level : -level);
    return f;
  }

private:
  static constexpr double rounding = 1e-12; // of a cosine

  double azimuth(const Vector& direction) const
  {
    const double angle = degrees(std::atan2(dot(east, direction), dot(north, direction)));
    const double turned = angle < 0 ? angle + 360 : angle;
    return turned < 360 ? turned + 0. : 0; // no -0
  }

  Vector up, north, east;
};

// --- The rectangle of smallest area around points of a plane

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

// --- The points of a shape against its plane, and against the plane that fits them best

// The angle between a plane of this normal and the least-squares plane. There are many where the two smallest eigenvalues
// are equal, as of points on a line: the plane is as close to the closest of them.
inline double turned_deg(const Vector& normal, const Eigen_system& e, double count)
{
  constexpr double coordinate_rounding2 = 0x1p-104; // the square of the last bit of coordinates below 1
  const double rounding =
    e.value[0] + tuning::exactness::squared_distance_margin * e.value[2] + count * coordinate_rounding2;
  Vector outside = {0, 0, 0};
  for(int i = 1; i < 3; ++i)
    if(e.value[i] > rounding)
      outside = add_scaled(outside, dot(normal, e.vector[i]), e.vector[i]);
  return degrees(std::asin((std::min)(length(outside), 1.)));
}

class Facts_maker {
public:
  // up: of length 1; areas: the outlines of the shapes
  Facts_maker(const std::vector<Position>& points, const Shapes_data& data, const Vector& up,
              const outlines::Polygon_table& areas, const Stations& stations)
    : points(points), areas(areas), stations(stations), shapes(data), unit(points, shapes), level(up)
  {}

  std::vector<Shape_facts> facts() const
  {
    std::vector<Shape_facts> result(shapes.number_of_shapes());
    std::vector<Shape_patch> patches(result.size());
    for_each_in_parallel(result.size(), [&](std::size_t s) {
      take_points(s, patches[s]);
      result[s] = facts_of(s, patches[s]);
    });
    constexpr double tolerances = .01; // less is nothing, as what rounding leaves of points without noise
    const std::vector<double> curved =
      Curvature(patches, tolerances * unit.in(shapes.parameters().maximum_distance)).of_shapes();
    for(std::size_t s = 0; s < result.size(); ++s)
      result[s].curved = curved[s];
    classify(patches, result);
    look(patches, result);
    return result;
  }

private:
  // In one order, whatever that of the caller is.
  void take_points(std::size_t s, Shape_patch& patch) const
  {
    Bbox_3 box;
    patch.points.reserve(shapes.points(s).size());
    for(std::uint32_t i : shapes.points(s)) {
      patch.points.push_back(vector_of(points[i]));
      const Vector& p = patch.points.back();
      box += Bbox_3(p.x, p.y, p.z, p.x, p.y, p.z);
    }
    const std::array<double, 3> spans = {box.x_span(), box.y_span(), box.z_span()};
    const int axis = int(std::max_element(spans.begin(), spans.end()) - spans.begin());
    std::sort(patch.points.begin(), patch.points.end(), [axis](const Vector& p, const Vector& q) {
      return std::tuple(coordinate(p, axis), p.x, p.y, p.z) < std::tuple(coordinate(q, axis), q.x, q.y, q.z);
    });
    patch.axis = axis;
  }

  // But for its curvature and class. The patch has the points, and gets the rest.
  Shape_facts facts_of(std::size_t s, Shape_patch& patch) const
  {
    const Coefficients plane = unit.in(shapes.coefficients(s));
    const Vector normal = {plane[0], plane[1], plane[2]};
    Shape_facts f = level.facts_of_plane(shapes.is_flipped(s) ? -normal : normal);
    f.number_of_points = shapes.size(s);
    if(f.number_of_points == 0)
      return f; // of a known plane
    const auto height = [&](const Vector& p) {
      return std::fma(plane[0], p.x, std::fma(plane[1], p.y, std::fma(plane[2], p.z, plane[3])));
    };
    double sum = 0, squares = 0, lowest = HUGE_VAL, highest = -HUGE_VAL;
    for(const Vector& p : patch.points) {
      const double distance = height(p);
      sum += std::fabs(distance);
      squares = std::fma(distance, distance, squares);
      lowest = (std::min)(lowest, level.height(p));
      highest = (std::max)(highest, level.height(p));
    }
    const Scatter scatter = scatter_of(patch.points);
    const Eigen_system eigen = eigen_system(scatter.matrix);
    patch.centroid = patch.points[0] + scatter.centroid;
    patch.normal = eigen.vector[0];
    const Rectangle_sides sides = rectangle_of(s, patch.points);
    patch.length = sides.length;
    patch.spacing =
      (std::max)(std::sqrt(sides.length * sides.width / scatter.count), sides.length / scatter.count); // or on a line
    f.centroid = unit.out(Position{patch.centroid.x, patch.centroid.y, patch.centroid.z});
    f.length = unit.out(sides.length);
    f.width = unit.out(sides.width);
    f.area = (std::min)(areas.areas[s], f.length * f.width); // equal up to rounding, if the outline is a rectangle
    f.lowest = unit.out(lowest);
    f.highest = unit.out(highest);
    f.rms_distance = unit.out(std::sqrt(squares / scatter.count));
    f.mean_distance = unit.out(sum / scatter.count);
    f.turned_deg = turned_deg(normal, eigen, scatter.count);
    f.shifted = unit.out(std::fabs(height(patch.centroid)));
    return f;
  }

  // Around points and outline, which may be wider than the points where it ends at other shapes.
  Rectangle_sides rectangle_of(std::size_t s, const std::vector<Vector>& members) const
  {
    const auto point_3 = [](const Vector& p) { return outlines::Kernel::Point_3(p.x, p.y, p.z); };
    const outlines::Plane_frame frame(shapes, s, point_3(members[0]));
    std::vector<Flat_point> flat;
    flat.reserve(members.size());
    for(const Vector& p : members)
      flat.push_back(frame.flat(point_3(p)));
    for(const Indexed_polygon& polygon : areas.polygons[s])
      for(std::uint32_t corner : polygon.outer)
        flat.push_back(frame.flat(unit.in(outlines::point_at(areas.points[corner]))));
    return smallest_rectangle(flat);
  }

  void classify(const std::vector<Shape_patch>& patches, std::vector<Shape_facts>& facts) const
  {
    constexpr double spacings = 4; // of a column: fewer would miss what is above
    std::vector<double> spacing;
    for(const Shape_patch& patch : patches)
      if(patch.spacing > 0)
        spacing.push_back(patch.spacing);
    if(spacing.empty())
      return;
    Point_columns columns = level.columns(spacings * outlines::median(spacing));
    for(std::size_t s = 0; s < patches.size(); ++s)
      columns.add(patches[s].points, s, Point_columns::is_upright(facts[s].dip_deg));
    columns.sort(patches.size());
    for_each_in_parallel(facts.size(), [&](std::size_t s) {
      if(facts[s].number_of_points > 0)
        facts[s].shape_class = columns.class_of(s, facts[s].dip_deg);
    });
  }

  // From the stations.
  void look(const std::vector<Shape_patch>& patches, std::vector<Shape_facts>& facts) const
  {
    if(stations.of_point.empty())
      return;
    const Sight sight(points, shapes, unit, stations);
    const std::vector<char> veils = sight.veils();
    const std::vector<Crossed_shape> crossed(patches.begin(), patches.end());
    for_each_in_parallel(facts.size(), [&](std::size_t s) {
      facts[s].is_veil = veils[s] != 0;
      facts[s].behind = sight.behind(s, crossed);
    });
  }

  Vector vector_of(const Position& p) const { return {unit.in(p[0]), unit.in(p[1]), unit.in(p[2])}; }

  const std::vector<Position>& points;
  const outlines::Polygon_table& areas;
  const Stations& stations;
  outlines::Shapes shapes;
  outlines::Unit unit;
  Level_frame level;
};

// NOLINTNEXTLINE(misc-definitions-in-headers): inline where no library is linked
CGAL_TANDEM_MODELS_INLINE std::vector<Shape_facts> facts_table(const std::vector<Position>& points,
                                                               const Shapes_data& data, const Vector& up,
                                                               const outlines::Polygon_table& areas,
                                                               const Stations& stations)
{
  return Facts_maker(points, data, up, areas, stations).facts();
}

// NOLINTNEXTLINE(misc-definitions-in-headers): inline where no library is linked
CGAL_TANDEM_MODELS_INLINE std::vector<char> veil_table(const std::vector<Position>& points, const Shapes_data& data,
                                                       const Stations& stations)
{
  const outlines::Shapes shapes(data);
  return Sight(points, shapes, outlines::Unit(points, shapes), stations).veils();
}

} // namespace CGAL::Tandem::internal::facts

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H
