// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Trials.h"
#include "criteria/judgement.h"

#include <cstdio>

namespace CGAL::Tandem::benchmark {

namespace {

void print(const Row& row, const Row& columns)
{
  std::string step = cell(row, "cloud") + (cell(row, "normals") == "own" ? " (own normals)" : "");
  for(const auto& column : columns)
    step += " " + column.second;
  auto get = [&](const char* column) { return cell(row, column); };
  if(get("finished") != "true")
    std::printf("%-28.28s %-38.38s failed: %s\n", step.c_str(), get("method").c_str(), get("error").c_str());
  else
    std::printf("%-28.28s %-38.38s %8.7s %8.5s %7s %6s %7s %7.6s %6.5s\n", step.c_str(), get("method").c_str(),
                get("seconds").c_str(), get("coverage").c_str(), get("shapes").c_str(),
                get("directions_relaxed").c_str(), get("planes_relaxed").c_str(), get("complexity_relaxed").c_str(),
                get("face_f1_50").c_str());
  std::fflush(stdout);
}

} // namespace

Trials::Trials(const Experiment_options& options, const std::string& name) : options_(options), name_(name)
{
  std::printf("\n%s\n%-28s %-38s %8s %8s %7s %6s %7s %7s %6s\n", name.c_str(), "cloud and step", "method", "seconds",
              "coverage", "shapes", "direct", "planes", "complex", "F1");
}

const Row& Trials::add(const Named_cloud& c, const Task& task, const Trial& trial)
{
  const Contestant who = contestant(trial.contestant);
  const Run run = benchmark::run(who, c.cloud, task);
  Row row = trial.columns;
  append_cell(row, "contestant", who.name);
  append_cell(row, "method", trial.method.empty() ? who.description : trial.method);
  append_task(row, c.name, c.cloud.points.size(), task);
  append_run(row, run);
  if(run.finished)
    append_judgement(row, c, task, neighbor_graph(c.cloud.points, task.k_neighbors, task.maximum_distance), run);
  rows_.push_back(row);
  print(row, trial.columns);
  return rows_.back();
}

void Trials::write() const { write_csv(path(".csv"), rows_); }

} // namespace CGAL::Tandem::benchmark
