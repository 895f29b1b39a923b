// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The straight parts of outlines.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_STRAIGHT_BORDER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_STRAIGHT_BORDER_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// It depends on the planes and on its place on their line only, so that it is the same for all shapes that have it.
struct Border_vertex_position {
  Kernel::Point_3 point;
  int third = -1; // the third plane at a corner, as coplanar group
};

// The line of two planes, the same for all shapes of both.
struct Border_line {
  int planes[2]; // as coplanar groups, ascending
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
  Border_line line;
  int plane;                                 // the other plane, as coplanar group
  std::vector<Border_vertex_position> chain; // about as close as points; the shape is to the left
  float spacing;                             // of the points nearby
  float reach;                               // points of the shape are within this distance
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_STRAIGHT_BORDER_H
