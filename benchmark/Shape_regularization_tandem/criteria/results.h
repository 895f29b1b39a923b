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
  append_cell(row, "k", task.k_neighbors);
  append_cell(row, "threads", task.threads);
  append_cell(row, "seed", task.seed);
}

// Seconds and memory; empty where they are not known.
inline void append_run(Row& row, const Run& run)
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
  append_if(true, "user_seconds", run.user);
  append_if(run.peak_bytes > 0, "peak_mib", double(run.peak_bytes) / 1048576);
  append_if(run.peak_bytes > 0, "bytes_per_point", double(run.peak_bytes) / double(run.detection.label.size() + 1e-9));
  append_cell(row, "hash", run.hash);
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_H
