// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The experiments of which the manual has tables: those of the paper, and generated clouds with true labels.

#include "Experiment.h"
#include "clouds/named_clouds.h"
#include "criteria/judgement.h"

#include <cstdio>
#include <cstdlib>
#include <map>

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

  // Of the clouds of each group, for each method with given and with own normals.
  void print_means(const std::vector<std::string>& columns) const
  {
    std::map<std::string, std::vector<const Row*>> groups;
    for(const Row& row : rows_)
      if(cell(row, "finished") == "true")
        groups[cell(row, "method") + ", " + cell(row, "normals") + " normals: " + cell(row, "group")].push_back(&row);
    std::printf("\nmeans of groups: ");
    for(const std::string& column : columns)
      std::printf(" %s", column.c_str());
    for(const auto& [name, rows] : groups) {
      std::printf("\n%-60s", name.c_str());
      for(const std::string& column : columns) {
        double sum = 0;
        for(const Row* row : rows)
          sum += std::strtod(cell(*row, column).c_str(), nullptr);
        std::printf(" %7.3f", sum / double(rows.size()));
      }
    }
    std::printf("\n");
  }

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

// --- True labels

// Generated clouds, with given and with own normals, whose group or name has one of the arguments, if there are any.
// criteria/segmentation.h has the columns. Of walls, the last three count.
void run_labels(const Experiment_options& options)
{
  Trials trials(options, "labels");
  const std::vector<std::string> usual = {"tandem-sequential"}, &parts = options.arguments;
  for(const auto& scenes :
      {scenes::labeled_frames(), scenes::labeled_scenes(), scenes::labeled_scan_lines(), scenes::labeled_walls()})
    for(const scenes::Labeled_scene& scene : scenes) {
      const std::string name = scene.group + " " + scene.name;
      const auto is_in_name = [&](const std::string& part) { return name.find(part) != std::string::npos; };
      if(!parts.empty() && std::none_of(parts.begin(), parts.end(), is_in_name))
        continue;
      Named_cloud c = make_cloud(scene);
      c.task.simplicity = options.simplicity;
      c.task.regularity = options.regularity;
      for(const bool own : {false, true})
        for(const std::string& method : options.contestants.empty() ? usual : options.contestants) {
          c.task.estimates_normals = own;
          trials.add(c, c.task, {method, {{"group", scene.group}}});
        }
    }
  trials.write();
  trials.print_means({"segmentation_f", "mean_iou", "segmentation_precision", "segmentation_recall", "over_segmented",
                      "under_segmented", "shapes", "face_f1_50", "point_precision", "top_10_shapes", "top_10_faces",
                      "all_faces_kept", "worst_face_kept", "mean_kept"});
}

} // namespace

std::vector<Experiment> experiments()
{
  return {
    {"compare",
     "all contestants on clouds of clouds.csv (default: all), or on FILE [LABELS] EPSILON ALPHA MINIMUM [CLUSTER]",
     run_compare},
    {"robustness", "more and more noise (the paper's figure 7)", run_robustness},
    {"synergy", "regularization after each round, at the end, and never (figure 12)", run_synergy},
    {"labels", "generated clouds with true labels: all, or those whose group or name has an ARGUMENT", run_labels}};
}

} // namespace CGAL::Tandem::benchmark
