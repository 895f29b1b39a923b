// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The experiments of the paper, the labels of all detectors, and how time and memory grow.

#include "Experiment.h"
#include "clouds/named_clouds.h"
#include "criteria/judgement.h"

#include <cmath>
#include <cstdio>
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

  // One run. The row that was added; the run may have failed.
  const Row& add(const Named_cloud& c, const Task& task, const Trial& trial)
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

  const std::vector<Row>& rows() const { return rows_; }

  // In the folder of the output: the name of the experiment with a suffix.
  std::string path(const std::string& suffix) const { return options_.output + "/" + name_ + suffix; }

  // The rows so far, to NAME.csv: called now and then, so that an interrupted experiment leaves what it has.
  void write() const { write_csv(path(".csv"), rows_); }

private:
  const Experiment_options& options_;
  std::string name_;
  std::vector<Row> rows_;
};

// Those that the user has named, or the usual ones.
std::vector<std::string> methods(const Experiment_options& options, const std::vector<std::string>& usual)
{
  return options.contestants.empty() ? usual : options.contestants;
}

// --- The experiments of the paper

std::vector<std::string> regularized_methods(const Experiment_options& options)
{
  return methods(options, {"tandem", "growing+regularize", "ransac+regularize"});
}

// The paper's figure 7: a house under more and more noise, and more and more outliers, beside the peers with a
// regularization afterwards.
void run_robustness(const Experiment_options& options)
{
  Trials trials(options, "robustness");
  const std::size_t points = options.is_quick ? 30000 : 100000;
  for(const std::string sweep : {"noise", "own-normals", "outliers"}) {
    std::vector<double> percents = {0, 0.05, 0.1, 0.2, 0.3, 0.5};
    if(sweep == "outliers")
      percents = {0, 10, 20, 40, 60, 80};
    if(options.is_quick)
      percents = {percents[0], percents[3]};
    for(double percent : percents)
      for(std::uint64_t seed = 1; seed <= (options.is_quick ? 1u : 3u); ++seed) {
        House house{points, percent / 100, 0.05, seed};
        if(sweep == "outliers")
          house = {points, 0.001, percent / 100, seed};
        Named_cloud c = noisy_house(house);
        c.task.estimates_normals = sweep == "own-normals";
        Row columns;
        append_cell(columns, "sweep", sweep);
        append_cell(columns, "percent", percent);
        append_cell(columns, "scene_seed", seed);
        for(const std::string& method : regularized_methods(options))
          trials.add(c, c.task, {method, columns});
      }
    trials.write();
  }
}

// The paper's figures 9 and 11: what the angle tolerance and the size of the cells do to the result.
Named_cloud house_for_sweeps(const Experiment_options& options)
{
  return noisy_house({std::size_t(options.is_quick ? 50000 : 200000), 0.001, 0.1, 1});
}

void run_regularity(const Experiment_options& options)
{
  Trials trials(options, "regularity");
  std::vector<Named_cloud> cases = {house_for_sweeps(options), load_cloud(cloud_row("part"), options)};
  if(!options.is_quick)
    cases.push_back(load_cloud(cloud_row("indoor"), options));
  std::vector<double> betas = {0, 1, 2, 4, 8, 12, 16, 24};
  if(options.is_quick)
    betas = {0, 8, 24};
  for(const Named_cloud& c : cases)
    for(const std::string& method : regularized_methods(options))
      for(double beta : betas) {
        Task task = c.task;
        task.angle_tolerance_deg = beta;
        Row columns;
        append_cell(columns, "beta", beta);
        trials.add(c, task, {method, columns});
      }
  trials.write();
}

void run_cell_size(const Experiment_options& options)
{
  Trials trials(options, "cell-size");
  std::vector<Named_cloud> cases = {house_for_sweeps(options)};
  if(!options.is_quick)
    for(const char* name : {"indoor", "village"})
      cases.push_back(load_cloud(cloud_row(name), options));
  for(const Named_cloud& c : cases)
    for(std::size_t size = 512; size <= 65536; size *= options.is_quick ? 8 : 2)
      for(unsigned repeat = 0; repeat < (options.is_quick ? 1 : options.repeats); ++repeat) {
        Task task = c.task;
        task.cell_size = size;
        task.threads = options.threads;
        Row columns;
        append_cell(columns, "points_in_a_cell", size);
        append_cell(columns, "repeat", repeat);
        trials.add(c, task, {"tandem", columns});
      }
  trials.write();
}

// The paper's figure 12: what the alternation of growth and regularization is worth. From a regularity step after every
// round of growth to a detection that is regularized once it is complete, by the same engine; and not at all.
// More than there are rounds.
constexpr std::size_t never_in_the_loop = 100000;

std::string period_name(std::size_t period)
{
  return period == never_in_the_loop ? "afterwards" : period == 0 ? "never" : std::to_string(period);
}

