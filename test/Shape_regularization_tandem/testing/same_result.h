// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether two results are the same in all bits that the public interface shows, by a comparison without hashes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SAME_RESULT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SAME_RESULT_H

#include "test_support.h"

#include <array>
#include <string>
#include <vector>

// Of all values, except that 0 and -0 are equal. NaN is equal to itself.
inline std::uint64_t bits(double x)
{
  x += 0.;
  std::uint64_t result;
  std::memcpy(&result, &x, sizeof result);
  return result;
}

template <class Geometry>
std::array<std::uint64_t, 3> bits(const Geometry& g)
{
  return {bits(g.x()), bits(g.y()), bits(g.z())};
}

using Words = std::vector<std::uint64_t>;

template <class... Numbers>
void add_bits(Words& words, Numbers... numbers)
{
  (words.push_back(bits(double(numbers))), ...);
}

inline void add_parameters(Words& words, const Parameters& p)
{
  add_bits(words, p.maximum_distance, p.maximum_angle, p.angle_tolerance, p.maximum_offset, p.simplicity, p.regularity,
           p.fixed_regularity, p.surfel_size, p.minimum_region_size, p.k_neighbors, p.cell_size);
}

// What a result says about shapes and their relations, as numbers: all but times, memory, and the name of the back end.
// With many processes it is the same in all of them.
inline Words shape_bits(const Shapes& shapes)
{
  const auto& data = shapes.data();
  const CGAL::Tandem::Statistics& t = shapes.statistics();
  Words all;
  add_parameters(all, data.parameters);
  add_bits(all, t.number_of_points, t.number_of_ignored_coordinates, t.number_of_ignored_normals,
           t.number_of_ignored_tolerances, t.number_of_far_points, t.number_of_assigned_points, t.number_of_shapes,
           t.number_of_directions, t.number_of_planes, t.number_of_orthogonal_pairs, t.degrees_of_freedom,
           t.number_of_rounds, t.is_grid_coarse, t.has_estimated_normals, t.is_cancelled, t.coverage, t.mean_distance,
           t.complexity, t.grid_step, t.line_spacing, t.score.fit, t.score.links, t.score.size, t.score.price,
           t.score.freedom);
  const CGAL::Tandem::Free_points& f = t.free_points;
  add_bits(all, f.without_normal, f.misaligned, f.misfit, f.without_neighbors, f.in_small_regions, f.clutter,
           f.unselected);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const std::size_t last = all.size();
    all.resize(last + 4);
    std::memcpy(&all[last], &data.coefficients[s], 4 * sizeof(double));
    add_bits(all, data.parallel_group[s], data.coplanar_group[s], data.is_flipped[s]);
    const CGAL::Tandem::Plane_uncertainty& u = data.uncertainty[s];
    add_bits(all, u.centroid[0], u.centroid[1], u.centroid[2], u.noise, u.offset_deviation, u.angle_deg);
    for(const double x : u.normal_covariance)
      add_bits(all, x);
  }
  for(const auto* groups : {&data.fixed_direction, &data.symmetry_group})
    for(const auto group : *groups)
      add_bits(all, group);
  for(const auto& pair : data.orthogonal_groups)
    add_bits(all, pair.first, pair.second);
  return all;
}

// Of a point, without its normal if that is not read.
inline std::array<std::uint64_t, 6> input_bits(const Cloud::value_type& item, Given given)
{
  const auto p = bits(item.first);
  const auto n = given == Given::normals ? bits(item.second) : std::array<std::uint64_t, 3>();
  return {p[0], p[1], p[2], n[0], n[1], n[2]};
}

// What it says about a point: its label, and its normal if that was estimated.
inline std::array<std::uint64_t, 4> point_bits(const Shapes& shapes, std::size_t i)
{
  std::array<std::uint64_t, 3> normal = {0, 0, 0};
  if(shapes.has_estimated_normals())
    normal = bits(shapes.estimated_normal(i));
  return {std::uint64_t(shapes.shape_index(i)), normal[0], normal[1], normal[2]};
}

// Empty if all bits are equal. The same points in the same order.
inline std::string difference(const Shapes& a, const Shapes& b)
{
  const long shape = first_difference(shape_bits(a), shape_bits(b));
  if(shape >= 0)
    return "reproducibility: the shapes differ, first in number " + std::to_string(shape);
  for(std::size_t i = 0; i < a.number_of_points(); ++i)
    if(point_bits(a, i) != point_bits(b, i))
      return "reproducibility: the results differ at point " + std::to_string(i);
  return "";
}

struct Result_of {
  const Cloud& cloud;
  const Shapes& shapes;
};

// The same for clouds whose points are in different orders. Equal points may have exchanged their results.
inline std::string difference(const Result_of& a, const Result_of& b, Given given)
{
  const long shape = first_difference(shape_bits(a.shapes), shape_bits(b.shapes));
  if(shape >= 0)
    return "reproducibility: in another order the shapes differ, first in number " + std::to_string(shape);
  using Point = std::pair<std::array<std::uint64_t, 6>, std::array<std::uint64_t, 4>>;
  std::vector<Point> list[2];
  for(const Result_of* r : {&a, &b})
    for(std::size_t i = 0; i < r->cloud.size(); ++i)
      list[r == &b].push_back({input_bits(r->cloud[i], given), point_bits(r->shapes, i)});
  for(std::vector<Point>& l : list)
    std::sort(l.begin(), l.end());
  return list[0] == list[1] ? "" : "reproducibility: in another order the points differ";
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SAME_RESULT_H
