// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed lines around the faces of a triangulation that are inside.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BOUNDARY_LOOPS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BOUNDARY_LOOPS_H

#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

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

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BOUNDARY_LOOPS_H
