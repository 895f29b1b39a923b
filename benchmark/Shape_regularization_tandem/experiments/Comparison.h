// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All contestants on one cloud, with the same points, tolerances and, if asked
// for, normals: several runs, in turn, each in a process of its own; then the
// criteria of each run as a row.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARISON_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARISON_H

#include "criteria/detection_files.h"
#include "criteria/result_score.h"
#include "criteria/segmentation.h"
#include "clouds/named_clouds.h"
#include "report/Picture_book.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

class Comparison {
public:
  Comparison(const Experiment_options& options, const Named_cloud& named, const std::vector<Contestant>& contestants)
    : options_(options), named_(named),
      graph_(neighbor_graph(named.cloud.points, named.task.k_neighbors, named.task.maximum_distance))
  {
    for(const Contestant& c : contestants)
      entries_.push_back({c, {}, Run()});
  }

  // Contestant by contestant, as many times over as there are repeats, so that a busy while does not hit one alone.
  void measure()
  {
    for(unsigned repeat = 0; repeat < options_.repeats; ++repeat)
      for(Entry& entry : entries_)
        if(!is_slow(entry))
          entry.runs.push_back(run(entry, named_.cloud, repeat));
    if(options_.repeats < 2)
      return;
    const std::vector<std::size_t> order = shuffled_order();
    const Ply_cloud shuffled = in_order(named_.cloud, order);
    for(Entry& entry : entries_)
      if(!is_slow(entry) && entry.contestant.base.empty())
        entry.shuffled = in_first_order(run(entry, shuffled, 0), order);
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
      run.detection = cleaned(named_.cloud, normals_of(run), named_.task, run.detection);
      rows.push_back(row(entry, 0, run, true));
    }
    return rows;
  }

  // Labels and planes of the first runs, as PREFIX.METHOD.labels and .planes.
  void write_detections(const std::string& prefix) const
  {
    for(const Entry& entry : entries_) {
      if(!entry.runs.front().finished)
        continue;
      write_labels(prefix + "." + entry.contestant.name + ".labels", entry.runs.front().detection.label);
      write_planes(prefix + "." + entry.contestant.name + ".planes", entry.runs.front().detection.planes);
    }
  }

  // What the first runs found, as colored clouds: FOLDER/CLOUD.METHOD.ply.
  void draw(const std::string& folder) const
  {
    Picture_book book(named_.cloud, named_.task.tolerances(), folder, named_.name);
    if(!named_.truth.faces.empty())
      book.add_truth({named_.truth.label, named_.truth.faces});
    for(const Entry& entry : entries_)
      if(entry.runs.front().finished)
        book.add(entry.contestant.name, entry.runs.front().detection);
  }

private:
  struct Entry {
    Contestant contestant;
    std::vector<Run> runs;
    Run shuffled; // of the points in another order, with its labels in the first one
  };

  static constexpr double slow = 10; // seconds: it is not run again

  static bool is_slow(const Entry& entry)
  {
    return !entry.runs.empty() && (!entry.runs.back().finished || entry.runs.back().wall() > slow);
  }

  // Random contestants have another seed in each repeat.
  Run run(const Entry& entry, const Ply_cloud& cloud, unsigned repeat) const
  {
    Task task = named_.task;
    task.seed = entry.contestant.is_random ? repeat : 0;
    const std::string& base = entry.contestant.base;
    for(const Entry& other : entries_)
      if(!base.empty() && other.contestant.name == base) {
        const Run& last = other.runs.back();
        if(last.finished)
          return run_isolated(entry.contestant, cloud, task, options_.time_limit, &last);
        Run failed;
        failed.error = base + " did not finish";
        return failed;
      }
    return run_isolated(entry.contestant, cloud, task, options_.time_limit);
  }

  std::vector<std::size_t> shuffled_order() const
  {
    std::vector<std::size_t> order(named_.cloud.points.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    scenes::Random random(7);
    for(std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[std::size_t(random.bits() % i)]);
    return order;
  }

  static Ply_cloud in_order(const Ply_cloud& cloud, const std::vector<std::size_t>& order)
  {
    Ply_cloud result;
    for(std::size_t i : order) {
      result.points.push_back(cloud.points[i]);
      if(cloud.has_normals())
        result.normals.push_back(cloud.normals[i]);
    }
    return result;
  }

  static Run in_first_order(Run run, const std::vector<std::size_t>& order)
  {
    if(!run.finished)
      return run;
    const std::vector<std::int32_t> label = run.detection.label;
    for(std::size_t i = 0; i < order.size(); ++i)
      run.detection.label[order[i]] = label[i];
    return run;
  }

  const std::vector<Vec>& normals_of(const Run& run) const
  {
    return run.normals.empty() ? named_.cloud.normals : run.normals;
  }

  Row row(const Entry& entry, std::size_t repeat, const Run& run, bool is_cleaned) const
  {
    Row row;
    Task task = named_.task;
    const Environment here = environment();
    task.seed = entry.contestant.is_random ? unsigned(repeat) : 0;
    task.threads = !entry.contestant.is_parallel ? 1 : task.threads > 0 ? task.threads : here.processors;
    append_environment(row, here);
    append_task(row, named_.name, named_.cloud.points.size(), task);
    append_cell(row, "method", entry.contestant.name);
    append_cell(row, "description", entry.contestant.description + (is_cleaned ? ", cleaned" : ""));
    append_cell(row, "cleaned", is_cleaned);
    append_cell(row, "repeat", repeat);
    append_run(row, entry.contestant, run);
    if(!run.finished)
      return row;
    const Criteria criteria = evaluate(named_.cloud.points, normals_of(run), run.detection, task.tolerances());
    append_criteria(row, criteria);
    append_curves(row, evaluate_curves(named_.cloud.points, normals_of(run), run.detection, task.tolerances()));
    const Scored_cloud scored = {named_.cloud.points, normals_of(run), graph_, task.tolerances(),
                                 task.minimum_region_size};
    append_score(row, evaluate_score(scored, run.detection), named_.cloud.points.size());
    append_truth_columns(row, run.detection);
    if(!is_cleaned)
      append_spreads(row, entry);
    return row;
  }

  void append_truth_columns(Row& row, const Detection& detection) const
  {
    const std::size_t minimum = named_.task.minimum_region_size;
    const bool is_known = !named_.truth.faces.empty();
    if(is_known)
      append_truth(row, evaluate_truth(named_.truth, detection, extent_of(named_.cloud.points), minimum));
    else
      append_no_truth(row);
    append_segmentation(row, is_known,
                        is_known ? evaluate_segmentation(named_.truth, detection, minimum) : Segmentation());
  }

  // Over the repeats (for random contestants: over the seeds), and against the run on shuffled points.
  static void append_spreads(Row& row, const Entry& entry)
  {
    std::vector<Detection> detections;
    for(const Run& run : entry.runs)
      if(run.finished)
        detections.push_back(run.detection);
    append_spread(row, evaluate_spread(detections));
    if(!entry.shuffled.finished)
      return;
    append_cell(row, "relabeled_when_shuffled",
                share_relabeled(entry.runs.front().detection, entry.shuffled.detection));
    append_cell(row, "same_planes_when_shuffled",
                are_same({{}, entry.runs.front().detection.planes}, {{}, entry.shuffled.detection.planes}));
  }

  const Experiment_options& options_;
  const Named_cloud& named_;
  Neighbor_graph graph_;
  std::vector<Entry> entries_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARISON_H
