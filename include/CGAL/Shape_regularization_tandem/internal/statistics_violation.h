// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks of the statistics of a result: what follows from points, labels and relations is computed again, the rest has
// to be possible. Each function returns the first violation, or an empty text.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_STATISTICS_VIOLATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_STATISTICS_VIOLATION_H

#include <CGAL/Tandem/internal/engine/first_unconnected.h>
#include <CGAL/Tandem/internal/finish/measure_relations.h>
#include <CGAL/Tandem/internal/finish/measure_shapes.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

namespace CGAL {
namespace Tandem {
namespace internal {

// Sums over the points of all ranks, of which no order changes a bit.
struct Point_sums {
  std::uint64_t assigned = 0, distance = 0, fit = 0; // the latter two in units of Score_item and Score
  std::uint64_t fit_error = 0; // what rounding of distances may change of the latter, in 2^-20 points
  std::uint64_t peak_bytes = 0;
};

// The distance of a point to its plane, and what it may be.
struct Measured_distance {
  double value, tolerance;

  // In units of the score.
  std::uint64_t share_of(double length) const
  {
    const double share = value < length ? value / length : 1;
    return std::uint64_t((value > 0 ? share : 0) * double(Score_item::tolerance_units) + .5);
  }
};

// A number of the statistics, and what it should be.
struct Statistic {
  const char* name;
  double found, expected, margin;

