// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What models are made of, checked: the points of a result, and the direction upward. In double, whatever the kernel of
// the caller is.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_CHECKED_COORDINATES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_CHECKED_COORDINATES_H

#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Tandem/internal/result/Shapes_data.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL::Tandem::internal {

// The direction upward, of length 1.
template <class Vector_3>
Vector upward(const Vector_3& v)
{
  const std::array<double, 3> c = {CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z())};
  check_direction("symmetry_direction", c);
  const double largest = (std::max)({std::fabs(c[0]), std::fabs(c[1]), std::fabs(c[2])});
  const double x = c[0] / largest, y = c[1] / largest, z = c[2] / largest;
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

template <class Any_shapes>
void check_number_of_points(const std::string& range, std::size_t number_of_points, const Any_shapes& shapes)
{
  if(number_of_points != shapes.number_of_points())
    throw std::invalid_argument(range + " has " + std::to_string(number_of_points) + " points, the shapes are of " +
                                std::to_string(shapes.number_of_points()) + ": pass the range of the detection.");
}

template <class Any_shapes>
void check_input(const Any_shapes& shapes, std::size_t number_of_points)
{
  check_number_of_points("The range", number_of_points, shapes);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    if(shapes.points(s).size() != shapes.size(s))
      throw std::logic_error("Points of shapes are in other processes: pass a result of one process.");
}

// Of the caller's points, in the order of the range: std::vector<Position>. The type is deduced so that the
// compiler names the line of the caller where the points have another type.
template <class PointRange, class NP>
auto coordinates_of(const PointRange& points, const NP& np)
{
  std::vector<Position> result;
  using Maps = Traits_for<CGAL::Sequential_tag, PointRange, NP, false>;
  if constexpr(Maps::Check::value) {
    const auto map = point_map_of<typename Maps::type>(points, np);
    result.reserve(points.size());
    for(const auto& item : points) {
      const auto& p = get(map, item);
      result.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
  }
  return result;
}

// In doubles, of the coordinates that the detection had, which a kernel may round.
template <class FT>
double rounding_of()
{
  if constexpr(std::is_floating_point<FT>::value)
    return double(std::numeric_limits<FT>::epsilon());
  else
    return std::numeric_limits<double>::epsilon();
}

// The points of shapes are within `maximum_distance` of their planes, also those that were projected. Another order of the
// range shows by this.
template <class Any_shapes>
void check_points(const Any_shapes& shapes, const std::vector<Position>& points)
{
  const double rounding = 8 * rounding_of<typename Any_shapes::Geom_traits::FT>();
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const Coefficients& c = shapes.coefficients(s);
    for(std::uint32_t i : shapes.points(s)) {
      const Position& p = points[i];
      const double x = c[0] * p[0], y = c[1] * p[1], z = c[2] * p[2];
      const double size = std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(c[3]);
      if(!std::isfinite(size) ||
         !(std::fabs(x + y + z + c[3]) <= shapes.parameters().maximum_distance + rounding * size))
        throw std::invalid_argument("Point " + std::to_string(i) + " is not on the plane of its shape " +
                                    std::to_string(s) +
                                    " within the maximum distance: pass the range of the detection, in its order.");
    }
  }
}

// coordinates_of() a range that is that of the shapes, all of which are in this process. Otherwise it throws.
template <class Any_shapes, class PointRange, class NP>
auto checked_coordinates(const Any_shapes& shapes, const PointRange& points, const NP& np)
{
  check_input(shapes, points.size());
  auto coordinates = coordinates_of(points, np);
  check_points(shapes, coordinates);
  return coordinates;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_CHECKED_COORDINATES_H
