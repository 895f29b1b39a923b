// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The larger scenes: a house with windows and roof, sixteen turned houses,
// furnished rooms, a mechanical part. Lengths in metres (the part: units).

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_BUILDINGS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_BUILDINGS_H

#include "scene_model.h"

namespace CGAL::Tandem::scenes {

Model make_house();

// Sixteen houses, each turned 2.9 degrees more than the one before: 65 directions
// (two of the walls and two of the roof for each house, and the vertical).
Model make_village();

void add_table(Model& model, const Frame& f, double width, double depth, double height);

// A bookcase: board and walls around open compartments.
void add_shelf(Model& model, const Frame& f, double width, double height, int boards);

Model make_indoor();

// A boss or a bore; what it hides is cut by a prism of sixteen sides.
void add_cylinder(Model& model, const Frame& f, double radius, double height, bool is_hole);

// A block with a slot, steps, a chamfer, a pocket, a boss and holes.
Model make_part();

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_BUILDINGS_H
