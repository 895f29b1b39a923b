// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The generated clouds of the experiments, with their truth and a task.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENT_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENT_CLOUDS_H

#include "named_clouds.h"

namespace CGAL::Tandem::benchmark {

// A scene with its truth.
Named_cloud cloud_of(const std::string& name, scenes::Scene scene, const Task& task);

// The twin of a real cloud (scene_twins.h), with the normals of 20 neighbors.
Named_cloud twin_cloud(const std::string& name, std::size_t points, std::uint64_t seed = 1);

struct House {
  std::size_t points;
  double noise, outliers; // share of the diagonal, share of the points
  std::uint64_t seed;
};

// A house whose normals are as noisy as its points; epsilon follows the noise, as a user would choose it.
Named_cloud noisy_house(const House& house);

// A laser scan of the house; clouds of different size differ in density only.
Named_cloud house_scan(std::size_t points);

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENT_CLOUDS_H
