// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's table 1: one cloud of each category. The file of clouds.csv where
// it is in the folder of the data, else a generated twin.

#include "experiment_trials.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

struct Category {
  const char* name;
  const char* cloud; // of clouds.csv
  const char* twin;
};

const Category categories[] = {
  {"terrestrial laser", "sheridan", "terrestrial"}, {"depth camera", "kinect", "kinect"},
  {"mobile mapping", "street", "street"},           {"aerial laser", "autzen", "aerial"},
  {"multi-view stereo", "clocktower", "multiview"}, {"mechanical part", "fandisk", "mechanical"}};

Named_cloud load(const Category& category, const Experiment_options& options)
{
  if(!options.is_quick)
    for(const Row& row : cloud_table(options))
      if(cell(row, "name") == category.cloud && is_available(row, options))
        return load_cloud(row, options);
  Named_cloud c = twin_cloud(category.twin, options.is_quick ? 30000 : 500000);
  c.name += "-twin";
  return c;
}

} // namespace

void run_table1(const Experiment_options& options)
{
  Trials trials(options, "table1");
  int position = 0;
  for(const Category& category : categories) {
    const Named_cloud c = load(category, options);
    Row columns;
    append_cell(columns, "category", category.name);
    append_cell(columns, "position", position++);
    for(const std::string& method : regularized_methods(options)) {
      Task task = c.task;
      task.threads = options.threads;
      trials.add(c, task, {method, columns});
    }
    trials.write();
  }
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
