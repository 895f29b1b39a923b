// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the families of contestants share. Each family is compiled on its own,
// since each has heavy headers.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTESTANTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTESTANTS_H

#include "Contestant.h"
#include "testing/measure.h"

namespace CGAL::Tandem::benchmark {

std::vector<Contestant> tandem_contestants();
std::vector<Contestant> cgal_contestants();
std::vector<Contestant> pcl_contestants(); // none where PCL was not found

inline bool estimates_normals(const Ply_cloud& cloud, const Task& task)
{
  return task.estimates_normals || !cloud.has_normals();
}

// FNV-1a of the labels and of the bits of the planes, as 16 digits.
std::string hash_of(const Detection& detection);

// The last lines of each step.
inline Run finished(Run run, const Meter& meter)
{
  run.user += meter.processor();
  run.peak_bytes = (std::max)(run.peak_bytes, meter.peak_bytes());
  if(run.hash.empty())
    run.hash = hash_of(run.detection);
  run.finished = true;
  return run;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTESTANTS_H
