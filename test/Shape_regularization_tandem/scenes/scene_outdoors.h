// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The models of scene_twins.h that are not in scene_buildings.h: a street, a
// tower, a small room, and an object whose surface is mostly curved.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_OUTDOORS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_OUTDOORS_H

#include "scene_buildings.h"

namespace CGAL::Tandem::scenes {

// As a mobile mapping system passes it, in the middle of the road.
Model make_street();

// A clock tower of six sides, with a plinth, two ledges, windows and a spire.
Model make_tower();

// One furnished room, seen from a few places, in the frame of the first camera.
Model make_study();

// A plate with balls and drums: two thirds of the surface are curved.
Model make_curved();

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_OUTDOORS_H
