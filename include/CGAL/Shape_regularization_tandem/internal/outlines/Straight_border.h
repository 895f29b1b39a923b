// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The straight parts of outlines.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_STRAIGHT_BORDER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_STRAIGHT_BORDER_H

#include <CGAL/Shape_regularization_tandem/internal/outlines/Plane_frame.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

struct Border_vertex_position {
  Kernel::Point_3 point;
  int third = -1; // the third plane at a corner, as coplanar group
};

struct Straight_border {
  int plane;                                 // the other plane, as coplanar group
  std::vector<Border_vertex_position> chain; // about as close as points; the shape is to the left
  float spacing;                             // of the points nearby
  float reach;                               // points of the shape are within this distance
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_STRAIGHT_BORDER_H
