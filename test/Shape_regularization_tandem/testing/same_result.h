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

// What a result says about shapes and their relations, as numbers.
inline std::vector<std::uint64_t> shape_bits(const Shapes& shapes)
{
  std::vector<std::uint64_t> all = {shapes.number_of_shapes(), shapes.number_of_points()};
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const std::size_t last = all.size();
    all.insert(all.end(), {0, 0, 0, 0, shapes.parallel_group(s), shapes.coplanar_group(s), shapes.is_flipped(s)});
    std::memcpy(&all[last], &shapes.coefficients(s), 4 * sizeof(double));
    const CGAL::Tandem::Plane_uncertainty& u = shapes.uncertainty(s);
    for(const double x : {u.centroid[0], u.centroid[1], u.centroid[2], u.noise, u.offset_deviation, u.angle_deg})
      all.push_back(bits(x));
    for(const double x : u.normal_covariance)
      all.push_back(bits(x));
  }
  for(const auto& pair : shapes.orthogonal_groups())
    all.insert(all.end(), {std::uint64_t(pair.first), std::uint64_t(pair.second)});
  const Parameters& p = shapes.parameters();
  all.insert(all.end(), {bits(p.maximum_distance), bits(p.maximum_offset), p.minimum_region_size,
                         shapes.statistics().number_of_rounds, bits(shapes.statistics().mean_distance),
                         bits(shapes.statistics().score.fit), bits(shapes.statistics().score.links),
                         bits(shapes.statistics().score.freedom)});
  const CGAL::Tandem::Free_points& f = shapes.statistics().free_points;
  all.insert(all.end(), {f.without_normal, f.misfit, f.without_neighbors, f.in_small_regions, f.clutter, f.unselected});
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
