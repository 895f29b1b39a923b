// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is_valid_result() does not look at: whether other statistics, and uncertainties, are those of the points, the
// labels and the relations. They are computed again, or have to be possible.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEASURED_VIOLATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEASURED_VIOLATION_H

#include <CGAL/Shape_regularization_tandem/is_valid_result.h>
#include <CGAL/Tandem/internal/finish/measure_shapes.h>
#include <CGAL/Tandem/internal/result/export_shapes.h>
#include <CGAL/Tandem/internal/result/measure_planes.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The uncertainty of planes: from the caller's coordinates in double, where the detection has integers of the grid.
// What it says of normals is that of test_measures.

// Sums over the points of a shape, relative to the centroid that is to be checked, in steps of the grid.
struct Plane_sums {
  double count = 0, squares = 0; // of distances to the plane
  Vector sum = {0, 0, 0};

  void add(const Vector& p, const Plane_uncertainty& u, double distance, double step)
  {
    ++count;
    squares += (distance / step) * (distance / step);
    sum = add_scaled(sum, 1 / step, p - Vector{u.centroid[0], u.centroid[1], u.centroid[2]});
  }
};

// Lengths are in steps of the grid, so that squares of all units can be computed. Margins bound what its rounding changes.
inline std::string uncertainty_violation(const Shapes_data& data, const Grid& grid, const std::vector<Plane_sums>& sums)
{
  const double change = distance_margin_steps(grid);
  for(std::size_t s = 0; s < sums.size(); ++s) {
    const Plane_uncertainty& found = data.uncertainty[s];
    const double n = sums[s].count, noise = found.noise / grid.step;
    const bool has_residual = n > 3;
    const double expected =
      has_residual ? std::sqrt(sums[s].squares / (n - 3)) : data.parameters.maximum_distance / grid.step;
    const double margin = 1e-9 * expected + (has_residual ? change * std::sqrt(n / (n - 3)) : 0);
    const Vector& v = sums[s].sum;
    if(!((std::max)({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}) <= change * n) ||
       !(found.noise >= 0 && std::fabs(noise - expected) <= margin) ||
       !(std::fabs(found.offset_deviation / grid.step - noise / std::sqrt(n)) <= 1e-9 * noise))
      return "wrong are centroid, noise or offset_deviation of " + numbered("shape", s);
  }
  return {};
}

// --- Statistics

// How far a distance on the grid may be from the exact one, with a fraction of epsilon that is rounded.
inline double rounding_of_distances(const Shapes_data& data, const Import& in)
{
  const double epsilon = data.parameters.maximum_distance;
  return (std::min)(distance_margin_steps(in.grid) * in.grid.step + 2 * epsilon / double(Score::tolerance_units),
                    epsilon);
}

// Sums over the points of shapes.
struct Point_sums {
  std::uint64_t assigned = 0, fit = 0; // the latter in units of Score
  double fit_error = 0;                // what rounding of distances may change of the latter, in points
  std::vector<Plane_sums> planes;

  Point_sums(const Shapes_data& data, const Import& in) : planes(data.coefficients.size())
  {
    const double epsilon = data.parameters.maximum_distance, rounding = 2 * rounding_of_distances(data, in);
    const auto fraction_of = [](double distance, double length) {
      return std::uint64_t((std::min)(distance / length, 1.) * double(Score::tolerance_units) + .5);
    };
    for(std::size_t i = 0; i < in.size(); ++i) {
      const std::int32_t s = data.shape_of[in.item_of(i)];
      if(s < 0)
        continue;
      const Coefficients& c = data.coefficients[std::size_t(s)];
      const Vector p = in.position(i);
      const double found = std::fabs(c[0] * p.x + c[1] * p.y + c[2] * p.z + c[3]);
      const double tolerance =
        in.has_tolerances ? epsilon * level_factor(level_of((std::min)(in.tolerances[i], epsilon), epsilon)) : epsilon;
      ++assigned;
      fit += std::uint64_t(Score::weight_at(fraction_of(found, tolerance)));
      fit_error += (std::min)(rounding / tolerance, 1.) + 1e-6;
      planes[std::size_t(s)].add(p, data.uncertainty[std::size_t(s)], found, in.grid.step);
    }
  }
};

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
  if(t.angle_note != angle_note(data.parameters))
    return "the statistics are wrong: angle_note is \"" + t.angle_note + '"';
  const double assigned = double(sums.assigned);
  const std::string wrong_count = first_violation({
    count_of("number_of_directions", t.number_of_directions, r.number_of_directions),
    count_of("number_of_planes", t.number_of_planes, r.number_of_planes),
    count_of("number_of_orthogonal_pairs", t.number_of_orthogonal_pairs, r.number_of_orthogonal_pairs),
    count_of("degrees_of_freedom", t.degrees_of_freedom, r.degrees_of_freedom),
    count_of("has_estimated_normals", t.has_estimated_normals, !in.has_normals),
    count_of("is_grid_coarse", t.is_grid_coarse, in.grid.is_coarse),
    {"grid_step", t.grid_step, in.grid.step, 0},
    {"complexity", t.complexity, r.complexity, 0},
  });
  if(!wrong_count.empty() || t.free_points.unselected > 0) // the rest is that of all shapes
    return wrong_count;
  return first_violation({
    {"score.fit", t.score.fit, r.score.fit, sums.fit_error + assigned / double(Score::unit)},
    {"score.size", t.score.size, r.score.size, 0},
    {"score.price", t.score.price, r.score.price, 0},
    {"score.freedom", t.score.freedom, r.score.freedom, 0},
  });
}

