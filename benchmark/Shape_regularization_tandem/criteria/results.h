// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// results.csv: a row for each run of a contestant, with all that is needed to
// judge it and to repeat it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_H

#include "contestants/Contestant.h"
#include "table.h"

#include <thread>

namespace CGAL::Tandem::benchmark {

inline unsigned number_of_processors() { return (std::max)(1u, std::thread::hardware_concurrency()); }

inline void append_task(Row& row, const std::string& cloud, std::size_t points, const Task& task)
{
  append_cell(row, "cloud", cloud);
  append_cell(row, "points", points);
  append_cell(row, "normals", task.estimates_normals ? "own" : "given");
  append_cell(row, "epsilon", task.maximum_distance);
  append_cell(row, "alpha_deg", task.maximum_angle_deg);
  append_cell(row, "minimum", task.minimum_region_size);
  append_cell(row, "beta_deg", task.angle_tolerance_deg);
  append_cell(row, "sigma", task.offset());
  append_cell(row, "k", task.k_neighbors);
  append_cell(row, "cell_size", task.cell_size);
  append_cell(row, "cluster_epsilon", task.cluster_epsilon);
  append_cell(row, "threads", task.threads);
  append_cell(row, "seed", task.seed);
}

// Seconds and memory. What does not concern a contestant is empty.
inline void append_run(Row& row, const Contestant& contestant, const Run& run)
{
  auto append_if = [&](bool is_known, const std::string& name, double value) {
    if(is_known && run.finished)
      append_cell(row, name, value);
    else
      row.emplace_back(name, "");
  };
  append_cell(row, "finished", run.finished);
  append_cell(row, "error", run.error);
  append_if(true, "seconds", run.wall());
  append_if(true, "normal_seconds", run.normal_seconds);
  append_if(true, "detection_seconds", run.detection_seconds);
  append_if(!contestant.base.empty(), "regularization_seconds", run.regularization_seconds);
  append_if(true, "user_seconds", run.user);
  const Stage_times& t = run.stages;
  const std::pair<const char*, double> stages[] = {{"normals", t.normals},       {"sort", t.sort},
                                                   {"neighbors", t.neighbors},   {"growth", t.growth},
                                                   {"regularity", t.regularity}, {"finish", t.finish}};
  for(const auto& [stage, seconds] : stages)
    append_if(contestant.is_tandem, std::string("stage_") + stage, seconds);
  append_if(run.peak_bytes > 0, "peak_mib", double(run.peak_bytes) / 1048576);
  append_if(run.peak_bytes > 0, "bytes_per_point", double(run.peak_bytes) / double(run.detection.label.size() + 1e-9));
  append_if(contestant.is_tandem, "engine_mib", double(run.engine_bytes) / 1048576);
  append_cell(row, "hash", run.hash);
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_H
