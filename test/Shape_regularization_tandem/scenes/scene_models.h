// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models of scenes. Lengths in metres, or units.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_MODELS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_MODELS_H

#include "scene_model.h"

#include <string>

namespace CGAL::Tandem::scenes {

// --- Small ones, whose shapes, directions and planes can be counted by hand

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

// --- Floors, roads and roofs that are not quite planar, as real ones. How much they bend in units of epsilon is up to the
// epsilon they are detected with. The truth of a bent face is its mean plane.

// 8 by 5 m. Floor and ceiling sag by 2 and 4 cm, a wall is planar. A board hangs 2.2 cm before that wall, and another
// one 6 cm: layers. Columns of three radii.
Model make_bent_hall();

// 30 m of a road that is 12 cm lower in its middle, with a planar wall, and two roofs warped by 6 cm, to either side.
Model make_bent_road();

// --- A house with windows and roof, sixteen turned houses, furnished rooms, a mechanical part

Model make_house();

// Sixteen houses, each turned 2.9 degrees more than the one before: 65 directions
// (two of the walls and two of the roof for each house, and the vertical).
Model make_village();

Model make_indoor();

// A block with a slot, steps, a chamfer, a pocket, a boss and holes.
Model make_part();

// --- Those of scene_twins.h: a street, a tower, a small room, and an object whose surface is mostly curved

// As a mobile mapping system passes it, in the middle of the road.
Model make_street();

// A clock tower of six sides, with a plinth, two ledges, windows and a spire.
Model make_tower();

// One furnished room, seen from a few places, in the frame of the first camera.
Model make_study();

// A plate with balls and drums: two thirds of the surface are curved.
Model make_curved();

// --- Those of the labeled frames

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

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_MODELS_H
