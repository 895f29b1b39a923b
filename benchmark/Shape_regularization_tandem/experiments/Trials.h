// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the experiments share: runs that become rows.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_TRIALS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_TRIALS_H

#include "clouds/named_clouds.h"
#include "Experiment.h"

namespace CGAL::Tandem::benchmark {

struct Trial {
  std::string contestant;
  Row columns;             // the step of the experiment
  std::string method = ""; // its name in the table; by default as the contestant describes itself
};

// The runs of an experiment, printed as they are done and kept as rows.
class Trials {
public:
  Trials(const Experiment_options& options, const std::string& name);

  // One run. The row that was added; the run may have failed.
  const Row& add(const Named_cloud& c, const Task& task, const Trial& trial);

  const std::vector<Row>& rows() const { return rows_; }

  // In the folder of the output: the name of the experiment with a suffix.
  std::string path(const std::string& suffix = "") const { return options_.output + "/" + name_ + suffix; }

  // The rows so far, to NAME.csv: called now and then, so that an interrupted experiment leaves what it has.
  void write() const;

private:
  const Experiment_options& options_;
  std::string name_;
  std::vector<Row> rows_;
};

// Those that the user has named, or the usual ones.
inline std::vector<std::string> methods(const Experiment_options& options, const std::vector<std::string>& usual)
{
  return options.contestants.empty() ? usual : options.contestants;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_TRIALS_H
