// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The area that the points of a shape cover, as triangles in its plane: the alpha shape
// of the points, its boundary straightened, holes kept.

#ifndef DETECT_PLANES_SHAPE_POLYGONS_H
#define DETECT_PLANES_SHAPE_POLYGONS_H

#include "output/write_results.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Polyline_simplification_2/Squared_distance_cost.h>
#include <CGAL/Polyline_simplification_2/Stop_above_cost_threshold.h>
#include <CGAL/Polyline_simplification_2/simplify.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace program {

struct Shape_polygons {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles; // counterclockwise, seen from where the normals point to
};

// Coordinates in the plane of a shape. They decide what is connected how; vertices are computed in space.
class Plane_frame {
public:
  Plane_frame(const Shapes& shapes, std::size_t s, const Kernel::Point_3& origin) : origin(origin)
  {
    const auto& c = shapes.coefficients(s);
    const double sign = shapes.is_flipped(s) ? -1 : 1;
    for(int k = 0; k < 4; ++k)
      plane[k] = c[k];
    const Kernel::Vector_3 normal(sign * c[0], sign * c[1], sign * c[2]);
    for(int k = 1; k < 3; ++k)
      if(std::fabs(plane[k]) > std::fabs(plane[steepest]))
        steepest = k;
    Kernel::Vector_3 across =
      CGAL::cross_product(Kernel::Vector_3(steepest == 1, steepest == 2, steepest == 0), normal);
    first = across / std::sqrt(across.squared_length());
    second = CGAL::cross_product(normal, first);
  }

  Kernel::Point_2 flat(const Kernel::Point_3& p) const
  {
    const Kernel::Vector_3 v = p - origin;
    return Kernel::Point_2(first * v, second * v);
  }

  // The projection of a point. Its coordinate along the steepest axis of the normal is solved for, so that no
  // double is closer to the plane.
  std::array<double, 3> on_plane(const Kernel::Point_3& p) const
  {
    const double height = std::fma(plane[0], p.x(), std::fma(plane[1], p.y(), std::fma(plane[2], p.z(), plane[3])));
    std::array<double, 3> q;
    for(int k = 0; k < 3; ++k)
      q[k] = std::fma(-height, plane[k], p[k]);
    const int j = (steepest + 1) % 3, k = (steepest + 2) % 3;
    q[steepest] = -std::fma(plane[j], q[j], std::fma(plane[k], q[k], plane[3])) / plane[steepest];
    return q;
  }

private:
  Kernel::Point_3 origin;
  Kernel::Vector_3 first, second;
  double plane[4];
  int steepest = 0;
};

// The alpha shape of points in the plane.
class Alpha_boundary {
public:
  using Vertex = std::pair<Kernel::Point_2, std::uint32_t>; // with the position of the point
  using Loop = std::vector<Vertex>;

  // Inside are the triangles of the Delaunay triangulation whose circumscribed circle is small enough.
  explicit Alpha_boundary(const std::vector<Vertex>& points) : triangulation(points.begin(), points.end())
  {
    std::vector<double> radii;
    for(Face_handle f : triangulation.finite_face_handles())
      radii.push_back(squared_radius(f));
    if(radii.empty())
      return; // all points are on a line
    // Of points at random, the largest empty circle is about 2.3 times as large as the upper quartile of all.
    const auto quartile = radii.begin() + std::ptrdiff_t(radii.size() * 3 / 4);
    std::nth_element(radii.begin(), quartile, radii.end());
    if(std::isfinite(*quartile)) // else all points are on a line, but for rounding
      squared_alpha = 2.5 * 2.5 * *quartile;
    for(Face_handle f : triangulation.all_face_handles())
      f->info() = !triangulation.is_infinite(f) && squared_radius(f) <= squared_alpha;
  }

  double radius() const { return std::sqrt(squared_alpha); }

  // Closed polylines with the inside to their left. They may touch, but do not cross.
  std::vector<Loop> loops() const
  {
    std::vector<Loop> result;
    std::set<Edge> done;
    for(Face_handle f : triangulation.finite_face_handles())
      for(int i = 0; i < 3; ++i)
        if(is_boundary({f, i}) && done.count({f, i}) == 0) {
          result.emplace_back();
          for(Edge e = {f, i}; done.insert(e).second; e = next(e)) {
            const auto source = e.first->vertex(Triangulation::ccw(e.second));
            result.back().emplace_back(source->point(), source->info());
          }
        }
    return result;
  }

private:
  using Triangulation = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>,
                                                 CGAL::Triangulation_face_base_with_info_2<bool, Kernel>>>;
  using Face_handle = Triangulation::Face_handle;
  using Edge = std::pair<Face_handle, int>; // opposite to that vertex of the face, which is to its left