void add_periods(Trials& trials, const Named_cloud& c, const std::string& series,
                 const std::vector<std::size_t>& periods)
{
  double position = 0;
  for(std::size_t period : periods) {
    Task task = c.task;
    if(period == 0)
      task.regularizes = false;
    else
      task.regularity_period = period;
    Row columns;
    append_cell(columns, "series", series);
    append_cell(columns, "period", period_name(period));
    append_cell(columns, "position", position++);
    trials.add(c, task, {"tandem", columns, "Tandem, regularized: " + period_name(period)});
  }
  trials.write();
}

void run_synergy(const Experiment_options& options)
{
  Trials trials(options, "synergy");
  const std::size_t points = options.is_quick ? 50000 : 200000;
  std::vector<std::size_t> periods = {1, 2, 4, 8, never_in_the_loop, 0};
  if(options.is_quick)
    periods = {1, 4, never_in_the_loop, 0};
  for(double noise : options.is_quick ? std::vector<double>{0.002} : std::vector<double>{0, 0.001, 0.002, 0.003})
    for(std::uint64_t seed = 1; seed <= (options.is_quick ? 2u : 5u); ++seed) {
      std::ostringstream series;
      series << "noise " << 100 * noise << " % of the diagonal";
      add_periods(trials, noisy_house({points, noise, 100 * noise, seed}), series.str(), periods);
    }
}

// The paper's figure 14: over epsilon, the number of shapes that approximate curved objects falls smoothly, with no jumps
// of the coverage.
void run_stability(const Experiment_options& options)
{
  Trials trials(options, "stability");
  const Named_cloud c = load_cloud(cloud_row("curved"), options);
  const double diagonal = extent_of(c.cloud.points).diagonal;
  std::vector<double> percents = {0.1, 0.14, 0.2, 0.28, 0.4, 0.56, 0.8, 1.1, 1.6, 2.2, 3.2};
  if(options.is_quick)
    percents = {0.2, 0.8, 3.2};
  for(double percent : percents)
    for(const std::string& method : regularized_methods(options)) {
      Task task = c.task;
      task.maximum_distance = percent / 100 * diagonal;
      task.maximum_angle_deg = 45; // so that epsilon alone decides how far a shape reaches
      Row columns;
      append_cell(columns, "epsilon_percent", percent);
      trials.add(c, task, {method, columns});
    }
  trials.write();
}

// With given and with own normals.
void run_labels(const Experiment_options& options)
{
  Trials trials(options, "labels");
  std::vector<scenes::Labeled_scene> frames = scenes::labeled_frames();
  for(const scenes::Labeled_scene& scene : scenes::labeled_scenes())
    frames.push_back(scene);
  std::string group;
  for(const scenes::Labeled_scene& frame : frames) {
    if(options.is_quick && frame.group == group)
      continue;
    group = frame.group;
    const Named_cloud cloud = make_cloud(frame);
    for(const char* normals : {"given", "own"}) {
      Task task = cloud.task;
      task.threads = options.threads;
      task.estimates_normals = normals == std::string("own");
      for(const std::string& method : methods(options, {"tandem", "growing-cached", "ransac", "growing+regularize"}))
        trials.add(cloud, task, {method, {{"group", frame.group}}});
    }
    trials.write();
  }
}

// The paper's table 1: one cloud of each category, whose file is in the folder of the data; with --quick, a generated one.
struct Category {
  const char* name;
  const char* cloud; // of clouds.csv
};

const std::vector<Category> categories = {{"terrestrial laser", "sheridan"},   {"depth camera", "kinect"},
                                          {"mobile mapping", "street"},        {"aerial laser", "autzen"},
                                          {"multi-view stereo", "clocktower"}, {"mechanical part", "fandisk"}};

void run_table1(const Experiment_options& options)
{
  Trials trials(options, "table1");
  int position = 0;
  for(const Category& category : options.is_quick ? std::vector<Category>{{"mechanical part", "part"}} : categories) {
    const Row row = cloud_row(category.cloud);
    if(!is_available(row, options))
      continue;
    const Named_cloud c = load_cloud(row, options);
    Row columns;
    append_cell(columns, "category", category.name);
    append_cell(columns, "position", position++);
    for(const std::string& method : regularized_methods(options)) {
      Task task = c.task;
      task.threads = options.threads;
      trials.add(c, task, {method, columns});
    }
    trials.write();
  }
}

// --- Time and memory over points and threads, on scans of one house that
// differ in density only: the same faces, with more points on each.

// A contestant that took longer, in processor seconds, does not get the next larger cloud.
double patience(const Experiment_options& options) { return options.is_quick ? 2 : 40; }

