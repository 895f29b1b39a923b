// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The clouds of clouds.csv, files and generated scenes, and those of the experiments: with their truth and a task.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_NAMED_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_NAMED_CLOUDS_H

#include "experiments/Experiment.h"
#include "scenes/labeled_scenes.h"

namespace CGAL::Tandem::benchmark {

// A cloud and what a contestant shall do with it.
struct Named_cloud {
  std::string name;
  std::string origin; // in words
  Ply_cloud cloud;    // with normals
  Truth truth;        // without faces where it is not known
  Task task;
};

// The rows of clouds.csv in the folder of the benchmark.
std::vector<Row> cloud_table();

// Whether the cloud of such a row is part of the run: its file is there, and it is for --quick, if that is asked for.
bool is_available(const Row& row, const Experiment_options& options);

Named_cloud load_cloud(const Row& row, const Experiment_options& options);

// A file of the caller: PATH [LABELS] EPSILON ALPHA MINIMUM [CLUSTER_EPSILON].
Named_cloud load_own_cloud(std::vector<std::string> arguments);

// A scene with its truth.
Named_cloud cloud_of(const std::string& name, scenes::Scene scene, const Task& task);

// With normals by PCA of 20 neighbors, or blended ones.
Named_cloud make_cloud(const scenes::Labeled_scene& scene);

struct House {
  std::size_t points;
  double noise, outliers; // fraction of the diagonal, ratio of the points
  std::uint64_t seed;
};

// A house whose normals are as noisy as its points; epsilon follows the noise, as a user would choose it.
Named_cloud noisy_house(const House& house);

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_NAMED_CLOUDS_H
