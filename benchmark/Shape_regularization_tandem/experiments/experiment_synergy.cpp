// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's figure 12: what the alternation of growth and regularization is
// worth. From a regularity step after every round of growth to a detection that
// is regularized once it is complete, by the same engine; and not at all.

#include "experiment_trials.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

// More than there are rounds.
constexpr std::size_t never_in_the_loop = 100000;

std::string period_name(std::size_t period)
{
  return period == never_in_the_loop ? "afterwards" : period == 0 ? "never" : std::to_string(period);
}

void add_periods(Trials& trials, const Named_cloud& c, const std::string& series,
                 const std::vector<std::size_t>& periods)
{
  double position = 0;
  for(std::size_t period : periods) {
    Task task = c.task;
    if(period == 0)
      task.engine.regularize_parallelism = task.engine.regularize_orthogonality = task.engine.regularize_coplanarity =
        false;
    else
      task.engine.regularity_period = period;
    Row columns;
    append_cell(columns, "series", series);
    append_cell(columns, "period", period_name(period));
    append_cell(columns, "position", position++);
    trials.add(c, task, {"tandem", columns, "Tandem, regularized: " + period_name(period)});
  }
  trials.write();
}

} // namespace

void run_synergy(const Experiment_options& options)
{
  Trials trials(options, "synergy");
  const std::size_t points = options.is_quick ? 50000 : 200000;
  std::vector<std::size_t> periods = {1, 2, 4, 8, never_in_the_loop, 0};
  if(options.is_quick)
    periods = {1, 4, never_in_the_loop, 0};
  for(double noise : options.is_quick ? std::vector<double>{0.002} : std::vector<double>{0, 0.001, 0.002, 0.003})
    for(std::uint64_t seed = 1; seed <= (options.is_quick ? 2u : 5u); ++seed) {
      std::ostringstream series;
      series << "noise " << 100 * noise << " % of the diagonal";
      add_periods(trials, noisy_house({points, noise, 100 * noise, seed}), series.str(), periods);
    }
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
