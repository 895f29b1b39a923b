// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The experiments of the paper of which the manual has tables.

#include "Experiment.h"
#include "clouds/named_clouds.h"
#include "criteria/judgement.h"

#include <cstdio>

namespace CGAL::Tandem::benchmark {

namespace {

// --- What the experiments share: runs that become rows.

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

struct Trial {
  std::string contestant;
  Row columns;             // the step of the experiment
  std::string method = ""; // its name in the table; by default as the contestant describes itself
};

// The runs of an experiment, printed as they are done and kept as rows.
class Trials {
public:
  Trials(const Experiment_options& options, const std::string& name) : options_(options), name_(name)
  {
    std::printf("\n%s\n%-28s %-38s %8s %8s %7s %6s %7s %7s %6s\n", name.c_str(), "cloud and step", "method", "seconds",
                "coverage", "shapes", "direct", "planes", "complex", "F1");
  }

  // One run, which may fail.
  void add(const Named_cloud& c, const Task& task, const Trial& trial)
  {
    const Contestant who = contestant(trial.contestant);
    const Run run = benchmark::run(who, c.cloud, task);
    Row row = trial.columns;
    append_cell(row, "contestant", who.name);
    append_cell(row, "method", trial.method.empty() ? who.description : trial.method);
    append_task(row, c.name, c.cloud.points.size(), task);
    append_run(row, run);
    if(run.finished)
      append_judgement(row, c, task, run);
    rows_.push_back(row);
    print(row, trial.columns);
  }

  // The rows so far, to NAME.csv: called now and then, so that an interrupted experiment leaves what it has.
  void write() const { write_csv(options_.output + "/" + name_ + ".csv", rows_); }

private:
  const Experiment_options& options_;
  std::string name_;
  std::vector<Row> rows_;
};

// --- The experiments of the paper

// The paper's figure 7: a house under more and more noise, beside the peers with a regularization afterwards.
void run_robustness(const Experiment_options& options)
{
  Trials trials(options, "robustness");
  const std::size_t points = options.is_quick ? 30000 : 100000;
  const std::vector<std::string> usual = {"tandem", "growing+regularize", "ransac+regularize"};
  for(const std::string sweep : {"noise", "own-normals"}) {
    for(double percent :
        options.is_quick ? std::vector<double>{0, 0.2} : std::vector<double>{0, 0.05, 0.1, 0.2, 0.3, 0.5})
      for(std::uint64_t seed = 1; seed <= (options.is_quick ? 1u : 3u); ++seed) {
        Named_cloud c = noisy_house({points, percent / 100, 0.05, seed});
        c.task.estimates_normals = sweep == "own-normals";
        Row columns;
        append_cell(columns, "sweep", sweep);
        append_cell(columns, "percent", percent);
        append_cell(columns, "scene_seed", seed);
        for(const std::string& method : options.contestants.empty() ? usual : options.contestants)
          trials.add(c, c.task, {method, columns});
      }
    trials.write();
  }
}

// The paper's figure 12: what the alternation of growth and regularization is worth. A regularity step after every round
// of growth, once the detection is complete, by the same engine, and not at all.
void run_synergy(const Experiment_options& options)
{
  constexpr std::size_t more_than_there_are_rounds = 100000;
  Trials trials(options, "synergy");
  for(double noise : options.is_quick ? std::vector<double>{0.002} : std::vector<double>{0, 0.001, 0.002, 0.003})
    for(std::uint64_t seed = 1; seed <= (options.is_quick ? 2u : 5u); ++seed) {
      const Named_cloud c = noisy_house({options.is_quick ? 50000u : 200000u, noise, 100 * noise, seed});
      for(const std::string period : {"each round", "afterwards", "never"}) {
        Task task = c.task;
        task.regularizes = period != "never";
        task.regularity_period = period == "afterwards" ? more_than_there_are_rounds : 1;
        Row columns;
        append_cell(columns, "noise_percent", 100 * noise);
        append_cell(columns, "regularized", period);
        trials.add(c, task, {"tandem", columns, "Tandem, regularized: " + period});
      }
      trials.write();
    }
}

} // namespace

std::vector<Experiment> experiments()
{
  return {
    {"compare",
     "all contestants on clouds of clouds.csv (default: all), or on FILE [LABELS] EPSILON ALPHA MINIMUM [CLUSTER]",
     run_compare},
    {"robustness", "more and more noise (the paper's figure 7)", run_robustness},
    {"synergy", "regularization after each round, at the end, and never (figure 12)", run_synergy}};
}

} // namespace CGAL::Tandem::benchmark
