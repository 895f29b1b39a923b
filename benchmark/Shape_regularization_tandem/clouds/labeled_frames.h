// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Generated clouds whose points have the label of their plane, with the tasks that they stand for: rooms as a scanner
// and a depth camera see them, a room of planes that are nearly parallel, roofs, the scenes of make_scene, and layers.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_LABELED_FRAMES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_LABELED_FRAMES_H

#include "named_clouds.h"

namespace CGAL::Tandem::benchmark {

struct Labeled_frame {
  std::string group; // frames of a group count as one in means over groups
  std::string name;  // of [a-z0-9-]
  std::function<scenes::Scene()> make;
  Task task;
};

// Rooms and roofs.
std::vector<Labeled_frame> labeled_frames();

// House, part, indoor and village, and a noisy house with five seeds.
std::vector<Labeled_frame> labeled_scenes(std::size_t points = 100000);

// Strips side by side, and boards before a wall, 1.1 and 1.3 epsilon apart, with noise of a third of epsilon, with
// three seeds.
std::vector<Labeled_frame> labeled_layers();

// With normals by PCA of 20 neighbors.
Named_cloud make_cloud(const Labeled_frame& frame);

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_LABELED_FRAMES_H
