// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the result of the engine to that of the caller: items of the range, groups of shapes, pairs of groups,
// statistics. Changes no plane, and no label of a point.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_EXPORT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_FINISH_EXPORT_SHAPES_H

#include <CGAL/Tandem/Shapes_data.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/finish/Engine_result.h>
#include <CGAL/Tandem/internal/finish/measure_relations.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>
#include <CGAL/Tandem/internal/regularity/orthogonal_pairs.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

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

// The result of an empty cloud is valid, too: no shapes, and shares of 0. The mean distance is in epsilons in the
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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_EXPORT_SHAPES_H
