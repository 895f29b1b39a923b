// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The subcommand `compare`: all contestants on the clouds of clouds.csv, or on a cloud of the caller.

#include "Experiment.h"
#include "clouds/named_clouds.h"
#include "comparison_table.h"
#include "criteria/judgement.h"

namespace CGAL::Tandem::benchmark {

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

// All contestants on one cloud, with the same points, tolerances and, if asked for, normals: several runs, in turn; then
// the criteria of each run as a row.
class Comparison {
public:
  Comparison(const Experiment_options& options, const Named_cloud& named, const std::vector<Contestant>& contestants)
    : options_(options), named_(named)
  {
    for(const Contestant& c : contestants)
      entries_.push_back({c, {}});
  }

  // Contestant by contestant, as many times over as there are repeats, so that a busy while does not hit one alone.
  void measure()
  {
    for(unsigned repeat = 0; repeat < options_.repeats; ++repeat)
      for(Entry& entry : entries_)
        if(!is_slow(entry))
          entry.runs.push_back(run(entry, repeat));
  }

  // A row for each run, and, for each peer, one of the cleaned result of its first run.
  std::vector<Row> rows() const
  {
    std::vector<Row> rows;
    for(const Entry& entry : entries_) {
      for(std::size_t r = 0; r < entry.runs.size(); ++r)
        rows.push_back(row(entry, r, entry.runs[r], false));
      const Run& first = entry.runs.front();
      if(entry.contestant.is_tandem || !first.finished)
        continue;
      Run run = first;
      run.detection = cleaned(named_.cloud, normals_of(named_, run), named_.task, run.detection);
      rows.push_back(row(entry, 0, run, true));
    }
    return rows;
  }

private:
  struct Entry {
    Contestant contestant;
    std::vector<Run> runs;
  };

  static constexpr double slow = 10; // seconds: it is not run again

  static bool is_slow(const Entry& entry)
  {
    return !entry.runs.empty() && (!entry.runs.back().finished || entry.runs.back().wall() > slow);
  }

  // Random contestants have another seed in each repeat. The base, where it takes part, has run before.
  Run run(const Entry& entry, unsigned repeat) const
  {
    Task task = named_.task;
    task.seed = entry.contestant.is_random ? repeat : 0;
    const std::string& base = entry.contestant.base;
    for(const Entry& other : entries_)
      if(!base.empty() && other.contestant.name == base)
        return run_after(entry.contestant, named_.cloud, task, other.runs.back());
    return benchmark::run(entry.contestant, named_.cloud, task);
  }

  Row row(const Entry& entry, std::size_t repeat, const Run& run, bool is_cleaned) const
  {
    Row row;
    append_task(row, named_.name, named_.cloud.points.size(), named_.task);
    append_cell(row, "method", entry.contestant.name);
    append_cell(row, "description", entry.contestant.description + (is_cleaned ? ", cleaned" : ""));
    append_cell(row, "cleaned", is_cleaned);
    append_cell(row, "repeat", repeat);
    append_run(row, run);
    if(!run.finished)
      return row;
    append_judgement(row, named_, named_.task, run);
    return row;
  }

  const Experiment_options& options_;
  const Named_cloud& named_;
  std::vector<Entry> entries_;
};

// Adds a row for each run, and writes what is there so far, should something end the program.
void compare(const Experiment_options& options, const Named_cloud& named, const std::vector<std::string>& names,
             std::vector<Row>& rows)
{
  Comparison comparison(options, named, chosen(options, names));
  comparison.measure();
  const std::vector<Row> added = comparison.rows();
  print_table(summaries(added));
  rows.insert(rows.end(), added.begin(), added.end());
  write_csv(options.output + "/results.csv", rows);
}

void compare(const Experiment_options& options, Named_cloud named, std::vector<Row>& rows)
{
  const Task& t = named.task;
  std::printf(
    "\n%s: %s\n%zu points, epsilon %g, alpha %g degrees, at least %zu points, k %u; the same normals for all\n",
    named.name.c_str(), named.origin.c_str(), named.cloud.points.size(), t.maximum_distance, t.maximum_angle_deg,
    t.minimum_region_size, t.k_neighbors);
  std::fflush(stdout);
  compare(options, named, {}, rows);

  // Each with the normals that it estimates itself: peers by PCA of 20 neighbors.
  std::printf("%s, each with its own normals\n", named.name.c_str());
  named.task.estimates_normals = true;
  Experiment_options once = options;
  once.repeats = 1;
  compare(once, named, {"tandem", "growing-cached", "growing+regularize", "ransac", "pcl-growing"}, rows);
}

// What is guaranteed: each run finishes, its points are within the tolerances, and runs and back ends give the same.
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
    if(hash.emplace(cloud, cell(row, "hash")).first->second != cell(row, "hash"))
      return cloud + ": the runs or back ends of Tandem differ";
  }
  return "";
}

// Rows of the table: those that are named, or all whose files are there.
std::vector<Row> chosen_clouds(const Experiment_options& options)
{
  const std::vector<Row> table = cloud_table();
  std::vector<Row> rows;
  for(const Row& row : table)
    if(options.arguments.empty() && is_available(row, options))
      rows.push_back(row);
  for(const std::string& name : options.arguments) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const Row& r) { return cell(r, "name") == name; });
    if(found == table.end() || !is_available(*found, options))
      throw std::invalid_argument("the cloud " + name +
                                  " is not in clouds.csv, not part of --quick, or its file is not in " +
                                  "the folder of clouds (--data, TANDEM_DATA)");
    rows.push_back(*found);
  }
  return rows;
}

} // namespace

void run_compare(const Experiment_options& options)
{
  std::vector<Row> rows;
  const std::vector<std::string>& arguments = options.arguments;
  if(!arguments.empty() && arguments[0].find('.') != std::string::npos)
    compare(options, load_own_cloud(arguments), rows);
  else
    for(const Row& row : chosen_clouds(options))
      compare(options, load_cloud(row, options), rows);
  print_legend();
  write_csv(options.output + "/results.csv", rows);
  const std::string wrong = complaint(rows);
  if(!wrong.empty())
    throw std::runtime_error("Tandem failed on " + wrong);
}

} // namespace CGAL::Tandem::benchmark
