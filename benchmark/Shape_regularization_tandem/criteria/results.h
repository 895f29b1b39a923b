// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// results.csv: a row for each run of a contestant, with all that is needed to
// judge it and to repeat it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_H

#include "contestants/Contestant.h"
#include "table.h"

namespace CGAL::Tandem::benchmark {

inline void append_task(Row& row, const std::string& cloud, std::size_t points, const Task& task)
{
  append_cell(row, "cloud", cloud);
  append_cell(row, "points", points);
  append_cell(row, "normals", task.estimates_normals ? "own" : "given");
  append_cell(row, "epsilon", task.maximum_distance);
  append_cell(row, "alpha_deg", task.maximum_angle_deg);
  append_cell(row, "minimum", task.minimum_region_size);
  append_cell(row, "k", task.k_neighbors);
}

// Seconds and memory; empty where they are not known.
inline void append_run(Row& row, const Run& run)
{
  append_cell(row, "finished", run.finished);
  append_cell(row, "error", run.error);
  append_cell_if(row, run.finished, "seconds", run.wall());
  append_cell_if(row, run.finished, "user_seconds", run.user);
  append_cell_if(row, run.finished && run.peak_bytes > 0, "peak_mib", double(run.peak_bytes) / 1048576);
  append_cell_if(row, run.finished && run.peak_bytes > 0, "bytes_per_point",
                 double(run.peak_bytes) / double(run.detection.label.size() + 1e-9));
  append_cell(row, "hash", run.hash);
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_H
