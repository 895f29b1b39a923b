// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RECORD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RECORD_H

#include "Experiment.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

// Times Tandem on a few clouds, and appends a row for each to history.csv in the folder of the benchmark, with the
// argument as the reason: for changes of speed that were accepted.
void run_record(const Experiment_options& options);

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RECORD_H