// The exponent of a power law, by least squares of the logarithms.
double exponent(const std::map<double, double>& values)
{
  double n = double(values.size()), x = 0, y = 0, xx = 0, xy = 0;
  for(const auto& value : values) {
    double lx = std::log(value.first), ly = std::log(value.second);
    x += lx;
    y += ly;
    xx += lx * lx;
    xy += lx * ly;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

class Scaling {
public:
  explicit Scaling(const Experiment_options& options) : options_(options), trials_(options, "scaling") {}

  void over_points()
  {
    std::vector<std::size_t> sizes = {100000, 316000, 1000000, 3160000, 10000000};
    if(options_.is_quick)
      sizes = {20000, 60000, 180000};
    std::vector<std::string> names = methods(options_, usual());
    for(std::size_t size : sizes) {
      Named_cloud c = house_scan(size);
      std::vector<std::string> patient;
      for(const std::string& name : names)
        if(add(c, "points", double(size), name, c.task) < patience(options_))
          patient.push_back(name);
      names = patient;
    }
    finish("points");
  }

  void over_threads()
  {
    Named_cloud c = house_scan(options_.is_quick ? 100000 : 1000000);
    const unsigned all = number_of_processors();
    for(unsigned threads = 1; threads <= all; threads = threads < all ? (std::min)(2 * threads, all) : all + 1) {
      Task task = c.task;
      task.threads = threads;
      add(c, "threads", threads, "tandem", task);
    }
    finish("threads");
  }

private:
  static std::vector<std::string> usual()
  {
    std::vector<std::string> names = {"tandem", "tandem-sequential", "growing-cached", "growing", "ransac"};
    for(const Contestant& c : contestants())
      if(c.name == "pcl-growing")
        names.push_back(c.name);
    return names;
  }

  // The processor seconds of the fastest run; for ever, if one failed.
  double add(const Named_cloud& c, const std::string& sweep, double value, const std::string& name, const Task& task)
  {
    double fastest = 1e300;
    for(unsigned repeat = 0; repeat < (options_.is_quick ? 1 : options_.repeats); ++repeat) {
      Row columns;
      append_cell(columns, "sweep", sweep);
      append_cell(columns, "value", value);
      const Row& row = trials_.add(c, task, {name, columns});
      if(cell(row, "finished") != "true")
        return 1e300;
      fastest = (std::min)(fastest, std::atof(cell(row, "user_seconds").c_str()));
      if(fastest > 10)
        break;
    }
    return fastest;
  }

  // Writes the rows, and the exponents of the sweep.
  void finish(const std::string& sweep)
  {
    for(const char* quantity : {"seconds", "user_seconds", "peak_mib"})
      for(const auto& [method, values] : least_values(sweep, quantity)) {
        if(values.size() < 2)
          continue;
        const double value = exponent(values);
        std::printf("%-32s %-10s ~ %s^%.2f\n", method.c_str(), quantity, sweep.c_str(), value);
        exponents_.push_back({{"method", method}, {"quantity", quantity}, {"over", sweep}});
        append_cell(exponents_.back(), "exponent", value);
      }
    trials_.write();
    write_csv(trials_.path("-exponents.csv"), exponents_);
  }

  // By method and value of the sweep: the least over the repeats, since errors of times are positive.
  std::map<std::string, std::map<double, double>> least_values(const std::string& sweep, const char* quantity) const
  {
    std::map<std::string, std::map<double, double>> least;
    for(const Row& row : trials_.rows()) {
      const double y = std::atof(cell(row, quantity).c_str());
      if(cell(row, "sweep") != sweep || !(y > 0))
        continue;
      const auto entry = least[cell(row, "method")].emplace(std::atof(cell(row, "value").c_str()), y).first;
      entry->second = (std::min)(entry->second, y);
    }
    return least;
  }

  const Experiment_options& options_;
  Trials trials_;
  std::vector<Row> exponents_;
};

void run_scaling(const Experiment_options& options)
{
  Scaling scaling(options);
  scaling.over_points();
  scaling.over_threads();
}

} // namespace

std::vector<Experiment> experiments()
{
  return {
    {"compare",
     "all contestants on clouds of clouds.csv (default: all), or on FILE [LABELS] EPSILON ALPHA MINIMUM [CLUSTER]",
     run_compare},
    {"table1", "one cloud of each category: time, coverage, error, complexity beside the peers", run_table1},
    {"robustness", "more and more noise and outliers (the paper's figure 7)", run_robustness},
    {"regularity", "coverage against complexity, over the angle tolerance (figure 9)", run_regularity},
    {"cell-size", "time, coverage and complexity over the size of the cells (figure 11)", run_cell_size},
    {"synergy", "from alternation in every round to detection before regularization (figure 12)", run_synergy},
    {"stability", "shapes and coverage over epsilon, on curved objects (figure 14)", run_stability},
    {"labels", "labels against true ones: rooms of a scanner and a depth camera, roofs, scenes", run_labels},
    {"scaling", "time and memory over points and threads, with exponents", run_scaling}};
}

} // namespace CGAL::Tandem::benchmark