  // Infinite for a sliver, whose area is within the rounding of its computation: it would be divided by that. Points of
  // a lattice that are on a line in space form slivers in the plane of the shape.
  static double squared_radius(Face_handle f)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Kernel::Point_2 &p = f->vertex(0)->point(), &q = f->vertex(1)->point(), &r = f->vertex(2)->point();
    const Kernel::Vector_2 a = q - p, b = r - p;
    const double s = a.x() * b.y(), t = a.y() * b.x();
    if(!(std::fabs(s - t) > 4 * std::numeric_limits<double>::epsilon() * (std::fabs(s) + std::fabs(t))))
      return infinity;
    const double squared = CGAL::squared_radius(p, q, r);
    return std::isfinite(squared) ? squared : infinity;
  }

  static bool is_boundary(const Edge& e) { return e.first->info() && !e.first->neighbor(e.second)->info(); }

  // Turns around the end of a boundary edge, within the inside.
  static Edge next(const Edge& e)
  {
    const auto end = e.first->vertex(Triangulation::cw(e.second));
    Edge out = {e.first, Triangulation::ccw(e.second)};
    while(!is_boundary(out)) {
      const Face_handle f = out.first->neighbor(out.second);
      out = {f, Triangulation::cw(f->index(end))};
    }
    return out;
  }

  Triangulation triangulation;
  double squared_alpha = 0;
};

// A triangulation of what is inside of closed polylines.
class Loop_triangulation {
public:
  explicit Loop_triangulation(const std::vector<Alpha_boundary::Loop>& loops)
  {
    for(const Alpha_boundary::Loop& loop : loops) {
      std::vector<Kernel::Point_2> points;
      for(const auto& [point, position] : loop) {
        points.push_back(point);
        position_of[point] = position;
      }
      triangulation.insert_constraint(points.begin(), points.end(), true);
    }
  }

  // Leaves out vertices that are within `tolerance` of the polyline that remains; crossings are avoided.
  void straighten(double tolerance)
  {
    namespace simplification = CGAL::Polyline_simplification_2;
    simplification::simplify(triangulation, simplification::Squared_distance_cost(),
                             simplification::Stop_above_cost_threshold(tolerance * tolerance));
  }

  // f(positions of three points), counterclockwise
  template <class Function>
  void for_each_triangle(Function f)
  {
    mark_inside();
    for(Face_handle face : triangulation.finite_face_handles())
      if(face->info() == 1)
        f(std::array<std::uint32_t, 3>{position_of.at(face->vertex(0)->point()),
                                       position_of.at(face->vertex(1)->point()),
                                       position_of.at(face->vertex(2)->point())});
  }

private:
  using Vertex_base = CGAL::Polyline_simplification_2::Vertex_base_2<Kernel>;
  using Face_base =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
  using Base =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>,
                                               CGAL::Exact_predicates_tag>;
  using Triangulation = CGAL::Constrained_triangulation_plus_2<Base>;
  using Face_handle = Triangulation::Face_handle;

  // From infinity inwards; each crossing of a polyline changes the side.
  void mark_inside()
  {
    constexpr int unknown = -1;
    for(Face_handle f : triangulation.all_face_handles())
      f->info() = unknown;
    std::vector<Face_handle> stack = {triangulation.infinite_face()};
    stack.front()->info() = 0;
    while(!stack.empty()) {
      const Face_handle f = stack.back();
      stack.pop_back();
      for(int i = 0; i < 3; ++i) {
        const Face_handle g = f->neighbor(i);
        if(g->info() != unknown)
          continue;
        g->info() = triangulation.is_constrained({f, i}) ? 1 - f->info() : f->info();
        stack.push_back(g);
      }
    }
  }

  Triangulation triangulation;
  std::map<Kernel::Point_2, std::uint32_t> position_of;
};

inline Shape_polygons polygons_of_shape(const Point_set& points, const Shapes& shapes, std::size_t s)
{
  const auto point = [&](std::size_t i) { return points.point(*(points.begin() + std::ptrdiff_t(i))); };
  const Plane_frame frame(shapes, s, point(shapes.points(s)[0]));
  std::vector<Alpha_boundary::Vertex> members;
  for(std::uint32_t i : shapes.points(s))
    members.emplace_back(frame.flat(point(i)), i);
  const Alpha_boundary boundary(members);
  const std::vector<Alpha_boundary::Loop> boundary_loops = boundary.loops();
  Shape_polygons result;
  if(boundary_loops.empty())
    return result;
  Loop_triangulation loops(boundary_loops);
  loops.straighten(boundary.radius() / 3);

  std::map<std::uint32_t, std::uint32_t> vertex_of; // position of a point
  loops.for_each_triangle([&](std::array<std::uint32_t, 3> triangle) {
    for(std::uint32_t& corner : triangle) {
      const auto added = vertex_of.emplace(corner, std::uint32_t(result.vertices.size()));
      if(added.second)
        result.vertices.push_back(frame.on_plane(point(corner)));
      corner = added.first->second;
    }
    result.triangles.push_back(triangle);
  });
  return result;
}

} // namespace program

#endif // DETECT_PLANES_SHAPE_POLYGONS_H
