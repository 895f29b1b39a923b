// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contestants in processes of their own: this program is started again, and gets
// task and cloud through a file in memory. main() begins with
//   if(is_isolated_call(argc, argv))
//     return isolated_main(argv);

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RUN_ISOLATED_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RUN_ISOLATED_H

#include "Contestant.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

bool is_isolated_call(int argc, char** argv);
int isolated_main(char** argv);

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RUN_ISOLATED_H
