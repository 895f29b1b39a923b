// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the results of several runs on the same points differ: nothing, for a
// method that is deterministic.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_SPREAD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_SPREAD_H

#include "evaluate.h"

#include <map>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Spread {
  std::size_t runs = 0;
  bool is_same = true;  // labels, and planes bit for bit
  double relabeled = 0; // largest share of points with another shape than in the first run
  std::size_t fewest_shapes = 0, maximum_shapes = 0;
  double minimum_coverage = 0, maximum_coverage = 0;
};

// Of each shape of `other`: the shape of `reference` it corresponds to, or -1. Each is taken once, by the number
// of common points; ties go to the smaller indices.
inline std::vector<std::int32_t> match_shapes(const Detection& reference, const Detection& other)
{
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> common;
  for(std::size_t i = 0; i < reference.label.size(); ++i)
    if(reference.label[i] >= 0 && other.label[i] >= 0)
      ++common[{other.label[i], reference.label[i]}];
  std::vector<std::pair<std::size_t, std::pair<std::int32_t, std::int32_t>>> by_size;
  for(const auto& entry : common)
    by_size.emplace_back(entry.second, entry.first);
  std::stable_sort(by_size.begin(), by_size.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::int32_t> match(other.planes.size(), -1);
  std::vector<bool> is_taken(reference.planes.size(), false);
  for(const auto& entry : by_size) {
    std::size_t s = std::size_t(entry.second.first), r = std::size_t(entry.second.second);
    if(match[s] < 0 && !is_taken[r]) {
      match[s] = entry.second.second;
      is_taken[r] = true;
    }
  }
  return match;
}

inline double share_relabeled(const Detection& reference, const Detection& other)
{
  std::vector<std::int32_t> match = match_shapes(reference, other);
  std::size_t count = 0;
  for(std::size_t i = 0; i < reference.label.size(); ++i) {
    // A shape without a counterpart never equals the label of the reference, -1 included.
    std::int32_t label = other.label[i] < 0 ? -1 : match[std::size_t(other.label[i])];
    count += label != reference.label[i] || (label < 0 && other.label[i] >= 0);
  }
  return reference.label.empty() ? 0 : double(count) / double(reference.label.size());
}

inline bool are_same(const Detection& a, const Detection& b)
{
  auto is_same_plane = [](const Plane& p, const Plane& q) {
    return p.normal.x == q.normal.x && p.normal.y == q.normal.y && p.normal.z == q.normal.z && p.offset == q.offset;
  };
  return a.label == b.label && a.planes.size() == b.planes.size() &&
         std::equal(a.planes.begin(), a.planes.end(), b.planes.begin(), is_same_plane);
}

inline double coverage_of(const Detection& detection)
{
  auto assigned = std::count_if(detection.label.begin(), detection.label.end(), [](std::int32_t l) { return l >= 0; });
  return detection.label.empty() ? 0 : double(assigned) / double(detection.label.size());
}

// Throws std::runtime_error where the runs are not on the same points.
inline Spread evaluate_spread(const std::vector<Detection>& runs)
{
  Spread spread;
  spread.runs = runs.size();
  for(std::size_t r = 0; r < runs.size(); ++r) {
    if(runs[r].label.size() != runs[0].label.size())
      throw std::runtime_error("run " + std::to_string(r) + " has another number of points than run 0");
    shape_sizes(runs[r]); // throws for labels that no plane has
    std::size_t shapes = runs[r].planes.size();
    double coverage = coverage_of(runs[r]);
    spread.is_same = spread.is_same && are_same(runs[0], runs[r]);
    spread.relabeled = (std::max)(spread.relabeled, r == 0 ? 0 : share_relabeled(runs[0], runs[r]));
    spread.fewest_shapes = r == 0 ? shapes : (std::min)(spread.fewest_shapes, shapes);
    spread.maximum_shapes = (std::max)(spread.maximum_shapes, shapes);
    spread.minimum_coverage = r == 0 ? coverage : (std::min)(spread.minimum_coverage, coverage);
    spread.maximum_coverage = (std::max)(spread.maximum_coverage, coverage);
  }
  return spread;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_SPREAD_H
