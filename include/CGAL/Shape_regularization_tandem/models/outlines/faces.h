// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_FACES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_FACES_H

#include <CGAL/squared_distance_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// --- Measures of faces of a triangulation, and of those around a vertex

// Infinite for a sliver, whose area is within the rounding of its computation: it would be divided by that. Points of
// a lattice that are on a line in space form slivers in the plane of the shape.
template <class Face_handle>
double squared_radius(Face_handle f)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto &p = f->vertex(0)->point(), &q = f->vertex(1)->point(), &r = f->vertex(2)->point();
  const auto a = q - p, b = r - p;
  const double s = a.x() * b.y(), t = a.y() * b.x();
  if(!(std::fabs(s - t) > 4 * std::numeric_limits<double>::epsilon() * (std::fabs(s) + std::fabs(t))))
    return infinity;
  const double squared = CGAL::squared_radius(p, q, r);
  return std::isfinite(squared) ? squared : infinity;
}

// Of the longest edge.
template <class Face_handle>
double squared_length(Face_handle f)
{
  double longest = 0;
  for(int i = 0; i < 3; ++i)
    longest = (std::max)(longest, CGAL::squared_distance(f->vertex(i)->point(), f->vertex((i + 1) % 3)->point()));
  return longest;
}

// The mean of the corners.
template <class Face_handle>
double spacing(Face_handle f)
{
  return (double(f->vertex(0)->info().spacing) + f->vertex(1)->info().spacing + f->vertex(2)->info().spacing) / 3;
}

// How often the inside begins around a vertex.
template <class Triangulation>
int number_of_fans(const Triangulation& triangulation, typename Triangulation::Vertex_handle v)
{
  int count = 0;
  auto f = triangulation.incident_faces(v);
  const auto end = f;
  bool was_inside = (--f)->info().is_inside;
  f = end;
  do {
    count += f->info().is_inside && !was_inside;
    was_inside = f->info().is_inside;
  } while(++f != end);
  return count;
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

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_FACES_H
