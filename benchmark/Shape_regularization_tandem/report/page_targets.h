// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the page on the targets of the package: what each asks for at
// least, what is aimed at, and on how many clouds it was reached.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_TARGETS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_TARGETS_H

#include "Cloud_results.h"
#include "html.h"

#include <functional>

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Target {
  std::string what, unit;
  double floor, goal;
  bool is_higher_better;
  int digits;
};

// A value for each cloud on which the target can be measured.
using Measured = std::vector<double>;

inline bool reaches(const Target& target, double value, double bound)
{
  return target.is_higher_better ? value >= bound : value <= bound;
}

inline std::string range_of(const Target& t, Measured values)
{
  std::sort(values.begin(), values.end());
  auto shown = [&](double v) { return html::fixed(v, t.digits) + t.unit; };
  if(shown(values.front()) == shown(values.back()))
    return shown(values.front());
  double middle = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
  return shown(values.front()) + " to " + shown(values.back()) + ", median " + shown(middle);
}

inline std::string verdict(const Target& t, const Measured& values)
{
  auto count = [&](double bound) {
    return std::count_if(values.begin(), values.end(), [&](double v) { return reaches(t, v, bound); });
  };
  auto all = std::ptrdiff_t(values.size()), floor = count(t.floor), goal = count(t.goal);
  if(goal == all)
    return "<td class=goal>goal reached</td>";
  std::string text = all == 1 ? (floor == 1 ? "floor reached" : "missed")
                              : "floor on " + std::to_string(floor) + ", goal on " + std::to_string(goal) + " of " +
                                  std::to_string(all) + " clouds";
  return html::tag(floor == all ? "td class=floor" : "td class=missed", text);
}

inline std::string row_of_target(const Target& t, const Measured& values)
{
  auto bound = [&](double value) {
    return html::tag("td", (t.is_higher_better ? "&ge; " : "&le; ") + html::fixed(value, t.digits) + t.unit);
  };
  std::string row = "<th scope=row>" + t.what + "</th>" + bound(t.floor) + bound(t.goal);
  row += values.empty() ? "<td class=note>not measured in this run</td><td></td>"
                        : html::tag("td", range_of(t, values)) + verdict(t, values);
  return html::tag("tr", row) + "\n";
}

// What a run has to say about the targets.
class Target_table {
public:
  Target_table(const std::vector<Cloud_results>& clouds, const std::vector<Row>& exponents)
    : clouds_(clouds), exponents_(exponents)
  {}

  std::string text() const
  {
    std::string body = speed_rows() + quality_rows() + normals_rows() + guarantee_rows();
    return html::table("<th scope=col>target</th><th scope=col>floor</th><th scope=col>goal</th>"
                       "<th scope=col>measured</th><th scope=col>verdict</th>",
                       body, "The targets of the package");
  }

private:
  using Value = std::function<double(const Cloud_results&)>; // NaN: not on this cloud

  Measured measured(const std::string& normals, const Value& value) const
  {
    Measured values;
    for(const Cloud_results& c : clouds_)
      if(c.normals == normals && c.tandem().is_tandem() && c.tandem().is_finished()) {
        double v = value(c);
        if(std::isfinite(v))
          values.push_back(v);
      }
    return values;
  }

  // Tandem's value and that of a method, on clouds of at least so many points.
  Measured against(const std::string& method, bool is_cleaned, const std::string& column, double minimum_points,
                   const std::function<double(double, double)>& compare) const
  {
    return measured("given", [&](const Cloud_results& c) {
      const Summary* peer = c.find(method, is_cleaned);
      return peer == nullptr || c.points() < minimum_points
               ? std::nan("")
               : compare(median(c.tandem(), column), median(*peer, column));
    });
  }

