// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What takes part in a comparison: a detector, the task that it is given, and
// what it did. Contestants differ in nothing else, so an experiment is a loop
// over contestants, clouds and tasks.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTESTANT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTESTANT_H

#include "testing/evaluate.h"
#include "testing/measure.h"
#include "clouds/ply_cloud.h"

#include <CGAL/Tandem/Parameters.h>

#include <functional>

namespace CGAL::Tandem::benchmark {

// The same for all contestants; each reads what concerns it. Lengths in units of the cloud.
struct Task {
  double maximum_distance = 0;                   // epsilon
  double maximum_angle_deg = 25.841932763167124; // alpha: a cosine of 0.9, as in the paper
  std::size_t minimum_region_size = 200;         // points
  double angle_tolerance_deg = 8;                // beta, of all that regularize
  unsigned k_neighbors = 12;                     // Tandem and region growing
  double cluster_epsilon = -1;                   // RANSAC; negative: 1 % of the diagonal, its default
  unsigned threads = 0;                          // of parallel contestants; 0: as many as there are processors
  unsigned seed = 0;                             // of randomized contestants
  bool estimates_normals = false;                // each by its own means, although the cloud may have normals
  double simplicity = Parameters().simplicity;   // Tandem, as the following
  double regularity = Parameters().regularity;
  std::size_t regularity_period = Parameters().regularity_period;
  bool regularizes = true;

  Tolerances tolerances() const { return {maximum_distance, maximum_angle_deg}; }
};

// Seconds are those of the method: neither reading nor the conversion of the cloud counts.
struct Run {
  double normal_seconds = 0;         // estimation of normals, where the task asks for it
  double detection_seconds = 0;      // where it regularizes in tandem, all of it
  double regularization_seconds = 0; // where that is a step of its own
  double user = 0;                   // processor seconds of all threads and steps, user and system
  std::size_t peak_bytes = 0;        // of the process, beyond what it had with the cloud ready; 0: unknown
  bool finished = false;
  Detection detection;
  std::vector<Vec> normals; // those that were used, if the contestant estimated them; null: none
  std::string hash;         // of labels and planes, by Tandem
  std::string error;        // why it did not finish

  double wall() const { return normal_seconds + detection_seconds + regularization_seconds; }
};

struct Contestant {
  std::string name;        // short, of [a-z0-9+-]: in files and options
  std::string description; // in tables
  std::string base;        // the contestant whose result `step` continues, if any
  bool is_tandem = false;
  bool is_random = false; // uses Task::seed

  // Cloud, task, and the run of the base (an empty one if there is no base).
  std::function<Run(const Ply_cloud&, const Task&, const Run&)> step;
};

inline Contestant make_contestant(const std::string& name, const std::string& description,
                                  Run (*step)(const Ply_cloud&, const Task&, const Run&))
{
  Contestant c;
  c.name = name;
  c.description = description;
  c.step = step;
  return c;
}

// All that are compiled in, each after its base. Throws std::invalid_argument for an unknown name.
std::vector<Contestant> contestants();
Contestant contestant(const std::string& name);

// The result without the points that violate the tolerances, and then without the shapes that have become too small:
// what a detector has under the tolerances it was given. `normals` are those that the run used.
Detection cleaned(const Ply_cloud& cloud, const std::vector<Vec>& normals, const Task& task, Detection detection);

// Of the step, after the base that is given; what it throws is the error of a run that did not finish.
Run run_after(const Contestant& contestant, const Ply_cloud& cloud, const Task& task, const Run& base);

// The same after its own base, if it has one.
Run run(const Contestant& contestant, const Ply_cloud& cloud, const Task& task);

// What the families of contestants share. Each family is compiled on its own, since each has heavy headers.
std::vector<Contestant> tandem_contestants();
std::vector<Contestant> cgal_contestants();
std::vector<Contestant> pcl_contestants(); // none where PCL was not found

inline bool estimates_normals(const Ply_cloud& cloud, const Task& task)
{
  return task.estimates_normals || !cloud.has_normals();
}

// The last lines of each step.
inline Run finished(Run run, const Meter& meter)
{
  run.user += meter.processor();
  run.peak_bytes = (std::max)(run.peak_bytes, meter.peak_bytes());
  run.finished = true;
  return run;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CONTESTANT_H
