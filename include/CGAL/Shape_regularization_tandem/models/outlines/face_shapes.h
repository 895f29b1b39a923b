// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures of faces of a triangulation, and of those around a vertex.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_FACE_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_FACE_SHAPES_H

#include <CGAL/squared_distance_2.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

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

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_FACE_SHAPES_H
