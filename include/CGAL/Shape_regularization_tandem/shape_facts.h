// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPE_FACTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPE_FACTS_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Shape_regularization_tandem/internal/resolve_parameters.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/select_shapes.h>
#include <CGAL/Tandem/internal/base/angles.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
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
  const double angle = read_near_angle(np);
  // The same on all machines: sine and cosine are.
  const double sine = sine_deg(angle), cosine = cosine_deg(angle);
  const auto normal = [&](std::size_t s) {
    return Vector{data.coefficients[s][0], data.coefficients[s][1], data.coefficients[s][2]};
  };
  [[maybe_unused]] const auto along = [&](std::size_t s, const Vector& d) { return std::fabs(dot(normal(s), d)); };
  [[maybe_unused]] const auto across = [&](std::size_t s, const Vector& d) { return length(cross(normal(s), d)); };
  if constexpr(Is_given<internal_np::near_direction_t, NP>::value) {
    const Vector direction = unit_direction<internal_np::near_direction_t>(np, "near_direction");
    keep_shapes(shapes, [&](std::size_t s) { return across(s, direction) * cosine <= along(s, direction) * sine; });
  }
  if constexpr(Is_given<internal_np::orthogonal_direction_t, NP>::value) {
    const Vector direction = unit_direction<internal_np::orthogonal_direction_t>(np, "orthogonal_direction");
    keep_shapes(shapes, [&](std::size_t s) { return along(s, direction) * cosine <= across(s, direction) * sine; });
  }
}

// From where the points were seen, where a map tells that.
template <class PointRange, class NP>
facts::Stations stations_of(const PointRange& points, const NP& np)
{
  facts::Stations result;
  if constexpr(Is_given<internal_np::viewpoint_map_t, NP>::value) {
    const auto& map = parameter<internal_np::viewpoint_map_t>(np, 0);
    Numbering<Position> number;
    for(const auto& item : points) {
      const auto& p = get(map, item);
      Position place = {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
      if(!std::isfinite(place[0] + place[1] + place[2]))
        place = {HUGE_VAL, 0, 0}; // a key, as NaN is none
      result.of_point.push_back(std::uint32_t(number(place)));
      if(result.of_point.back() == result.places.size())
        result.places.push_back(place);
    }
  }
  return result;
}

// Without veils, where a map tells from where the points were seen.
template <class GeomTraits, class PointRange, class NP>
void keep_surfaces(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points, const NP& np,
                   std::vector<std::size_t>& kept)
{
  if constexpr(Is_given<internal_np::viewpoint_map_t, NP>::value) {
    const std::vector<char> veils =
      facts::veil_table(checked_coordinates(shapes, points, np), shapes.data(), stations_of(points, np));
    keep_shapes(kept, [&](std::size_t s) { return veils[s] == 0; });
  }
}

// By area and extent, where least ones are given.
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
  const std::vector<Shape_facts> measured = facts::facts_table(coordinates, shapes.data(), Vector{0, 0, 1},
                                                               outlines::outline_table(coordinates, shapes.data()));
  keep_shapes(kept, [&](std::size_t s) { return measured[s].length >= extent && measured[s].area >= area; });
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

namespace internal::facts {

// With the outlines that outlines_of(coordinates) returns.
template <class GeomTraits, class PointRange, class NP, class Outlines>
std::vector<Shape_facts> facts_of_shapes(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                         const NP& np, Outlines outlines_of)
{
  const std::array<double, 3>& axis = shapes.parameters().symmetry_direction;
  const CGAL::Simple_cartesian<double>::Vector_3 by_default(axis[0], axis[1], axis[2]);
  const Vector up = upward(parameter<internal_np::symmetry_direction_t>(np, by_default));
  const auto coordinates = checked_coordinates(shapes, points, np);
  return facts_table(coordinates, shapes.data(), up, outlines_of(coordinates), stations_of(points, np));
}

} // namespace internal::facts

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief measures the shapes: position, size, inclination, distances to their points, curvature and class.

Include `CGAL/Shape_regularization_tandem_models.h`.

A shape of n points takes O(n log n) time. Most of it is spent in `polygons()`, for the areas; the second function takes
the areas from polygons that the caller has already. With `CGAL_LINKED_WITH_TBB`, shapes are processed in parallel.
The result is the same for every number of threads, and does not depend on the order of the points.

\param shapes the result of a detection
\param points the range of points that it is of
\param np an optional sequence of named parameters, among those listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map from the values of the range to points}
    \cgalParamDefault{that of the range: the identity, or the point map of a `CGAL::Point_set_3`}
  \cgalParamNEnd
  \cgalParamNBegin{symmetry_direction}
    \cgalParamDescription{the direction upward. North and east are the axes y and x, after the smallest rotation that
    takes z to it}
    \cgalParamType{`GeomTraits::Vector_3`}
    \cgalParamDefault{the `symmetry_direction` of the detection, which is (0, 0, 1) if it was not given}
  \cgalParamNEnd
  \cgalParamNBegin{viewpoint_map}
    \cgalParamDescription{a property map from the values of the range to the places from which a sensor saw the points,
    for `Shape_facts::is_veil` and `Shape_facts::behind`. A `CGAL::Constant_property_map` serves one station. Where a
    coordinate is not finite, the place is not known.}
    \cgalParamType{a readable property map with values of type `Point_3` of a kernel}
    \cgalParamDefault{the places are not known}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return an entry for each shape

