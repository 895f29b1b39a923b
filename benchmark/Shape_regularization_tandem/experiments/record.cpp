// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "record.h"
#include "clouds/named_clouds.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

// The fastest of several runs: what else the machine does only slows a run down.
Run fastest_run(const Contestant& contestant, const Named_cloud& named, const Experiment_options& options)
{
  Run best;
  for(unsigned repeat = 0; repeat < options.repeats; ++repeat) {
    Run run = run_isolated(contestant, named.cloud, named.task, options.time_limit);
    if(!run.finished)
      throw std::runtime_error(contestant.name + " on " + named.name + ": " + run.error);
    if(!best.finished || run.wall() < best.wall())
      best = run;
  }
  return best;
}

Row history_row(const Contestant& contestant, const Named_cloud& named, const Run& run)
{
  Row row;
  append_environment(row, environment());
  append_task(row, named.name, named.cloud.points.size(), named.task);
  append_cell(row, "method", contestant.name);
  append_run(row, contestant, run);
  append_criteria(row, evaluate(named.cloud.points, named.cloud.normals, run.detection, named.task.tolerances()));
  return row;
}

} // namespace

void run_record(const Experiment_options& options)
{
  if(options.arguments.size() != 1 || options.arguments[0].empty())
    throw std::invalid_argument("record needs one argument, the reason");
  const std::string path = options.sources + "/history.csv";
  std::vector<Row> rows;
  if(std::ifstream(path))
    rows = read_csv(path);
  for(const Row& cloud : cloud_table(options)) {
    const std::string name = cell(cloud, "name");
    if((name != "building" && name != "house" && name != "sheridan") || !is_available(cloud, options))
      continue;
    const Named_cloud named = load_cloud(cloud, options);
    for(const Contestant& c : contestants())
      if(c.is_tandem) {
        Row row{{"why", options.arguments[0]}};
        const Row measured = history_row(c, named, fastest_run(c, named, options));
        row.insert(row.end(), measured.begin(), measured.end());
        rows.push_back(row);
        std::printf("%-10s %-18s %8s s, hash %s\n", name.c_str(), c.name.c_str(), cell(row, "seconds").c_str(),
                    cell(row, "hash").c_str());
      }
  }
  write_csv(path, rows);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
