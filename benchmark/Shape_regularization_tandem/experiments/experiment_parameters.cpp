// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's figures 9 and 11: what the angle tolerance and the size of the
// cells do to the result.

#include "experiment_trials.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

Named_cloud house_for_sweeps(const Experiment_options& options)
{
  return noisy_house({std::size_t(options.is_quick ? 50000 : 200000), 0.001, 0.1, 1});
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
        trials.add(c, task, {method, columns, "", &base});
      }
    }
  trials.write();
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
        append_cell(columns, "points_in_a_cell", size);
        append_cell(columns, "repeat", repeat);
        trials.add(c, task, {"tandem", columns});
      }
  trials.write();
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
