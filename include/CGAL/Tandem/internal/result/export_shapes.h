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

// How many degrees of freedom right angles leave to each direction. A direction has two. A right angle takes one of
// either of its directions, or none if it follows from others, as it does in a rigid frame. What is left belongs to the
// largest shapes that can have it. So a floor that is larger than its walls has both of its own, and none where two
// walls are larger. This is the pebble game of rigidity theory.
class Direction_freedom {
public:
  // largest: by direction, the points of its largest shape. orthogonal: pairs of directions, each once.
  Direction_freedom(const std::vector<std::int64_t>& largest, const std::vector<std::pair<int, int>>& orthogonal)
    : freedom_(largest.size(), 2), taken_(largest.size()), is_held_(largest.size(), 0), from_(largest.size(), -1)
  {
    for(const auto& [a, b] : orthogonal) {
      is_held_[a] = is_held_[b] = 1;
      while(gather(a) || gather(b))
        ;
      if(freedom_[a] + freedom_[b] == 4)
        take(a, b);
      is_held_[a] = is_held_[b] = 0;
    }
    std::vector<int> order(largest.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return largest[a] > largest[b]; });
    for(int d : order) {
      is_held_[d] = 1;
      while(gather(d))
        ;
    }
  }

  const std::vector<int>& operator()() const { return freedom_; }

private:
  // The right angle of a and b takes a degree of freedom of a.
  void take(int a, int b)
  {
    --freedom_[a];
    taken_[a].push_back(b);
  }

  // Gives d a degree of freedom of a direction that is not held. Each right angle on the way between them takes one of
  // its other direction then. Returns whether there is one.
  bool gather(int d)
  {
    if(freedom_[d] == 2)
      return false;
    std::vector<int> reached = {d};
    int end = -1;
    for(std::size_t k = 0; k < reached.size() && end < 0; ++k)
      for(int next : taken_[reached[k]])
        if(next != d && from_[next] < 0) {
          from_[next] = reached[k];
          reached.push_back(next);
          if(freedom_[next] > 0 && !is_held_[next])
            end = next;
        }
    for(int to = end, at; to >= 0 && to != d; to = at) {
      at = from_[to];
      ++freedom_[at];
      taken_[at].erase(std::find(taken_[at].begin(), taken_[at].end(), to));
      take(to, at);
    }
    for(int k : reached)
      from_[k] = -1;
    return end >= 0;
  }

  std::vector<int> freedom_;
  std::vector<std::vector<int>> taken_; // by direction, the other directions of the right angles that took of it
  std::vector<char> is_held_;           // those that keep their degrees of freedom
  std::vector<int> from_;               // within a search
};

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

// All terms of the score. `freedom` and `largest`: of each direction, and the points of its largest shape.
inline Score_terms score_terms(const Shapes_data& data, const std::vector<int>& freedom,
                               const std::vector<std::int64_t>& largest, const Score_counts& counts)
{
  const Score score(data.parameters);
  Score_terms terms = score_terms(score, counts, data.size);
  for(std::size_t d = 0; d < largest.size(); ++d)
    terms.freedom += freedom[d] * score.freedom(largest[d]);
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
  const std::vector<std::int64_t> largest = largest_sizes(data.parallel_group, data.size);
  const std::vector<int> freedom = Direction_freedom(largest, data.orthogonal_groups)();
  statistics.degrees_of_freedom =
    std::size_t(std::accumulate(freedom.begin(), freedom.end(), 0)) + statistics.number_of_planes;
  statistics.score = to_points(score_terms(data, freedom, largest, counts));
  // The part of the degrees of freedom that is left: each unrelated shape would have 3 of its own.
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
  statistics.line_spacing = result.line_spacing_steps * in.grid.step;
  statistics.times = result.times;
  return data;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_EXPORT_SHAPES_H
