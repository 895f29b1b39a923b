// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small scenes whose shapes, directions and planes can be counted by hand.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_ANALYTIC_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_ANALYTIC_H

#include "scene_model.h"

namespace CGAL::Tandem::scenes {

// 6 faces, 3 directions, 6 planes: complexity 9/18.
Model make_cube(const Frame& frame = Frame());

// The faces of a turned cube, each tilted by `degrees` about an own axis: right
// angles hold only within 2 `degrees`, opposite faces are parallel within as much.
Model make_tilted_cube(double degrees = 2);

// 2 n faces, 2 directions, 2 n planes.
Model make_staircase(int steps = 8);

// Two coplanar squares: 2 faces with a gap, otherwise 1.
Model make_squares(double gap);

// A long plane of slope `degrees` that begins at the end of a flat one, beside
// another flat one: must neither be flattened nor cut into terraces.
Model make_slope(double degrees = 2);

// Separate squares, each turned by `degrees` against the one before.
Model make_chained(double degrees = 5, int count = 3);

// A master and two followers orthogonal to it that enclose 53.13 degrees.
Model make_two_followers();

// Two parallel squares side by side, the second higher by `offset`.
Model make_offset_pair(double offset);

Model make_sphere();

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_ANALYTIC_H
