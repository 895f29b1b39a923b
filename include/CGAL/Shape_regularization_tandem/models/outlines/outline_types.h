// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TYPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TYPES_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// --- The straight parts of outlines

// It depends on the planes and on its place on their line only, so that it is the same for all shapes that have it.
struct Border_vertex_position {
  Kernel::Point_3 point;
  int third = -1; // the third plane at a corner, as coplanar group
};

// The line of two planes, the same for all shapes of both.
struct Border_line {
  std::array<int, 2> planes; // as coplanar groups, ascending
  Kernel::Point_3 origin;
  Kernel::Vector_3 direction; // unit
  double sine;                // of the angle between the planes

  int other_than(int plane) const { return planes[planes[0] == plane ? 1 : 0]; }
  double along(const Kernel::Point_3& p) const { return (p - origin) * direction; }
};

// A part of a line at which a shape ends.
struct Border_piece {
  struct End {
    double along;
    int third = -1;   // the third plane, where it is a corner
    double shift = 0; // by which it was moved there
  };

  Border_line line;
  End ends[2];  // in the order of the direction of the line
  bool is_left; // side of the shape
  float spacing;
  double reach; // points of the shape are within this distance
  std::vector<Border_vertex_position> crossings;

  double length() const { return ends[1].along - ends[0].along; }
};

using Border_pieces = std::vector<Border_piece>;

struct Straight_border {
  std::vector<Border_vertex_position> chain; // about as close as points; the shape is to the left
  float spacing;                             // of the points nearby
  float reach;                               // points of the shape are within this distance
};

// --- Closed lines around the points of a shape, and the numbers that decide how they follow the points

// Lengths are multiples of the spacing of the points, areas of its square.
struct Outline_limits {
  double radius = 1.8; // of the largest circle without points; at random, the largest of a million is about that large
  double piece = 20;   // smallest area of a piece
  double hole = 16;    // smallest area of a hole
  double tolerance = .6; // of the straightened outline; corners of a lattice remain
};

struct Outline_vertex {
  Kernel::Point_2 point;
  float spacing;
  bool is_fixed;           // the end of a straight border, whose position is known
  Position position;       // in space, as it is written
  Kernel::Point_2 written; // its projection, which decides whether lines are simple
  bool is_corner = false;  // of straight borders: a point of three planes
  int border = -1;         // the straight border that goes from here to the next vertex
  std::size_t rank = 0;    // in the sequence of the vertices of all loops

  // What is fixed, and what crossing borders have made.
  bool stays() const { return is_fixed || !(spacing > 0); }
};

using Outline_loop = std::vector<Outline_vertex>;

// Positive, if the inside is to the left.
inline double twice_area(const Outline_loop& loop)
{
  double result = 0;
  for(std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Kernel::Vector_2 p = loop[i].point - loop[0].point, q = loop[i + 1].point - loop[0].point;
    result += p.x() * q.y() - p.y() * q.x();
  }
  return result;
}

// --- The closed lines around the faces of a triangulation that are inside

// An edge is opposite to a vertex of its face, which is inside and to its left.
template <class Triangulation, class Is_inside>
class Boundary_walk {
public:
  using Face_handle = typename Triangulation::Face_handle;
  using Edge = std::pair<Face_handle, int>;
  using Loop = std::vector<Edge>;

  Boundary_walk(const Triangulation& triangulation, Is_inside is_inside)
    : triangulation(triangulation), is_inside(is_inside)
  {}

  std::vector<Loop> loops() const
  {
    std::vector<Loop> result;
    std::set<Edge> done;
    for(Face_handle f : triangulation.finite_face_handles())
      for(int i = 0; i < 3; ++i)
        if(is_boundary({f, i}) && done.count({f, i}) == 0) {
          result.emplace_back();
          for(Edge e = {f, i}; done.insert(e).second; e = next(e))
            result.back().push_back(e);
        }
    return result;
  }

  static auto source(const Edge& e) { return e.first->vertex(Triangulation::ccw(e.second)); }

private:
  bool is_boundary(const Edge& e) const { return is_inside(e.first) && !is_inside(e.first->neighbor(e.second)); }

  // Turns around the end of a boundary edge, within the inside.
  Edge next(const Edge& e) const
  {
    const auto end = e.first->vertex(Triangulation::cw(e.second));
    Edge out = {e.first, Triangulation::ccw(e.second)};
    while(!is_boundary(out)) {
      const Face_handle f = out.first->neighbor(out.second);
      out = {f, Triangulation::cw(f->index(end))};
    }
    return out;
  }

  const Triangulation& triangulation;
  Is_inside is_inside;
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TYPES_H
