// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What relations save: the statistics of the groups of shapes; and the score.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_MEASURE_RELATIONS_H
#define CGAL_TANDEM_INTERNAL_FINISH_MEASURE_RELATIONS_H

#include <CGAL/Tandem/Shapes_data.h>
#include <CGAL/Tandem/internal/score/Score.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Degrees of freedom of each direction. A direction costs 2, less one for each orthogonal direction that was counted
// before it. Counting starts at the direction with most relations, and goes on with the most constrained one that it
// has reached. So a star is counted from its master, and a frame costs 3.
inline std::vector<int> direction_freedom(std::size_t directions, const std::vector<std::pair<int, int>>& orthogonal)
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
  std::vector<int> freedom(directions, 0);
  auto count = [&](int g) {
    if(is_counted[g])
      return;
    is_counted[g] = 1;
    freedom[std::size_t(g)] = 2 - (std::min)(constraints[g], 2);
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
// The points of the largest shape of each group.
inline std::vector<std::int64_t> largest_sizes(const std::vector<int>& group, const std::vector<std::size_t>& size)
{
  std::vector<std::int64_t> largest;
  for(std::size_t s = 0; s < group.size(); ++s) {
    const std::size_t g = std::size_t(group[s]);
    largest.resize((std::max)(largest.size(), g + 1), 0);
    largest[g] = (std::max)(largest[g], std::int64_t(size[s]));
  }
  return largest;
}

// All terms of the score. `freedom`: of each direction.
inline Score_terms score_terms(const Shapes_data& data, const std::vector<int>& freedom, const Score_counts& counts)
{
  const Score score(data.parameters);
  Score_terms terms;
  terms.fit = counts.fit;
  terms.links = score.links(counts.links, counts.free_links);
  for(const std::size_t size : data.size)
    terms.size += score.size_bonus(std::int64_t(size));
  terms.price = std::int64_t(data.size.size()) * score.price();
  const std::vector<std::int64_t> direction = largest_sizes(data.parallel_group, data.size);
  for(std::size_t d = 0; d < direction.size(); ++d)
    terms.freedom += freedom[d] * score.freedom(direction[d]);
  for(const std::int64_t size : largest_sizes(data.coplanar_group, data.size))
    terms.freedom += score.freedom(size);
  return terms;
}

inline Result_score to_points(const Score_terms& terms)
{
  const auto points = [](std::int64_t term) { return double(term) / double(Score::unit); };
  return {points(terms.fit), points(terms.links), points(terms.size), points(terms.price), points(terms.freedom)};
}

// counts: what the score counts of the points.
inline void measure_relations(Shapes_data& data, const Score_counts& counts)
{
  Statistics& statistics = data.statistics;
  statistics.number_of_shapes = data.coefficients.size();
  statistics.number_of_directions = representatives(data.parallel_group).size();
  statistics.number_of_planes = representatives(data.coplanar_group).size();
  statistics.number_of_orthogonal_pairs = data.orthogonal_groups.size();
  const std::vector<int> freedom = direction_freedom(statistics.number_of_directions, data.orthogonal_groups);
  statistics.degrees_of_freedom =
    std::size_t(std::accumulate(freedom.begin(), freedom.end(), 0)) + statistics.number_of_planes;
  statistics.score = to_points(score_terms(data, freedom, counts));
  statistics.complexity = statistics.number_of_shapes > 0
                            ? double(statistics.degrees_of_freedom) / double(3 * statistics.number_of_shapes)
                            : 0;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_MEASURE_RELATIONS_H
