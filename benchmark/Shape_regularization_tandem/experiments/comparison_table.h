// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rows of a comparison as a table, in which every value in which a peer is better than Tandem is marked.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARISON_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARISON_TABLE_H

#include "criteria/table.h"

#include <cstdio>
#include <cstdlib>
#include <map>

namespace CGAL::Tandem::benchmark {

enum class Better { lower, higher, neither };

struct Criterion {
  const char* title;
  const char* column;
  double scale;
  int digits;
  Better better;
};

// What is shown of each method. Shapes, directions and planes enter the complexity.
inline const Criterion shown_criteria[] = {{"seconds", "seconds", 1, 2, Better::lower},
                                           {"CPU s", "user_seconds", 1, 2, Better::lower},
                                           {"B/point", "bytes_per_point", 1, 0, Better::lower},
                                           {"shapes", "shapes", 1, 0, Better::neither},
                                           {"direc.", "directions_relaxed", 1, 0, Better::neither},
                                           {"planes", "planes_relaxed", 1, 0, Better::neither},
                                           {"cpx", "complexity_relaxed", 1, 3, Better::lower},
                                           {"cover.%", "coverage", 100, 1, Better::higher},
                                           {"top10%", "top_10_shapes", 100, 1, Better::higher},
                                           {"mean/e", "mean_distance_in_epsilons", 1, 3, Better::lower},
                                           {"max/e", "max_distance_in_epsilons", 1, 1, Better::lower},
                                           {">eps", "beyond_epsilon", 1, 0, Better::lower},
                                           {">alpha", "beyond_alpha", 1, 0, Better::lower},
                                           {"F1", "face_f1_50", 1, 3, Better::higher},
                                           {"prec.", "point_precision", 1, 3, Better::higher}};

// The runs of one method on one cloud: their median, column by column.
class Summary {
public:
  explicit Summary(const Row& row) { add(row); }

  void add(const Row& row) { rows_.push_back(row); }
  const Row& first() const { return rows_.front(); }
  bool is_finished() const { return cell(first(), "finished") == "true"; }
  bool is_cleaned() const { return cell(first(), "cleaned") == "true"; }
  bool is_tandem() const { return cell(first(), "method").substr(0, 6) == "tandem"; }

  // As it is shown; empty if it is not known.
  std::string text(const Criterion& c) const
  {
    const std::vector<double> values = sorted(c.column);
    const std::size_t n = values.size();
    return n == 0 ? "" : shown(c, (values[(n - 1) / 2] + values[n / 2]) / 2);
  }

private:
  static std::string shown(const Criterion& c, double value)
  {
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", c.digits, c.scale * value);
    return text;
  }

  std::vector<double> sorted(const char* column) const
  {
    std::vector<double> values;
    for(const Row& row : rows_)
      if(!cell(row, column).empty())
        values.push_back(std::strtod(cell(row, column).c_str(), nullptr));
    std::sort(values.begin(), values.end());
    return values;
  }

  std::vector<Row> rows_;
};

// In the order of the rows.
inline std::vector<Summary> summaries(const std::vector<Row>& rows)
{
  std::vector<Summary> result;
  std::map<std::string, std::size_t> known;
  for(const Row& row : rows) {
    std::string key;
    for(const char* column : {"cloud", "points", "normals", "method", "cleaned"})
      key += cell(row, column) + "\n";
    const auto found = known.emplace(key, result.size());
    if(found.second)
      result.emplace_back(row);
    else
      result[found.first->second].add(row);
  }
  return result;
}

// As shown, so that what looks equal is equal.
inline bool is_better(const Criterion& c, const Summary& peer, const Summary& reference)
{
  const std::string mine = peer.text(c), its = reference.text(c);
  const bool has_found = cell(peer.first(), "shapes") != "0"; // nothing found has no error, which is no merit
  if(c.better == Better::neither || mine.empty() || its.empty() || !has_found)
    return false;
  const double a = std::strtod(mine.c_str(), nullptr), b = std::strtod(its.c_str(), nullptr);
  return c.better == Better::lower ? a < b : a > b;
}

// A cleaned result was not run by itself, so its time and memory say nothing.
inline bool concerns(const Criterion& c, const Summary& summary)
{
  const std::string column = c.column;
  const bool is_of_run = column == "seconds" || column == "user_seconds" || column == "bytes_per_point";
  return summary.is_finished() && !summary.text(c).empty() && !(is_of_run && summary.is_cleaned());
}

// A value, with a star where a peer is better than the reference; "-" where it is not known.
inline std::string marked(const Criterion& c, const Summary& summary, const Summary& reference)
{
  if(!concerns(c, summary))
    return "-";
  const bool is_marked = !summary.is_tandem() && is_better(c, summary, reference);
  return summary.text(c) + (is_marked ? "*" : "");
}

inline void print_summary(const Summary& summary, const Summary& reference)
{
  std::printf("%-64.64s", cell(summary.first(), "description").c_str());
  if(!summary.is_finished()) {
    std::printf(" did not finish: %s\n", cell(summary.first(), "error").c_str());
    return;
  }
  for(const Criterion& c : shown_criteria) {
    const std::string text = marked(c, summary, reference);
    std::printf(text.back() == '*' ? "%8s" : "%7s ", text.c_str());
  }
  std::printf("\n");
}

// Of one cloud.
inline void print_table(const std::vector<Summary>& all)
{
  std::printf("%-64s", "");
  for(const Criterion& c : shown_criteria)
    std::printf("%7s ", c.title);
  std::printf("\n");
  for(const Summary& summary : all)
    print_summary(summary, all.front());
  std::fflush(stdout);
}

inline void print_legend()
{
  std::printf("%s", R"(
* better than Tandem. Seconds: wall clock without reading, median of the runs. B/point: peak memory beyond the input. cpx: complexity,
smaller is more regular, with relations within 1e-6. top10%: points in the ten largest shapes that are within the tolerances. mean/e, max/e: distance of the points to their planes, in epsilons. >eps, >alpha: points of shapes
that violate the tolerances. Cleaned: these points, then shapes that have become too small, are dropped. F1: of true faces found, at
an intersection over union of one half; prec.: of points. results.csv has more columns.
)");
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_COMPARISON_TABLE_H
