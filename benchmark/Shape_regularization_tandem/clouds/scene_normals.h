// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals as most programs make them: the smallest eigenvector of the k nearest
// points. At edges they are blended, which is what costs detectors thin faces.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SCENE_NORMALS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SCENE_NORMALS_H

#include "scenes/scenes.h"

namespace CGAL::Tandem::scenes {

std::vector<Vec> pca_normals(const std::vector<Vec>& points, unsigned k = 20);

// A scanner that knows its own noise: fitted on the ideal points (so blended at
// edges and arbitrary at outliers), then perturbed.
void set_blended_normals(Scene& scene, double normal_noise_deg, std::uint64_t seed, unsigned k = 20);

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_SCENE_NORMALS_H
