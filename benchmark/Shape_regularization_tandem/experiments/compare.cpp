// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The subcommand `compare`: all contestants on the clouds of clouds.csv, or on a
// cloud of the caller.

#include "compare.h"
#include "Comparison.h"
#include "report/comparison_table.h"
#include "report/view_files.h"

#include <map>
#include <sys/stat.h>

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

std::vector<Contestant> chosen(const Experiment_options& options, std::vector<std::string> names)
{
  if(!options.contestants.empty())
    names = options.contestants;
  if(names.empty())
    return contestants();
  std::vector<Contestant> list;
  for(const std::string& name : names)
    if(name != "pcl-growing" || !options.contestants.empty() || contestants().back().name == name)
      list.push_back(contestant(name));
  return list;
}

class Comparer {
public:
  explicit Comparer(const Experiment_options& options) : options_(options)
  {
    mkdir((options.output + "/results").c_str(), 0777);
    mkdir((options.output + "/pictures").c_str(), 0777);
    if(options.writes_view_files)
      mkdir((options.output + "/views").c_str(), 0777);
  }

  void compare(Named_cloud named)
  {
    const Task& t = named.task;
    std::printf(
      "\n%s: %s\n%zu points, epsilon %g, alpha %g degrees, at least %zu points, k %u; the same normals for all\n",
      named.name.c_str(), named.origin.c_str(), named.cloud.points.size(), t.maximum_distance, t.maximum_angle_deg,
      t.minimum_region_size, t.k_neighbors);
    std::fflush(stdout);
    run(options_, named, {});
    if(options_.writes_view_files)
      write_view_files(options_.output + "/views", named.name, named.cloud, t);

    // Each with the normals that it estimates itself: peers by PCA of 20 neighbors.
    std::printf("%s, each with its own normals\n", named.name.c_str());
    named.task.estimates_normals = true;
    Experiment_options once = options_;
    once.repeats = 1;
    run(once, named, {"tandem", "growing-cached", "growing+regularize", "ransac", "pcl-growing"});
  }

  void write() const
  {
    write_csv(options_.output + "/results.csv", rows_);
    write_csv(options_.output + "/comparison.csv", table_);
  }

  const std::vector<Row>& rows() const { return rows_; }

private:
  void run(const Experiment_options& options, const Named_cloud& named, const std::vector<std::string>& names)
  {
    Comparison comparison(options, named, chosen(options, names));
    comparison.measure();
    const std::vector<Row> rows = comparison.rows();
    const std::vector<Summary> all = summaries(rows);
    print_table(all);
    for(const Summary& summary : all) {
      table_.push_back(summary_row(summary, all.front()));
      append_environment(table_.back(), environment());
    }
    const std::string normals = named.task.estimates_normals ? "own" : "given";
    comparison.write_detections(options.output + "/results/" + named.name + "." + normals);
    if(!named.task.estimates_normals)
      comparison.draw(options.output + "/pictures");
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    write(); // what is there so far, should something end the program
  }

  Experiment_options options_;
  std::vector<Row> rows_;  // a row for each run
  std::vector<Row> table_; // and for each method
};

// What is guaranteed: each run finishes, its points are within the tolerances, and runs, back ends and orders of the
// points give the same.
std::string complaint(const std::vector<Row>& rows)
{
  std::map<std::string, std::string> hash;
  for(const Row& row : rows) {
    if(cell(row, "method").compare(0, 6, "tandem") != 0)
      continue;
    const std::string cloud = cell(row, "cloud") + ", " + cell(row, "normals") + " normals";
    if(cell(row, "finished") != "true")
      return cloud + ": " + cell(row, "error");
    if(cell(row, "beyond_either") != "0")
      return cloud + ": points violate the tolerances";
    if(cell(row, "same_planes_when_shuffled") == "false")
      return cloud + ": other planes when the points are shuffled";
    if(hash.emplace(cloud, cell(row, "hash")).first->second != cell(row, "hash"))
      return cloud + ": the runs or back ends of Tandem differ";
  }
  return "";
}

// Rows of the table: those that are named, or all whose files are there.
std::vector<Row> chosen_clouds(const Experiment_options& options)
{
  const std::vector<Row> table = cloud_table(options);
  std::vector<Row> rows;
  for(const Row& row : table)
    if(options.arguments.empty() && is_available(row, options))
      rows.push_back(row);
  for(const std::string& name : options.arguments) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const Row& r) { return cell(r, "name") == name; });
    if(found == table.end())
      throw std::invalid_argument("there is no cloud " + name + " in clouds.csv");
    if(!is_available(*found, options))
      throw std::invalid_argument("the cloud " + name + " is not part of --quick, or its file " + cell(*found, "file") +
                                  " is not in the folder of clouds (--data, TANDEM_DATA)");
    rows.push_back(*found);
  }
  return rows;
}

} // namespace

void run_compare(const Experiment_options& options)
{
  Comparer comparer(options);
  const std::vector<std::string>& arguments = options.arguments;
  if(!arguments.empty() && arguments[0].find('.') != std::string::npos)
    comparer.compare(load_own_cloud(arguments));
  else
    for(const Row& row : chosen_clouds(options))
      comparer.compare(load_cloud(row, options));
  print_legend();
  comparer.write();
  const std::string wrong = complaint(comparer.rows());
  if(!wrong.empty())
    throw std::runtime_error("Tandem failed on " + wrong);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
