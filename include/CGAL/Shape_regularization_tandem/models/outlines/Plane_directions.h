// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directions in the plane of a shape that the relations of the shapes give: those of the lines with planes of the other
// parallel groups, and the directions orthogonal to these.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_DIRECTIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_DIRECTIONS_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

class Plane_directions {
public:
  explicit Plane_directions(const Shapes& shapes) : shapes(shapes)
  {
    std::vector<std::size_t> first(shapes.number_of_parallel_groups(), shapes.number_of_shapes());
    sizes.resize(first.size());
    for(std::size_t s = shapes.number_of_shapes(); s-- > 0;) {
      const std::size_t group = shapes.parallel_group(s);
      if(group >= first.size()) {
        first.resize(group + 1, shapes.number_of_shapes());
        sizes.resize(group + 1);
      }
      first[group] = s;
      sizes[group] += double(shapes.points(s).size());
    }
    representative = first;
  }

  // Unit vectors in the frame, each with the one orthogonal to it behind it: of the groups with most points, where those
  // of groups that are orthogonal to the shape count more.
  std::vector<Kernel::Vector_2> of_shape(std::size_t s, const Plane_frame& frame) const
  {
    std::vector<std::pair<double, Kernel::Vector_2>> found;
    for(std::size_t g = 0; g < representative.size(); ++g) {
      if(g == shapes.parallel_group(s) || representative[g] == shapes.number_of_shapes())
        continue;
      const std::size_t t = representative[g];
      const Kernel::Vector_3 cross = CGAL::cross_product(normal_of(s), normal_of(t));
      const double sine = std::sqrt(cross.squared_length());
      if(sine >= smallest_sine)
        found.emplace_back((shapes.are_orthogonal(s, t) ? preference : 1) * sizes[g], frame.flat(cross / sine));
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Kernel::Vector_2> result;
    for(const auto& [weight, d] : found)
      if(result.size() < 2 * largest_number && !has(result, d)) {
        result.push_back(d);
        result.push_back(d.perpendicular(CGAL::COUNTERCLOCKWISE));
      }
    return result;
  }

private:
  static constexpr double preference = 8;          // of orthogonal groups
  static constexpr std::size_t largest_number = 8; // of pairs: of more, one is close to any direction
  static constexpr double same_sine = 1e-9;

  static bool has(const std::vector<Kernel::Vector_2>& all, const Kernel::Vector_2& d)
  {
    return std::any_of(all.begin(), all.end(), [&](const Kernel::Vector_2& other) {
      return std::fabs(other.x() * d.y() - other.y() * d.x()) < same_sine;
    });
  }

  Kernel::Vector_3 normal_of(std::size_t s) const
  {
    const Shapes::Coefficients& c = shapes.coefficients(s);
    return Kernel::Vector_3(c[0], c[1], c[2]);
  }

  const Shapes& shapes;
  std::vector<std::size_t> representative; // a shape of each parallel group
  std::vector<double> sizes;               // points of each parallel group
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_DIRECTIONS_H
