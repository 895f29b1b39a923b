// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closed lines around the points of a shape, and the numbers that decide how they follow the points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_VERTEX_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_VERTEX_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

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

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_VERTEX_H
