// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARE_H

#include "Experiment.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

// Prints the tables, and writes results.csv, and labels and planes into the folder results.
void run_compare(const Experiment_options& options);

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARE_H