  std::string speed_rows() const
  {
    auto faster = [&](const std::string& name, const std::string& method, double floor, double goal) {
      return row_of_target(
        {"times faster than " + name, "&times;", floor, goal, true, 1},
        against(method, false, "seconds", 50000, [](double mine, double its) { return its / mine; }));
    };
    Measured seconds = measured("given", [](const Cloud_results& c) {
      return c.points() < 5e5 || c.has_truth() ? std::nan("") : median(c.tandem(), "seconds") / c.points() * 1e6;
    });
    Measured memory = measured("given", [](const Cloud_results& c) {
      return c.points() < 2e5 ? std::nan("") : median(c.tandem(), "bytes_per_point");
    });
    return row_of_target({"time for a million points of a real scan", " s", 2.0, 0.8, false, 2}, seconds) +
           faster("region growing", "growing", 8, 20) + faster("Efficient RANSAC", "ransac", 6, 15) +
           faster("PCL region growing", "pcl-growing", 2, 5) +
           row_of_target({"time over points: exponent (linear + 15 % from 0.5 to 5 million)", "", 1.06, 1.06, false, 2},
                         exponent()) +
           row_of_target({"memory, bytes a point", "", 200, 100, false, 0}, memory);
  }

  Measured exponent() const
  {
    for(const Row& row : exponents_)
      if(cell(row, "method").substr(0, 6) == "Tandem" && cell(row, "quantity") == "seconds" &&
         cell(row, "over") == "points")
        return {std::strtod(cell(row, "exponent").c_str(), nullptr)};
    return {};
  }

  std::string quality_rows() const
  {
    auto difference = [](double mine, double its) { return mine - its; };
    auto percent = [](double mine, double its) { return 100 * (mine - its); };
    auto share = [](double mine, double its) { return mine / its; };
    return row_of_target({"coverage beyond that of cleaned region growing, percentage points", "", -1.5, 0, true, 1},
                         against("growing-cached", true, "coverage", 0, percent)) +
           row_of_target({"exact complexity, as a share of that of region growing, regularized", "", 1, 0.75, false, 2},
                         against("growing+regularize", false, "complexity_exact", 0, share)) +
           row_of_target(
             {"F1 of true faces beyond that of cleaned region growing, same normals", "", 0, 0.001, true, 3},
             against("growing-cached", true, "face_f1_50", 0, difference));
  }

  std::string normals_rows() const
  {
    auto on = [&](const std::string& cloud, const std::string& column) {
      return measured(
        "own", [&](const Cloud_results& c) { return c.name == cloud ? median(c.tandem(), column) : std::nan(""); });
    };
    return row_of_target({"own normals: F1 of true faces, clean house", "", 0.90, 0.95, true, 3},
                         on("house", "face_f1_50")) +
           row_of_target({"own normals: F1 of true faces, noisy house", "", 0.50, 0.75, true, 3},
                         on("house-noisy", "face_f1_50")) +
           row_of_target({"own normals: point precision, noisy house", "", 0.93, 0.93, true, 3},
                         on("house-noisy", "point_precision"));
  }

  // All back ends, and both kinds of normals.
  std::string guarantee_rows() const
  {
    Measured violations, differing;
    for(const Cloud_results& c : clouds_)
      for(const Summary& m : c.methods)
        if(m.is_tandem() && m.is_finished()) {
          violations.push_back(median(m, "beyond_either"));
          differing.push_back(!m.same("same_result") || cell(m.first(), "hash") != cell(c.tandem().first(), "hash") ||
                              cell(m.first(), "same_planes_when_shuffled") == "false" ||
                              median(m, "relabeled_when_shuffled") > 0);
        }
    return row_of_target({"points that violate a tolerance", "", 0, 0, false, 0}, violations) +
           row_of_target({"results that differ between runs, back ends, orders of the points", "", 0, 0, false, 0},
                         differing.empty() ? differing
                                           : Measured{double(std::count(differing.begin(), differing.end(), 1.0))});
  }

  const std::vector<Cloud_results>& clouds_;
  const std::vector<Row>& exponents_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_TARGETS_H
