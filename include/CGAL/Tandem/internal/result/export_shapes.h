// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the result of the engine to that of the caller: items of the range, groups of shapes, pairs of groups,
// statistics. Changes no plane, and no label of a point.

#ifndef CGAL_TANDEM_INTERNAL_RESULT_EXPORT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_RESULT_EXPORT_SHAPES_H

#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>
#include <CGAL/Tandem/internal/result/Engine_result.h>
#include <CGAL/Tandem/internal/result/Shapes_data.h>
#include <CGAL/Tandem/internal/score/Score.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- What relations save: the statistics of the groups of shapes; and the score.

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

// Complexity is the part of the degrees of freedom that is left: each unrelated shape would have 3 of its own.
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

// What the directions of the groups have in common up to rounding, whether or not the regularity step made it so.
inline void relate_groups(Shapes_data& data)
{
  const std::vector<Vector> direction = group_directions(data.parallel_group, data.coefficients);
  data.orthogonal_groups = orthogonal_pairs(direction);
  data.fixed_direction = fixed_directions_of(direction, data.parameters);
  data.symmetry_group = symmetry_groups(direction, data.parameters);
}

constexpr std::size_t many_items = 65536; // fewer are not worth a second thread

// From imported points to items of the caller's range; items that were not imported get `missing`. Where all items were
// imported the table is shared, not copied.
template <class T, class Backend>
Shared_table<T> by_item(Backend& backend, const Import& in, const Shared_table<T>& values, T missing)
{
  if(in.item.empty() && values.size() == in.number_of_items)
    return values;
  Host_buffer<T> result(in.number_of_items);
  backend.for_each_on_host(
    result.size(), [&](std::size_t i) { result[i] = missing; }, many_items);
  backend.for_each_on_host(
    values.size(), [&](std::size_t i) { result[in.item_of(i)] = values[i]; }, many_items);
  return result;
}

// The same for a list of imported points: each becomes its item. Items ascend with imported points, so lists stay
// sorted.
template <class Backend>
Shared_table<std::uint32_t> to_items(Backend& backend, const Import& in, const Shared_table<std::uint32_t>& points)
{
  if(in.item.empty())
    return points;
  Host_buffer<std::uint32_t> result(points.size());
  backend.for_each_on_host(
    result.size(), [&](std::size_t i) { result[i] = in.item[points[i]]; }, many_items);
  return result;
}

// What is known before a shape is found.
inline Shapes_data start_export(const Import& in, const Parameters& parameters)
{
  Shapes_data data;
  data.parameters = parameters;
  data.statistics.number_of_points = std::size_t(in.total.items);
  data.statistics.number_of_ignored_coordinates = std::size_t(in.total.ignored_coordinates);
  data.statistics.number_of_ignored_normals = std::size_t(in.total.ignored_normals);
  data.statistics.number_of_ignored_tolerances = std::size_t(in.total.ignored_tolerances);
  data.statistics.number_of_far_points = std::size_t(in.total.far_points);
  data.statistics.grid_step = in.grid.step;
  data.statistics.is_grid_coarse = in.grid.is_coarse;
  data.statistics.has_estimated_normals = !in.has_normals;
  return data;
}

// The reasons of the result, and of points that no stage has looked at: the whole cloud is smaller than a shape, or the
// detection was cancelled before it had neighbors.
inline Free_points free_points_of(const Import& in, const Parameters& parameters, const Engine_result& result,
                                  std::size_t assigned)
{
  Free_points counts = result.free_points;
  const std::size_t others = std::size_t(in.total.points) - assigned - counts.total();
  (in.total.points < parameters.minimum_region_size ? counts.in_small_regions : counts.clutter) += others;
  return counts;
}

// The result of an empty cloud is valid, too: no shapes, and ratios of 0. The mean distance is in epsilons in the
// engine, and in the caller's units here.
template <class Backend>
Shapes_data export_shapes(Backend& backend, const Import& in, const Parameters& parameters, const Engine_result& result)
{
  Shapes_data data = start_export(in, parameters);
  Statistics& statistics = data.statistics;
  for(const Engine_shape& shape : result.shapes) {
    data.coefficients.push_back(shape.plane);
    data.size.push_back(shape.size);
    data.parallel_group.push_back(shape.direction);
    data.coplanar_group.push_back(shape.plane_group);
    data.is_flipped.push_back(shape.is_flipped);
    data.uncertainty.push_back(shape.uncertainty);
    statistics.number_of_assigned_points += shape.size;
  }
  statistics.free_points = free_points_of(in, parameters, result, statistics.number_of_assigned_points);
  relate_groups(data);
  data.shape_of = by_item(backend, in, result.shape_of, std::int32_t(-1));
  data.points = {result.points.first, to_items(backend, in, result.points.position)};
  if(!in.has_normals)
    data.normal = by_item(backend, in, result.normal, no_normal);
  measure_relations(data, result.counts);
  statistics.coverage = statistics.number_of_points > 0
                          ? double(statistics.number_of_assigned_points) / double(statistics.number_of_points)
                          : 0;
  statistics.mean_distance = result.mean_distance * parameters.maximum_distance;
  statistics.number_of_rounds = result.rounds;
  statistics.is_cancelled = result.is_cancelled;
  statistics.peak_bytes = result.peak_bytes;
  statistics.times = result.times;
  return data;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_EXPORT_SHAPES_H