// The neighbors of surfel i that have another shape, or one where it has none, for each of its points.
inline void count_links(const Cloud_view& cloud, std::uint32_t i, const std::uint32_t* label, Score_counts& counts)
{
  const std::uint32_t* row = cloud.row(i);
  for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
    if(label[row[j]] != label[i])
      (label[i] == free_label || label[row[j]] == free_label ? counts.free_links : counts.links) +=
        cloud.surfels.points(i).size();
}

// The links are counted again in the neighbor graph, unless shapes were left out.
template <class Backend>
std::string links_violation(Backend& backend, Import& in, const Shapes_data& data)
{
  if(data.statistics.free_points.unselected > 0)
    return {};
  Labeled_points labeled = {data.parameters, data.coefficients, {}, {}};
  for(std::size_t i = 0; i < in.size(); ++i) {
    labeled.shape.push_back(data.shape_of[in.item_of(i)]);
    if(!in.has_normals)
      labeled.normal.push_back(data.normal[in.item_of(i)]);
  }
  std::size_t mixed = labeled.shapes();
  Labeled_cloud<Backend> points(backend);
  const std::vector<std::uint32_t> label = label_graph(points, in, labeled, mixed);
  const Cloud_view view = points.cloud.view();
  Score_counts counts;
  for(std::uint32_t i = 0; i < view.size; ++i)
    count_links(view, i, label.data(), counts);
  const double links = to_points({0, Score(data.parameters).links(counts.links, counts.free_links), 0, 0, 0}).links;
  return first_violation({{"score.links", data.statistics.score.links, links, 0}});
}

// Seconds, rounds and bytes cannot be measured again.
inline std::string cost_violation(const Statistics& t, const Import& in)
{
  const auto& [normals, sort, neighbors, growth, regularity, finish, total] = t.times;
  const double stages = normals + sort + neighbors + growth + regularity + finish;
  const bool has_shapes = t.number_of_shapes > 0;
  const std::size_t points = std::size_t(in.total.points), other_bytes = std::size_t(1) << 20;
  if(!((std::min)({normals, sort, neighbors, growth, regularity, finish}) >= 0 &&
       std::fabs(total - stages) <= 1e-9 * stages))
    return "the stages take " + to_text(stages) + " seconds, but all of it " + to_text(total);
  if(t.number_of_rounds < std::size_t(has_shapes) || t.number_of_rounds > std::size_t(tuning::loop::maximum_rounds))
    return "there are " + to_text(t.number_of_rounds) + " rounds";
  if(t.peak_bytes > 1024 * points + other_bytes || (has_shapes && t.peak_bytes < sizeof(Grid_point) * points))
    return "the tables of " + to_text(points) + " points had " + to_text(t.peak_bytes) + " bytes";
  return t.backend.empty() ? "there is no back end" : "";
}

// Of a result that is_valid_result() accepts. Empty if there is none.
template <class PointRange, class GeomTraits, class NP>
std::string measured_violation(const PointRange& points, const Planar_shapes_3<GeomTraits>& shapes, const NP& np)
{
  const Round_to_nearest rounding;
  const Shapes_data& data = shapes.data();
  return with_traits<CGAL::Parallel_if_available_tag>(points, np, [&](const auto& traits) {
    auto backend = traits.backend();
    using Backend = decltype(backend);
    Import in = read_range(backend, points, np, traits);
    drop_far_points(Ranks<Backend>(backend), in, data.parameters.maximum_distance);
    choose_grid(in, data.parameters);
    const Point_sums sums(data, in);
    for(const std::string& violation : {count_violation(data, in, sums), cost_violation(data.statistics, in),
                                        uncertainty_violation(data, in.grid, sums.planes)})
      if(!violation.empty())
        return violation;
    return in.total.points == 0 ? std::string() : links_violation(backend, in, data);
  });
}

} // namespace CGAL::Tandem::internal

// What is wrong with a result, or nothing.
template <class PointRange, class GeomTraits, class NP>
std::string violation_of(const PointRange& points, const CGAL::Tandem::Planar_shapes_3<GeomTraits>& shapes,
                         const NP& np)
{
  std::string why;
  const bool is_valid = CGAL::Tandem::is_valid_result(points, shapes, np, &why);
  return is_valid ? CGAL::Tandem::internal::measured_violation(points, shapes, np) : why;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEASURED_VIOLATION_H
