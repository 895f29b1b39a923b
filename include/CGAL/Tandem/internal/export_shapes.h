// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border on the way out: the result of the engine in terms of the caller's
// range, with the relations between the shapes and the statistics. Nothing here
// changes a plane or a label.

#ifndef CGAL_TANDEM_INTERNAL_EXPORT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_EXPORT_SHAPES_H

#include <CGAL/Tandem/internal/Engine_result.h>
#include <CGAL/Tandem/internal/exact_check.h>
#include <CGAL/Tandem/internal/group_points.h>
#include <CGAL/Tandem/internal/Import.h>

#include <array>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// What Planar_shapes_3 is made of. Tests corrupt it.
struct Shapes_data {
  std::vector<Coefficients> coefficients;             // of each shape
  std::vector<int> parallel_group;                    // of each shape
  std::vector<int> coplanar_group;                    // of each shape
  std::vector<std::pair<int, int>> orthogonal_groups; // pairs of parallel groups, first < second, sorted
  std::vector<char> is_flipped;       // of each shape: the majority of the normals is opposite to its plane
  std::vector<std::int32_t> shape_of; // of each item of the range, -1 = none
  std::vector<std::uint32_t> normal;  // of each item, packed; empty if normals were given
  Parameters parameters;
  Statistics statistics;
  Point_groups points; // of the shapes, until Planar_shapes_3 takes them
};

inline double plane_distance(const Coefficients& p, const double* q)
{
  return std::fabs(std::fma(p[0], q[0], std::fma(p[1], q[1], std::fma(p[2], q[2], p[3]))));
}

inline double normal_dot(const Coefficients& p, const double* n)
{
  return std::fma(p[0], n[0], std::fma(p[1], n[1], p[2] * n[2]));
}

// The first shape of each group.
inline std::vector<int> representatives(const std::vector<int>& group)
{
  std::vector<int> first;
  for(std::size_t s = 0; s < group.size(); ++s) {
    if(std::size_t(group[s]) >= first.size())
      first.resize(std::size_t(group[s]) + 1, -1);
    if(first[group[s]] < 0)
      first[group[s]] = int(s);
  }
  return first;
}

// Half of the 1e-15 that is promised: then any order of evaluation keeps the promise.
constexpr double largest_orthogonal_dot = 5e-16;

inline std::vector<std::pair<int, int>> find_orthogonal_groups(const Shapes_data& data)
{
  std::vector<Coefficients> direction;
  for(int s : representatives(data.parallel_group))
    direction.push_back(data.coefficients[std::size_t(s)]);
  std::vector<std::pair<int, int>> pairs;
  for(std::size_t g = 0; g < direction.size(); ++g)
    for(std::size_t h = g + 1; h < direction.size(); ++h) {
      const Coefficients &a = direction[g], &b = direction[h];
      if(std::fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) > 1e-14) // nearly all pairs, and fma is slow
        continue;
      if(std::fabs(normal_dot(a, b.data())) <= largest_orthogonal_dot)
        pairs.emplace_back(int(g), int(h));
    }
  return pairs;
}

// Degrees of freedom of the directions. A direction costs 2, less one for each
// direction it is orthogonal to and that has been counted before. The next one
// counted is always the most constrained, then the one with most relations, then
// the first: a star is counted from its center, a frame costs 3.
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
      std::vector<int>& most = stack[2].empty() ? stack[1] : stack[2];
      const int next = most.back();
      most.pop_back();
      count(next);
    }
  }
  return freedom;
}

// Sums over the points of the shapes. Distances are summed as integers, so that
// their mean does not depend on the order of the points.
template <class Backend>
void measure_points(Backend& backend, const Import& in, const std::vector<std::int32_t>& shape_of, Shapes_data& data)
{
  const double unit_distance = data.parameters.maximum_distance / double(1 << 20);
  std::vector<std::int64_t> votes(data.coefficients.size(), 0);
  std::int64_t distance = 0, assigned = 0;
  const std::size_t grain = (std::max)(std::size_t(1) << 16, votes.size()); // so that clearing `own` costs little
  backend.for_each_piece(shape_of.size(), grain, [&](std::size_t first, std::size_t last) {
    std::vector<std::int64_t> own(votes.size(), 0);
    std::int64_t sum = 0, points = 0;
    for(std::size_t i = first; i < last; ++i) {
      const std::int32_t s = shape_of[i];
      if(s < 0)
        continue;
      ++points;
      sum += std::int64_t(plane_distance(data.coefficients[s], in.position(i)) / unit_distance + .5);
      if(in.has_normals)
        own[s] += normal_dot(data.coefficients[s], in.normal(i)) < 0 ? -1 : 1;
    }
    for(std::size_t s = 0; s < own.size(); ++s)
      if(own[s] != 0)
        Backend::atomic_add(votes[s], own[s]);
    Backend::atomic_add(distance, sum);
    Backend::atomic_add(assigned, points);
  });
  for(std::size_t s = 0; s < votes.size(); ++s)
    data.is_flipped.push_back(votes[s] < 0);
  Statistics& statistics = data.statistics;
  statistics.number_of_assigned_points = std::size_t(assigned);
  statistics.coverage = in.number_of_items > 0 ? double(assigned) / double(in.number_of_items) : 0;
  statistics.mean_distance = assigned > 0 ? double(distance) / double(assigned) * unit_distance : 0;
}

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

// From the imported points to the items of the caller's range.
template <class T>
std::vector<T> by_item(const Import& in, std::vector<T>&& values, T missing)
{
  if(in.item.empty() && values.size() == in.number_of_items)
    return std::move(values);
  std::vector<T> result(in.number_of_items, missing);
  for(std::size_t i = 0; i < values.size(); ++i)
    result[in.item_of(i)] = values[i];
  return result;
}

inline Shapes_data start_export(const Import& in, const Parameters& parameters)
{
  Shapes_data data;
  data.parameters = parameters;
  data.statistics.number_of_points = in.number_of_items;
  data.statistics.number_of_ignored_coordinates = in.number_of_ignored_coordinates;
  data.statistics.number_of_ignored_normals = in.number_of_ignored_normals;
  data.statistics.grid_step = in.grid.step;
  data.statistics.is_grid_coarse = in.grid.is_coarse;
  data.statistics.has_estimated_normals = !in.has_normals;
  return data;
}

// Of an empty result, too. The result is emptied.
template <class Backend>
Shapes_data export_shapes(Backend& backend, const Import& in, const Parameters& parameters, Engine_result&& result)
{
  Shapes_data data = start_export(in, parameters);
  for(const Engine_shape& shape : result.shapes) {
    data.coefficients.push_back(shape.plane);
    data.parallel_group.push_back(shape.direction);
    data.coplanar_group.push_back(shape.plane_group);
  }
  data.orthogonal_groups = find_orthogonal_groups(data);
  measure_points(backend, in, result.shape_of, data);
  data.shape_of = by_item(in, std::move(result.shape_of), std::int32_t(-1));
  data.points = group_points(backend, data.shape_of, data.coefficients.size());
  if(!in.has_normals)
    data.normal = by_item(in, std::move(result.normal), no_normal);
  measure_relations(data);
  Statistics& statistics = data.statistics;
  statistics.number_of_rounds = result.rounds;
  statistics.is_cancelled = result.is_cancelled;
  statistics.peak_bytes = result.peak_bytes;
  statistics.times = result.times;
  return data;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_EXPORT_SHAPES_H
