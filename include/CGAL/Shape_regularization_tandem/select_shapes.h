// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_SELECT_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_SELECT_SHAPES_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Shape_regularization_tandem/internal/resolve_parameters.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Tandem/Parameters.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace CGAL::Tandem {

namespace internal {

constexpr double default_near_angle = 10; // degrees
inline constexpr Count_range largest_range = {"largest", 1, maximum_number_of_points};

// A direction of the named parameters.
template <class Tag, class NP>
Vector unit_direction(const NP& np, const char* name)
{
  const std::array<double, 3> d = read_direction(parameter<Tag>(np, 0));
  check_direction(name, d);
  return given_direction(d);
}

template <class NP>
double read_near_angle(const NP& np)
{
  double angle = default_near_angle;
  read_real<internal_np::near_angle_t>(np, angle);
  if(!(angle >= 0 && angle <= 90))
    throw_out_of_range("near_angle", angle, "[0, 90] degrees");
  return angle;
}

// Of the shapes, those with is_kept(s).
template <class Is_kept>
void keep_shapes(std::vector<std::size_t>& shapes, Is_kept is_kept)
{
  shapes.erase(std::remove_if(shapes.begin(), shapes.end(), [&](std::size_t s) { return !is_kept(s); }), shapes.end());
}

// By the directions of their normals, up to the sign.
template <class NP>
void keep_directed_shapes(const Shapes_data& data, const NP& np, std::vector<std::size_t>& shapes)
{
  [[maybe_unused]] const double angle = read_near_angle(np);
  [[maybe_unused]] const auto degrees_from = [&](std::size_t s, const Vector& direction) {
    const Vector n = {data.coefficients[s][0], data.coefficients[s][1], data.coefficients[s][2]};
    return std::atan2(length(cross(n, direction)), std::fabs(dot(n, direction))) * (180 / 3.14159265358979323846);
  };
  if constexpr(Is_given<internal_np::near_direction_t, NP>::value) {
    const Vector direction = unit_direction<internal_np::near_direction_t>(np, "near_direction");
    keep_shapes(shapes, [&](std::size_t s) { return degrees_from(s, direction) <= angle; });
  }
  if constexpr(Is_given<internal_np::orthogonal_direction_t, NP>::value) {
    const Vector direction = unit_direction<internal_np::orthogonal_direction_t>(np, "orthogonal_direction");
    keep_shapes(shapes, [&](std::size_t s) { return 90 - degrees_from(s, direction) <= angle; });
  }
}

// By area and extent, where least ones are given. Areas take longest to measure.
template <class GeomTraits, class PointRange, class NP>
void keep_measured_shapes(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points, const NP& np,
                          std::vector<std::size_t>& kept)
{
  double area = 0, extent = 0;
  read_real<internal_np::minimum_area_t>(np, area);
  read_real<internal_np::minimum_extent_t>(np, extent);
  check_length("minimum_area", area, 0);
  check_length("minimum_extent", extent, 0);
  if(area == 0 && extent == 0)
    return;
  const auto coordinates = checked_coordinates(shapes, points, np);
  if(extent > 0) {
    const std::vector<Shape_facts> measured = facts::facts_table(coordinates, shapes.data(), Vector{0, 0, 1});
    keep_shapes(kept, [&](std::size_t s) { return measured[s].length >= extent; });
  }
  if(area > 0) {
    const std::vector<double> areas = outlines::outline_table(coordinates, shapes.data()).areas;
    keep_shapes(kept, [&](std::size_t s) { return areas[s] >= area; });
  }
}

// Those with most points, of equal ones the first; in the order that they had.
inline void keep_largest_shapes(const Shapes_data& data, std::size_t number, std::vector<std::size_t>& shapes)
{
  if(shapes.size() <= number)
    return;
  std::stable_sort(shapes.begin(), shapes.end(),
                   [&](std::size_t s, std::size_t t) { return data.size[s] > data.size[t]; });
  shapes.resize(number);
  std::sort(shapes.begin(), shapes.end());
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns a result that has only the shapes with these indices.

Shape i of the result is the shape of the i-th index, so the order is that of the indices. Points of other shapes have
no shape, and count as `Free_points::unselected`. Planes, and the relations of the shapes that are left, are the same;
groups are numbered again, and numbers of shapes, relations and points are counted again. So `is_valid_result()` returns
`true`, and all functions on results can be used. Some measures remain those of the detection:
`Statistics::mean_distance`, the other numbers of `Statistics::free_points`, `Statistics::times` and, where shapes are
left out, `Statistics::score`.

Include `CGAL/Shape_regularization_tandem_models.h`. With `Mpi_tag`, each process calls it for its own result, with the
same indices.

\param shapes the result of a detection
\param indices a range of integers, in any order; an empty range gives a result without shapes

\throw std::invalid_argument an index is not that of a shape, or occurs twice
*/
template <class GeomTraits, class IndexRange>
Planar_shapes_3<GeomTraits> select_shapes(const Planar_shapes_3<GeomTraits>& shapes, const IndexRange& indices)
{
  std::vector<std::size_t> source;
  std::vector<int> number(shapes.number_of_shapes(), -1); // in the result, by shape
  for(const auto& index : indices) {
    const std::size_t s = std::size_t(index); // negative ones become too large
    if(s >= number.size())
      throw std::invalid_argument("There is no shape " + internal::to_text(index) + ": the result has " +
                                  internal::to_text(number.size()) + " shapes, from 0 on.");
    if(number[s] >= 0)
      throw std::invalid_argument("Shape " + internal::to_text(s) + " is selected twice.");
    number[s] = int(source.size());
    source.push_back(s);
  }
  return Planar_shapes_3<GeomTraits>(internal::relabel_shapes(shapes.data(), source, number));
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns a result that has only the shapes that fit all given criteria, in their order. The function above makes
the result, from their indices.

\param shapes the result of a detection
\param points the range of points that it is of. Only `minimum_area` and `minimum_extent` read it.
\param np a sequence of named parameters, among those listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{near_direction, orthogonal_direction}
    \cgalParamDescription{vectors of any length. Normals are within `near_angle` of `near_direction`, up to their sign,
    and orthogonal to `orthogonal_direction` up to `near_angle`. With the vertical, `near_direction` selects level
    planes, and `orthogonal_direction` selects walls.}
    \cgalParamType{`Vector_3` of a kernel}
    \cgalParamDefault{all directions}
  \cgalParamNEnd
  \cgalParamNBegin{near_angle}
    \cgalParamDescription{in degrees, in [0, 90]}
    \cgalParamDefault{10}
  \cgalParamNEnd
  \cgalParamNBegin{minimum_area, minimum_extent}
    \cgalParamDescription{the least `Shape_facts::area`, that of the outline among all shapes, and the least
    `Shape_facts::length`, the longer side of the smallest rectangle that holds the points}
    \cgalParamDefault{0: all shapes}
  \cgalParamNEnd
  \cgalParamNBegin{largest}
    \cgalParamDescription{how many of the shapes that fit the other criteria are selected: those with most points, of
    equal ones those of lower index}
    \cgalParamDefault{all}
  \cgalParamNEnd
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map from the values of the range to points}
    \cgalParamDefault{that of the range: the identity, or the point map of a `CGAL::Point_set_3`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\throw Parameter_error a parameter is outside of its range
\throw std::invalid_argument the points are read, and are not those of the detection
\throw std::logic_error the points are read, and a part of them is in other processes (`Mpi_tag`). The other criteria
select the same shapes in all processes.
*/
template <class GeomTraits, class PointRange, class NamedParameters>
Planar_shapes_3<GeomTraits> select_shapes(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                          const NamedParameters& np)
{
  std::vector<std::size_t> kept(shapes.number_of_shapes());
  std::iota(kept.begin(), kept.end(), std::size_t(0));
  internal::keep_directed_shapes(shapes.data(), np, kept);
  internal::keep_measured_shapes(shapes, points, np, kept);
  std::size_t largest = kept.size();
  internal::read_count<internal_np::largest_t>(np, internal::largest_range, largest);
  internal::keep_largest_shapes(shapes.data(), largest, kept);
  return select_shapes(shapes, kept);
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_SELECT_SHAPES_H
