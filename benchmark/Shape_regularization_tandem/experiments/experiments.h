// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's experiments, and how time and memory grow: each writes NAME.csv to
// the folder of the output. All are deterministic but for the times.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENTS_H

#include "Experiment.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

void run_table1(const Experiment_options& options);     // experiment_table1.cpp
void run_robustness(const Experiment_options& options); // experiment_robustness.cpp
void run_regularity(const Experiment_options& options); // experiment_parameters.cpp
void run_cell_size(const Experiment_options& options);  // experiment_parameters.cpp
void run_synergy(const Experiment_options& options);    // experiment_synergy.cpp
void run_stability(const Experiment_options& options);  // experiment_stability.cpp
void run_labels(const Experiment_options& options);     // experiment_labels.cpp
void run_scaling(const Experiment_options& options);    // experiment_scaling.cpp

// For the list of subcommands.
inline std::vector<Experiment> paper_experiments()
{
  return {{"table1", "one cloud of each category: time, coverage, error, complexity beside the peers", run_table1},
          {"robustness", "more and more noise and outliers (the paper's figure 7)", run_robustness},
          {"regularity", "coverage against complexity, over the angle tolerance (figure 9)", run_regularity},
          {"cell-size", "time, coverage and complexity over the size of the cells (figure 11)", run_cell_size},
          {"synergy", "from alternation in every round to detection before regularization (figure 12)", run_synergy},
          {"stability", "shapes and coverage over epsilon, on curved objects (figure 14)", run_stability},
          {"labels", "labels against true ones: rooms of a scanner and a depth camera, roofs, scenes", run_labels},
          {"scaling", "time and memory over points, neighbors and threads, with exponents", run_scaling}};
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENTS_H
