// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time and memory over points and threads, on scans of one house that
// differ in density only: the same faces, with more points on each.

#include "Trials.h"

#include <cmath>
#include <map>

namespace CGAL::Tandem::benchmark {

namespace {

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

} // namespace

void run_scaling(const Experiment_options& options)
{
  Scaling scaling(options);
  scaling.over_points();
  scaling.over_threads();
}

} // namespace CGAL::Tandem::benchmark