  std::string violation() const
  {
    return std::fabs(found - expected) <= margin ? std::string()
                                                 : "the statistics are wrong: " + std::string(name) + " is " +
                                                     to_text(found) + " instead of " + to_text(expected);
  }
};

inline std::string first_violation(std::initializer_list<Statistic> numbers)
{
  for(const Statistic& number : numbers)
    if(!number.violation().empty())
      return number.violation();
  return {};
}

// Exact: a double has all numbers of points. One that is too large for it is wrong in any case.
inline Statistic count_of(const char* name, std::size_t found, std::size_t expected)
{
  return {name, double(found), double(expected), 0};
}

// How far a distance on the grid may be from the exact one, with a share of epsilon that is rounded.
inline double rounding_of_distances(const Shapes_data& data, const Import& in)
{
  const double epsilon = data.parameters.maximum_distance;
  return (std::min)(distance_margin(in.grid) * in.grid.step + 2 * epsilon / double(Score_item::tolerance_units),
                    epsilon);
}

// The notes that follow from the parameters.
inline std::string note_violation(const Shapes_data& data)
{
  const std::string expected = angle_note(data.parameters);
  return data.statistics.angle_note == expected ? std::string()
                                                : "the statistics are wrong: angle_note is \"" +
                                                    data.statistics.angle_note + "\" instead of \"" + expected + "\"";
}

// What the points, the grid and the relations say.
inline std::string count_violation(const Shapes_data& data, const Import& in, const Point_sums& sums)
{
  Shapes_data again;
  again.coefficients = data.coefficients;
  again.parallel_group = data.parallel_group;
  again.coplanar_group = data.coplanar_group;
  again.orthogonal_groups = data.orthogonal_groups;
  again.size = data.size;
  again.parameters = data.parameters;
  measure_relations(again, {std::int64_t(sums.fit), 0, 0});
  const Statistics &t = data.statistics, &r = again.statistics;
  const double points = double(in.total.items), assigned = double(sums.assigned);
  const double epsilon = data.parameters.maximum_distance;
  const double unit = epsilon / double(Score_item::tolerance_units);
  const double mean = sums.assigned > 0 ? double(sums.distance) / assigned * unit : 0;
  const double rounding = rounding_of_distances(data, in);
  const std::string wrong_count = first_violation({
    count_of("number_of_points", t.number_of_points, in.total.items),
    count_of("number_of_ignored_coordinates", t.number_of_ignored_coordinates, in.total.ignored_coordinates),
    count_of("number_of_ignored_normals", t.number_of_ignored_normals, in.total.ignored_normals),
    count_of("number_of_ignored_tolerances", t.number_of_ignored_tolerances, in.total.ignored_tolerances),
    count_of("number_of_far_points", t.number_of_far_points, in.total.far_points),
    count_of("number_of_assigned_points", t.number_of_assigned_points, sums.assigned),
    count_of("the sum of free_points", t.free_points.total(), in.total.points - sums.assigned),
    count_of("number_of_shapes", t.number_of_shapes, r.number_of_shapes),
    count_of("number_of_directions", t.number_of_directions, r.number_of_directions),
    count_of("number_of_planes", t.number_of_planes, r.number_of_planes),
    count_of("number_of_orthogonal_pairs", t.number_of_orthogonal_pairs, r.number_of_orthogonal_pairs),
    count_of("degrees_of_freedom", t.degrees_of_freedom, r.degrees_of_freedom),
    count_of("has_estimated_normals", t.has_estimated_normals, !in.has_normals),
    count_of("is_grid_coarse", t.is_grid_coarse, in.grid.is_coarse),
    {"grid_step", t.grid_step, in.grid.step, 0},
    {"complexity", t.complexity, r.complexity, 0},
    {"coverage", t.coverage, in.total.items > 0 ? assigned / points : 0, 0},
  });
  if(!wrong_count.empty() || t.free_points.unselected > 0) // the rest is that of all shapes
    return wrong_count;
  return first_violation({
    {"mean_distance", t.mean_distance, mean, rounding},
    {"score.fit", t.score.fit, r.score.fit, std::ldexp(double(sums.fit_error), -20) + assigned / double(Score::unit)},
    {"score.size", t.score.size, r.score.size, 0},
    {"score.price", t.score.price, r.score.price, 0},
    {"score.freedom", t.score.freedom, r.score.freedom, 0},
  });
}

// The links, and the reasons of points without a shape, are counted again in the neighbor graph, unless shapes were
// left out. A detection that was cancelled before it had shapes may have had no graph, and no reasons.
inline std::string graph_violation(const Shapes_data& data, const Graph_counts& counts)
{
  const Score score(data.parameters);
  const double links = to_points({0, score.links(counts.score.links, counts.score.free_links), 0, 0, 0}).links;
  const Statistics& t = data.statistics;
  const Free_points& found = t.free_points;
  if(found.unselected > 0)
    return {};
  Free_points expected = counts.free_points;
  if(t.number_of_shapes == 0 && expected.total() < data.parameters.minimum_region_size) {
    expected = Free_points();
    expected.in_small_regions = counts.free_points.total();
  }
  const std::string wrong_links = first_violation({{"score.links", t.score.links, links, 0}});
  if(!wrong_links.empty() || (t.is_cancelled && t.number_of_shapes == 0))
    return wrong_links;
  return first_violation({
    count_of("free_points.without_normal", found.without_normal, expected.without_normal),
    count_of("free_points.misfit", found.misfit, expected.misfit),
    count_of("free_points.without_neighbors", found.without_neighbors, expected.without_neighbors),
    count_of("free_points.in_small_regions", found.in_small_regions, expected.in_small_regions),
    count_of("free_points.clutter", found.clutter, expected.clutter),
  });
}

// Work cannot be counted again; only impossible numbers are refused.
inline std::string work_violation(const Stage_work& stages)
{
  const auto& [prepare, rounds, finish] = stages;
  for(const Work* w : {&prepare, &rounds, &finish}) {
    const auto& [over_points, over_lists, over_shapes, launches, waits, bytes] = *w;
    for(const double number :
        {over_points, over_lists, double(over_shapes), double(launches), double(waits), double(bytes)})
      if(!(number >= 0 && number < 1e18))
        return "the work of a stage is " + to_text(number);
  }
  return {};
}

// Seconds, rounds and bytes cannot be measured again.
inline std::string cost_violation(const Statistics& t, const Import& in, const Point_sums& sums)
{
  const auto& [normals, sort, neighbors, growth, regularity, finish, total] = t.times;
  double stages = 0;
  for(const double seconds : {normals, sort, neighbors, growth, regularity, finish}) {
    if(!(seconds >= 0 && std::isfinite(seconds)))
      return "a stage takes " + to_text(seconds) + " seconds";
    stages += seconds;
  }
  if(!(std::fabs(total - stages) <= 1e-9 * stages))
    return "the stages take " + to_text(stages) + " seconds, but all of it " + to_text(total);
  const std::size_t least_rounds = t.number_of_shapes > 0 ? 1 : 0;
  if(t.number_of_rounds < least_rounds || t.number_of_rounds > std::size_t(tuning::loop::maximum_rounds))
    return "there are " + to_text(t.number_of_rounds) + " rounds";
  constexpr std::uint64_t least_bytes = sizeof(Grid_point), most_bytes = 1024; // of a point
  constexpr std::uint64_t other_bytes = std::uint64_t(1) << 20;                // tables that every rank has
  if(sums.peak_bytes > most_bytes * in.total.points + other_bytes ||
     (t.number_of_shapes > 0 && sums.peak_bytes < least_bytes * in.total.points))
    return "the tables of " + to_text(in.total.points) + " points had " + to_text(sums.peak_bytes) + " bytes";
  const std::string wrong_work = work_violation(t.work);
  if(!wrong_work.empty())
    return wrong_work;
  return t.backend.empty() ? "there is no back end" : "";
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_STATISTICS_VIOLATION_H
