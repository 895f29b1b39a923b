// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models of the labeled frames (labeled_frames.h). Lengths in metres.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAME_MODELS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAME_MODELS_H

#include "scene_buildings.h"

#include <string>

namespace CGAL::Tandem::scenes {

// A furnished room of 6 by 5 by 2.7 m: tables, shelves, boxes; and cylinders and a ball, which are clutter.
Model make_office();

// A room of 17 planes; floor, ceiling, walls, boards, and doors are parallel to others but for 2 to 5 degrees.
Model make_tilted_room();

// The roof of a house of 12 by 9 m without its walls: gable, low, hip, dormers, wing, mansard,
// hall (saw teeth), villa (hip, wing and dormers).
Model make_roof(const std::string& kind);
const std::vector<std::string>& roof_kinds();

// A wall of 4 by 3 m in the xz plane, and three boards of different sizes at the distance `gap` before it.
Model make_boards(double gap);

// Five strips of .8 by 3 m side by side; the second and the fourth are higher by `gap`.
Model make_strips(double gap);

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_FRAME_MODELS_H