\throw Parameter_error the direction is null or not finite
\throw std::invalid_argument the number of points is not that of the detection, or a point of a shape is not finite or
farther from its plane than `maximum_distance`
\throw std::logic_error the points are distributed over several processes (`Mpi_tag`)
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Shape_facts> shape_facts(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                     const NamedParameters& np = NamedParameters())
{
  return internal::facts::facts_of_shapes(shapes, points, np, [&](const auto& coordinates) {
    return internal::outlines::outline_table(coordinates, shapes.data());
  });
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief measures the shapes as above, with areas from polygons that the caller has already.

\param shapes the result of a detection
\param points the range of points that it is of
\param areas the result of `polygons()` for these shapes, with an entry for each shape
\param np the named parameters above

\return an entry for each shape

\throw std::invalid_argument as above, or `areas` does not have one entry for each shape
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Shape_facts> shape_facts(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                     const Shape_polygons_3<GeomTraits>& areas,
                                     const NamedParameters& np = NamedParameters())
{
  internal::check_entries(shapes, areas);
  return internal::facts::facts_of_shapes(
    shapes, points, np, [&](const auto&) -> const auto& { return areas.table(); });
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns a result that has only the shapes that fit all given criteria, in their order. The function above makes
the result, from their indices.

\param shapes the result of a detection
\param points the range of points that it is of. Only `minimum_area`, `minimum_extent` and `viewpoint_map` read it.
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
    `Shape_facts::length`, the longer side of the smallest rectangle that holds points and outline}
    \cgalParamDefault{0: all shapes}
  \cgalParamNEnd
  \cgalParamNBegin{largest}
    \cgalParamDescription{at least 1: how many of the shapes that fit the other criteria are selected: those with most
    points, of equal ones those of lower index}
    \cgalParamDefault{all}
  \cgalParamNEnd
  \cgalParamNBegin{viewpoint_map}
    \cgalParamDescription{as above: leaves out shapes with `Shape_facts::is_veil`}
    \cgalParamDefault{veils are shapes as others}
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
  internal::keep_surfaces(shapes, points, np, kept);
  internal::keep_measured_shapes(shapes, points, np, kept);
  std::size_t largest = kept.size();
  internal::read_count<internal_np::largest_t>(np, internal::largest_range, largest);
  internal::keep_largest_shapes(shapes.data(), largest, kept);
  return select_shapes(shapes, kept);
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPE_FACTS_H
