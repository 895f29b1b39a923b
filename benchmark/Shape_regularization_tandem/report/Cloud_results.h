// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The results of all methods on one cloud, and what the page asks of them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CLOUD_RESULTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CLOUD_RESULTS_H

#include "comparison_table.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

// The median over the runs; NaN if it is not known.
inline double median(const Summary& summary, const std::string& column)
{
  std::string text = summary.text({"", column.c_str(), 1, 9, Better::neither});
  return text.empty() ? std::nan("") : std::strtod(text.c_str(), nullptr);
}

inline bool is_cleaned(const Summary& summary) { return cell(summary.first(), "cleaned") == "true"; }

inline bool is_of_run(const Criterion& c)
{
  static const std::vector<std::string> columns = {"seconds", "user_seconds", "bytes_per_point"};
  return std::find(columns.begin(), columns.end(), c.column) != columns.end();
}

// A cleaned result was not run by itself, so its time and memory say nothing.
inline bool concerns(const Criterion& c, const Summary& summary)
{
  return summary.is_finished() && !summary.text(c).empty() && !(is_cleaned(summary) && is_of_run(c));
}

inline bool is_ahead(const Criterion& c, const Summary& summary, const Summary& tandem)
{
  return !summary.is_tandem() && concerns(c, summary) && is_better(c, summary, tandem);
}

struct Cloud_results {
  std::string name, normals; // given or own
  std::vector<Summary> methods;

  const Row& row() const { return methods.front().first(); }
  double points() const { return std::strtod(cell(row(), "points").c_str(), nullptr); }
  bool has_truth() const { return !cell(tandem().first(), "face_f1_50").empty(); }

  // What the others are compared with: the first back end of Tandem that finished.
  const Summary& tandem() const
  {
    for(const Summary& m : methods)
      if(m.is_tandem() && m.is_finished())
        return m;
    return methods.front();
  }

  // Null if it did not take part or did not finish.
  const Summary* find(const std::string& method, bool is_cleaned) const
  {
    for(const Summary& m : methods)
      if(cell(m.first(), "method") == method && benchmark::is_cleaned(m) == is_cleaned)
        return m.is_finished() ? &m : nullptr;
    return nullptr;
  }
};

// In the order of the rows.
inline std::vector<Cloud_results> results_of_clouds(const std::vector<Row>& rows)
{
  std::vector<Cloud_results> clouds;
  for(const Summary& s : summaries(rows)) {
    std::string name = cell(s.first(), "cloud"), normals = cell(s.first(), "normals");
    auto found = std::find_if(clouds.begin(), clouds.end(),
                              [&](const Cloud_results& c) { return c.name == name && c.normals == normals; });
    if(found == clouds.end())
      clouds.push_back({name, normals, {s}});
    else
      found->methods.push_back(s);
  }
  return clouds;
}

// Points that violate the tolerances that the method was given.
inline bool violates_tolerances(const Summary& summary) { return median(summary, "beyond_either") > 0; }

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_CLOUD_RESULTS_H
