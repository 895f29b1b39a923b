// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the subcommands of the benchmark have in common: where to read and write,
// how large, and what a table of results is.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENT_H

#include "contestants/Contestant.h"
#include "criteria/table.h"

namespace CGAL::Tandem::benchmark {

struct Experiment_options {
  bool is_quick = false;                // small clouds, few steps
  std::string output = ".";             // folder of the CSV files; it exists
  std::string data;                     // folder of clouds (TANDEM_DATA); empty: there is none
  unsigned repeats = 3;                 // runs that are timed
  unsigned threads = 0;                 // of parallel contestants; 0: all
  std::vector<std::string> contestants; // names; empty: as the experiment thinks fit
  double simplicity = Task().simplicity, regularity = Task().regularity; // of `labels`
  std::vector<std::string> arguments;                                    // what is left of the command line
};

// A subcommand of tandem_benchmark.
struct Experiment {
  const char* name;
  const char* help;
  void (*run)(const Experiment_options&); // throws what main prints
};

// All contestants on clouds: prints the tables, and writes results.csv (compare.cpp).
void run_compare(const Experiment_options& options);

// This one, and the experiments of the paper (experiments.cpp). Each writes NAME.csv to the folder of the output. All
// are deterministic but for the times.
std::vector<Experiment> experiments();

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EXPERIMENT_H
