// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The results of the benchmark as one HTML page that needs no other file.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_H

#include "experiments/Experiment.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

// Reads results.csv, pictures/*.png and the files of the experiments in the folder of the output, as far as they are
// there, and writes index.html beside them.
void run_page(const Experiment_options& options);

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_H
