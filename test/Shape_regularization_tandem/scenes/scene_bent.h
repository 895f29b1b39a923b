// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes whose floors, roads and roofs are not quite planar, as real ones. How much they bend in units of epsilon is up
// to the epsilon they are detected with. The truth of a bent face is its mean plane.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_BENT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_BENT_H

#include "scene_model.h"

namespace CGAL::Tandem::scenes {

// 8 by 5 m. Floor and ceiling sag by 2 and 4 cm, a wall is planar. A board hangs 2.2 cm before that wall, and another
// one 6 cm: layers. Columns of three radii.
Model make_bent_hall();

// 30 m of a road that is 12 cm lower in its middle, with a planar wall, and two roofs warped by 6 cm, to either side.
Model make_bent_road();

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_BENT_H
