// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A straight part of the outline of a shape: it ends there at the plane of another one.

#ifndef DETECT_PLANES_STRAIGHT_BORDER_H
#define DETECT_PLANES_STRAIGHT_BORDER_H

#include "outlines/Plane_frame.h"

#include <vector>

namespace program {

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

} // namespace program

#endif // DETECT_PLANES_STRAIGHT_BORDER_H
