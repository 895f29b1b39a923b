// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facts of shapes, but for their areas.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>
#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>

#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace facts {

// --- How planes lie to the level: inclination, and direction of the compass

inline double degrees(double radians) { return radians / angles::radians_per_degree; }

// In degrees.
struct Slope {
  double tilt, dip, azimuth;
};

// The upward direction, and north and east: the axes z, y and x after the smallest rotation that takes z upward.
class Level_frame {
public:
  explicit Level_frame(const Vector& up) : up(up)
  {
    const double share = up.z > -1 ? up.y / (1 + up.z) : 0;
    north = unit(Vector{-share * up.x, 1 - share * up.y, -up.y});
    east = cross(north, up);
  }

  double height(const Vector& p) const { return dot(up, p); }

  // Of a plane whose outward unit normal this is. Planes that were made level or vertical are so up to rounding, which
  // must not choose their azimuth.
  Slope slope(const Vector& normal) const
  {
    const double cosine = dot(up, normal);
    const Vector level = add_scaled(normal, -cosine, up);
    const double sine = length(level);
    if(sine <= rounding)
      return {cosine < 0 ? 180. : 0., 0, 0};
    if(std::fabs(cosine) <= rounding)
      return {90, 90, azimuth(level)};
    const double tilt = degrees(std::atan2(sine, cosine));
    return {tilt, (std::min)(tilt, 180 - tilt), azimuth(cosine > 0 ? level : -level)};
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

// Lengths are in the unit.
class Shape_measures {
public:
  Shape_measures(const std::vector<Position>& points, const outlines::Shapes& shapes, const outlines::Unit& unit,
                 std::size_t s)
    : plane(unit.in(shapes.coefficients(s))), frame(shapes, s, unit.in(points[shapes.points(s)[0]]))
  {
    members.reserve(shapes.points(s).size());
    for(std::uint32_t i : shapes.points(s))
      members.push_back(unit.in(points[i]));
    measure();
  }

  Vector normal() const { return {plane[0], plane[1], plane[2]}; }
  Vector centroid() const { return vector(members[0]) + scatter.centroid; }

  // Of the points to the plane.
  double mean_distance() const { return sum / scatter.count; }
  double rms_distance() const { return std::sqrt(squares / scatter.count); }

  // Of the centroid, through which the least-squares plane passes.
  double shifted() const { return std::fabs(height(centroid())); }

  // The angle with the least-squares plane. There are many where the two smallest eigenvalues are equal, as of points on
  // a line: the plane is as close to the closest of them.
  double turned_deg() const
  {
    const Eigen_system e = eigen_system(scatter.matrix);
    const double rounding =
      e.value[0] + tuning::exactness::squared_distance_margin * e.value[2] + scatter.count * coordinate_rounding2;
    Vector outside = {0, 0, 0};
    for(int i = 1; i < 3; ++i)
      if(e.value[i] > rounding)
        outside = add_scaled(outside, dot(normal(), e.vector[i]), e.vector[i]);
    return degrees(std::asin((std::min)(length(outside), 1.)));
  }

  Rectangle_sides rectangle() const
  {
    std::vector<Flat_point> flat;
    flat.reserve(members.size());
    for(const outlines::Kernel::Point_3& p : members)
      flat.push_back(frame.flat(p));
    return smallest_rectangle(flat);
  }

  // The smallest and the largest height of a point above the level through the origin.
  std::array<double, 2> heights(const Level_frame& level) const
  {
    std::array<double, 2> range = {level.height(vector(members[0])), level.height(vector(members[0]))};
    for(const outlines::Kernel::Point_3& p : members) {
      range[0] = (std::min)(range[0], level.height(vector(p)));
      range[1] = (std::max)(range[1], level.height(vector(p)));
    }
    return range;
  }

private:
  static constexpr double coordinate_rounding2 = 0x1p-104; // the square of the last bit of coordinates below 1

  static Vector vector(const outlines::Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

  double height(const Vector& p) const
  {
    return std::fma(plane[0], p.x, std::fma(plane[1], p.y, std::fma(plane[2], p.z, plane[3])));
  }

  // The moments are those about the first point, as coordinates may be large.
  void measure()
  {
    const Vector origin = vector(members[0]);
    scatter = {double(members.size()), {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
    for(const outlines::Kernel::Point_3& p : members) {
      scatter.centroid = scatter.centroid + (vector(p) - origin);
      const double h = height(vector(p));
      sum += std::fabs(h);
      squares = std::fma(h, h, squares);
    }
    scatter.centroid = (1 / scatter.count) * scatter.centroid;
    for(const outlines::Kernel::Point_3& p : members) {
      const Vector v = vector(p) - origin - scatter.centroid;
      scatter.matrix =
        scatter.matrix + Symmetric_matrix{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
    }
  }

  outlines::Shapes::Coefficients plane;
  outlines::Plane_frame frame;
  std::vector<outlines::Kernel::Point_3> members;
  Scatter scatter;
  double sum = 0, squares = 0; // of distances
};

// The normal points to the outward side.
inline Shape_facts facts_of_plane(const Vector& normal, const Level_frame& level)
{
  Shape_facts f;
  const Slope slope = level.slope(normal);
  f.tilt_deg = slope.tilt;
  f.dip_deg = slope.dip;
  f.azimuth_deg = slope.azimuth;
  return f;
}

inline void add_facts_of_points(const Shape_measures& measures, const outlines::Unit& unit, const Level_frame& level,
                                Shape_facts& f)
{
  const Vector centroid = measures.centroid();
  f.centroid = unit.out(Position{centroid.x, centroid.y, centroid.z});
  const Rectangle_sides sides = measures.rectangle();
  f.length = unit.out(sides.length);
  f.width = unit.out(sides.width);
  const std::array<double, 2> heights = measures.heights(level);
  f.lowest = unit.out(heights[0]);
  f.highest = unit.out(heights[1]);
  f.rms_distance = unit.out(measures.rms_distance());
  f.mean_distance = unit.out(measures.mean_distance());
  f.turned_deg = measures.turned_deg();
  f.shifted = unit.out(measures.shifted());
}

CGAL_TANDEM_MODELS_INLINE std::vector<Shape_facts> facts_table(const std::vector<Position>& points,
                                                               const Shapes_data& data, const Vector& up)
{
  const outlines::Shapes shapes(data);
  const outlines::Unit unit(points, shapes);
  const Level_frame level(up);
  std::vector<Shape_facts> facts(shapes.number_of_shapes());
  for_each_in_parallel(facts.size(), [&](std::size_t s) {
    const Coefficients& c = shapes.coefficients(s);
    const Vector normal = {c[0], c[1], c[2]};
    facts[s] = facts_of_plane(shapes.is_flipped(s) ? -normal : normal, level);
    facts[s].number_of_points = shapes.size(s);
    if(shapes.size(s) > 0) // not of a known plane
      add_facts_of_points(Shape_measures(points, shapes, unit, s), unit, level, facts[s]);
  });
  return facts;
}

} // namespace facts
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_FACTS_TABLE_H
