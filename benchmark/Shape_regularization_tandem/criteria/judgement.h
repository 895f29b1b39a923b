// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All that is said of one run, as columns.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_JUDGEMENT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_JUDGEMENT_H

#include "clouds/named_clouds.h"
#include "segmentation.h"
#include "table.h"

namespace CGAL::Tandem::benchmark {

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
