// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All that is said of one run, as columns: what is needed to judge it and to repeat it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_JUDGEMENT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_JUDGEMENT_H

#include "clouds/named_clouds.h"
#include "segmentation.h"
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

// Those that the contestant used.
inline const std::vector<Vec>& normals_of(const Named_cloud& c, const Run& run)
{
  return run.normals.empty() ? c.cloud.normals : run.normals;
}

inline void append_judgement(Row& row, const Named_cloud& c, const Task& task, const Run& run)
{
  const std::vector<Vec>&points = c.cloud.points, &normals = normals_of(c, run);
  const std::size_t minimum = task.minimum_region_size;
  append_criteria(row, evaluate(points, normals, run.detection, task.tolerances()));
  append_curves(row, evaluate_curves(points, normals, run.detection, task.tolerances()));
  const bool is_known = !c.truth.faces.empty();
  append_truth(row, is_known,
               is_known ? evaluate_truth(c.truth, run.detection, extent_of(points), minimum) : Truth_criteria());
  append_segmentation(row, is_known, is_known ? evaluate_segmentation(c.truth, run.detection, minimum) : Segmentation(),
                      is_known ? evaluate_kept(c.truth, run.detection) : Kept_faces());
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_JUDGEMENT_H
