// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The clouds of clouds.csv: files and generated scenes, with their parameters.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_NAMED_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_NAMED_CLOUDS_H

#include "experiments/Experiment.h"

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
std::vector<Row> cloud_table(const Experiment_options& options);

// Whether the cloud of such a row is part of the run: its file is there, and it is for --quick, if that is asked for.
bool is_available(const Row& row, const Experiment_options& options);

Named_cloud load_cloud(const Row& row, const Experiment_options& options);

// A file of the caller: PATH [LABELS] EPSILON ALPHA MINIMUM [CLUSTER_EPSILON].
Named_cloud load_own_cloud(std::vector<std::string> arguments);

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_NAMED_CLOUDS_H
