// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's figures 9 and 11: what the angle tolerance and the size of the
// leaves do to the result.

#include "experiment_trials.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

Named_cloud house_for_sweeps(const Experiment_options& options)
{
  return noisy_house({std::size_t(options.is_quick ? 50000 : 200000), 0.001, 0.1, 1});
}

void plot_regularity(const Trials& trials)
{
  for(const char* cloud : {"house", "kinect", "street"}) {
    std::vector<Row> rows = trials.rows_where("cloud", cloud);
    if(rows.empty())
      continue;
    Series_table table(rows, "method", "beta");
    Axis beta{"angle tolerance beta (degrees)"}, complexity{"complexity"};
    Plot plot{std::string("Regularity against coverage: ") + cloud + ", marks are beta in degrees",
              {{complexity, {"coverage (%)"}, table("complexity_relaxed", "coverage_percent", true)},
               panel(table, beta, "beta", "complexity", "complexity_relaxed"),
               panel(table, beta, "beta", "mean distance (epsilons)", "mean_distance_in_epsilons"),
               panel(table, beta, "beta", "true orthogonal pairs kept", "orthogonal_kept_relaxed"),
               panel(table, beta, "beta", "false parallel pairs", "parallel_false_relaxed"),
               panel(table, beta, "beta", "points beyond tolerances (%)", "violating_percent")},
              {}};
    draw(trials.path(std::string("-") + cloud), plot);
  }
}

} // namespace

void run_regularity(const Experiment_options& options)
{
  Trials trials(options, "regularity");
  const std::size_t points = options.is_quick ? 30000 : 200000;
  std::vector<Named_cloud> cases = {house_for_sweeps(options)};
  for(const char* name : {"kinect", "street"})
    if(!options.is_quick || cases.size() < 2)
      cases.push_back(twin_cloud(name, points));
  std::vector<double> betas = {0, 1, 2, 4, 8, 12, 16, 24};
  if(options.is_quick)
    betas = {0, 8, 24};
  for(const Named_cloud& c : cases)
    for(const std::string& method : regularized_methods(options)) {
      const Run base = trials.run_base(c, method, c.task); // does not depend on beta
      for(double beta : betas) {
        Task task = c.task;
        task.angle_tolerance_deg = beta;
        Row columns;
        append_cell(columns, "beta", beta);
        trials.add(c, method, task, columns, "", &base);
      }
    }
  trials.write();
  plot_regularity(trials);
}

void run_cell_size(const Experiment_options& options)
{
  Trials trials(options, "cell-size");
  std::vector<Named_cloud> cases = {house_for_sweeps(options)};
  if(!options.is_quick)
    for(const char* name : {"kinect", "street"})
      cases.push_back(twin_cloud(name, 300000));
  for(const Named_cloud& c : cases)
    for(std::size_t size = 512; size <= 65536; size *= options.is_quick ? 8 : 2)
      for(unsigned repeat = 0; repeat < (options.is_quick ? 1 : options.repeats); ++repeat) {
        Task task = c.task;
        task.cell_size = size;
        task.threads = options.threads;
        Row columns;
        append_cell(columns, "points_in_a_leaf", size);
        append_cell(columns, "repeat", repeat);
        trials.add(c, "tandem", task, columns);
      }
  trials.write();
  Series_table table(trials.rows(), "cloud", "points_in_a_leaf", Repeats::least);
  Axis x{"largest number of points in a leaf", true};
  auto panel_of = [&](const char* label, const char* column) {
    return panel(table, x, "points_in_a_leaf", label, column);
  };
  draw(trials.path(), {"Size of the leaves: time and quality of Tandem",
                       {panel_of("time (s)", "seconds"), panel_of("of which growth (s)", "stage_growth"),
                        panel_of("coverage (%)", "coverage_percent"), panel_of("complexity", "complexity_exact")},
                       {}});
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
