// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What relations save: the statistics of the groups of shapes.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_MEASURE_RELATIONS_H
#define CGAL_TANDEM_INTERNAL_FINISH_MEASURE_RELATIONS_H

#include <CGAL/Tandem/Shapes_data.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Degrees of freedom of the directions. A direction costs 2, less one for each orthogonal direction that was counted
// before it. Counting starts at the direction with most relations, and goes on with the most constrained one that it
// has reached. So a star is counted from its master, and a frame costs 3.
inline std::size_t direction_freedom(std::size_t directions, const std::vector<std::pair<int, int>>& orthogonal)
{
  std::vector<std::vector<int>> related(directions);
  for(const auto& pair : orthogonal) {
    related[pair.first].push_back(pair.second);
    related[pair.second].push_back(pair.first);
  }
  std::vector<int> start(directions);
  for(std::size_t g = 0; g < directions; ++g)
    start[g] = int(g);
  std::stable_sort(start.begin(), start.end(), [&](int a, int b) { return related[a].size() > related[b].size(); });
  std::vector<int> constraints(directions, 0);
  std::vector<char> is_counted(directions, 0);
  std::vector<int> stack[3]; // by number of constraints; entries may be out of date
  std::size_t freedom = 0;
  auto count = [&](int g) {
    if(is_counted[g])
      return;
    is_counted[g] = 1;
    freedom += std::size_t(2 - (std::min)(constraints[g], 2));
    for(int h : related[g])
      if(!is_counted[h])
        stack[(std::min)(++constraints[h], 2)].push_back(h);
  };
  for(int g : start) {
    count(g);
    while(!stack[1].empty() || !stack[2].empty()) {
      std::vector<int>& maximum = stack[2].empty() ? stack[1] : stack[2];
      const int next = maximum.back();
      maximum.pop_back();
      count(next);
    }
  }
  return freedom;
}

// Complexity is the share of the degrees of freedom that is left: each unrelated shape would have 3 of its own.
inline void measure_relations(Shapes_data& data)
{
  Statistics& statistics = data.statistics;
  statistics.number_of_shapes = data.coefficients.size();
  statistics.number_of_directions = representatives(data.parallel_group).size();
  statistics.number_of_planes = representatives(data.coplanar_group).size();
  statistics.number_of_orthogonal_pairs = data.orthogonal_groups.size();
  statistics.degrees_of_freedom =
    direction_freedom(statistics.number_of_directions, data.orthogonal_groups) + statistics.number_of_planes;
  statistics.complexity = statistics.number_of_shapes > 0
                            ? double(statistics.degrees_of_freedom) / double(3 * statistics.number_of_shapes)
                            : 0;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_MEASURE_RELATIONS_H
