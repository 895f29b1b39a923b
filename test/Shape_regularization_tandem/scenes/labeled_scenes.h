// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes whose points have the label of their plane, with the tolerances that a user would choose: rooms as a scanner
// and a depth camera see them, a room of planes that are nearly parallel, roofs, the scenes of make_scene, and walls.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LABELED_SCENES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LABELED_SCENES_H

#include "scenes.h"

#include <functional>

namespace CGAL::Tandem::scenes {

struct Labeled_scene {
  std::string group; // scenes of a group count as one in means over groups
  std::string name;  // of [a-z0-9-]
  std::function<Scene()> make;
  double epsilon, alpha_deg;
  std::size_t minimum;          // points of the smallest shape
  double normal_noise_deg = -1; // of blended normals; negative: normals are those of a neighborhood fit
  std::uint64_t seed = 1;       // of that noise
};

// Rooms and roofs.
std::vector<Labeled_scene> labeled_frames();

// House, part, indoor and village, and a noisy house with five seeds.
std::vector<Labeled_scene> labeled_scenes(std::size_t points = 100000);

// Rooms and streets before spinning lidars of 16 to 128 beams, level and tilted, and a room before a profile scanner: lines
// that are 2 to 80 times farther apart than their points.
std::vector<Labeled_scene> labeled_scan_lines();

// Large walls in rooms and halls and on roofs, with noise of .1 to 1/3 epsilon. One face: they bend and bow by .2 to .6
// epsilon, or two scans are up to .9 epsilon apart. Layers: low steps, of .8 and 1 epsilon; steps, boards and strips of
// 1.1 and 1.3 epsilon. Only the faces of the walls have labels.
std::vector<Labeled_scene> labeled_walls();

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LABELED_SCENES_H
