// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's figure 7: a house under more and more noise, and more and more
// outliers, beside the peers with a regularization afterwards.

#include "experiment_trials.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

struct Sweep {
  const char* name;
  const char* title;
  const char* x_label;
  bool is_noise; // else outliers
  bool has_own_normals;
};

const Sweep sweeps[] = {
  {"noise", "Robustness to noise, given normals as noisy as the points", "noise, sigma (% of the diagonal)", true,
   false},
  {"own-normals", "Robustness to noise, each method with its own normals", "noise, sigma (% of the diagonal)", true,
   true},
  {"outliers", "Robustness to outliers, given normals", "outliers (% of the points)", false, false}};

void plot(const Trials& trials, const Sweep& sweep)
{
  Series_table table(trials.rows_where("sweep", sweep.name), "method", "percent");
  Axis x{sweep.x_label};
  auto panel_of = [&](const char* label, const char* column) { return panel(table, x, "percent", label, column); };
  Plot plot{sweep.title,
            {panel_of("faces found, F1 at IoU .5", "face_f1_50"), panel_of("point precision", "point_precision"),
             panel_of("coverage (%)", "coverage_percent"), panel_of("directions", "directions_relaxed"),
             panel_of("complexity", "complexity_relaxed"),
             panel_of("points beyond tolerances (%)", "violating_percent")},
            {}};
  draw(trials.path(std::string("-") + sweep.name), plot);
}

} // namespace

void run_robustness(const Experiment_options& options)
{
  Trials trials(options, "robustness");
  const std::size_t points = options.is_quick ? 30000 : 100000;
  for(const Sweep& sweep : sweeps) {
    std::vector<double> percents = {0, 0.05, 0.1, 0.2, 0.3, 0.5};
    if(!sweep.is_noise)
      percents = {0, 10, 20, 40, 60, 80};
    if(options.is_quick)
      percents = {percents[0], percents[3]};
    for(double percent : percents)
      for(std::uint64_t seed = 1; seed <= (options.is_quick ? 1u : 3u); ++seed) {
        House house{points, percent / 100, 0.05, seed};
        if(!sweep.is_noise)
          house = {points, 0.001, percent / 100, seed};
        Named_cloud c = noisy_house(house);
        c.task.estimates_normals = sweep.has_own_normals;
        Row columns;
        append_cell(columns, "sweep", sweep.name);
        append_cell(columns, "percent", percent);
        append_cell(columns, "scene_seed", seed);
        for(const std::string& method : regularized_methods(options))
          trials.add(c, method, c.task, columns);
      }
    trials.write();
    plot(trials, sweep);
  }
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
