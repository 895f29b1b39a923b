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

enum class Varied { noise, outliers };
enum class Use_normals { given, own };

struct Sweep {
  const char* name;
  Varied varied;
  Use_normals normals;
};

const Sweep sweeps[] = {{"noise", Varied::noise, Use_normals::given},
                        {"own-normals", Varied::noise, Use_normals::own},
                        {"outliers", Varied::outliers, Use_normals::given}};

} // namespace

void run_robustness(const Experiment_options& options)
{
  Trials trials(options, "robustness");
  const std::size_t points = options.is_quick ? 30000 : 100000;
  for(const Sweep& sweep : sweeps) {
    std::vector<double> percents = {0, 0.05, 0.1, 0.2, 0.3, 0.5};
    if(sweep.varied == Varied::outliers)
      percents = {0, 10, 20, 40, 60, 80};
    if(options.is_quick)
      percents = {percents[0], percents[3]};
    for(double percent : percents)
      for(std::uint64_t seed = 1; seed <= (options.is_quick ? 1u : 3u); ++seed) {
        House house{points, percent / 100, 0.05, seed};
        if(sweep.varied == Varied::outliers)
          house = {points, 0.001, percent / 100, seed};
        Named_cloud c = noisy_house(house);
        c.task.estimates_normals = sweep.normals == Use_normals::own;
        Row columns;
        append_cell(columns, "sweep", sweep.name);
        append_cell(columns, "percent", percent);
        append_cell(columns, "scene_seed", seed);
        for(const std::string& method : regularized_methods(options))
          trials.add(c, c.task, {method, columns});
      }
    trials.write();
  }
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
