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
    trials.add(c, "tandem", task, columns, "Tandem, regularized: " + period_name(period));
  }
  trials.write();
}

void plot(const Trials& trials, const std::vector<std::size_t>& periods)
{
  Series_table table(trials.rows(), "series", "period");
  Axis x{"rounds from one regularity step to the next"};
  auto panel_of = [&](const char* label, const char* column) {
    return panel(table, x, "position", label, column, false);
  };
  Plot plot{"Synergy: the same engine, regularized in tandem, afterwards, or never",
            {panel_of("faces found, F1 at IoU .75", "face_f1_75"), panel_of("directions", "directions_exact"),
             panel_of("true parallel pairs made exact", "parallel_kept_exact"),
             panel_of("angle error (degrees)", "angle_error_deg"), panel_of("complexity", "complexity_exact"),
             panel_of("coverage (%)", "coverage_percent")},
            {}};
  plot.panels[1].y.is_logarithmic = true;
  for(std::size_t period : periods)
    plot.x_names.push_back(period_name(period));
  draw(trials.path(), plot);
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
  plot(trials, periods);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
