// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's figure 14: over epsilon, the number of shapes that approximate
// curved objects falls smoothly, with no jumps of the coverage.

#include "experiment_trials.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

void run_stability(const Experiment_options& options)
{
  Trials trials(options, "stability");
  const Named_cloud c = twin_cloud("curved", options.is_quick ? 30000 : 200000);
  const double diagonal = extent_of(c.cloud.points).diagonal;
  std::vector<double> percents = {0.1, 0.14, 0.2, 0.28, 0.4, 0.56, 0.8, 1.1, 1.6, 2.2, 3.2};
  if(options.is_quick)
    percents = {0.2, 0.8, 3.2};
  for(double percent : percents)
    for(const std::string& method : regularized_methods(options)) {
      Task task = c.task;
      task.maximum_distance = percent / 100 * diagonal;
      task.maximum_angle_deg = 45; // so that epsilon alone decides how far a shape reaches
      Row columns;
      append_cell(columns, "epsilon_percent", percent);
      trials.add(c, task, {method, columns});
    }
  trials.write();
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
