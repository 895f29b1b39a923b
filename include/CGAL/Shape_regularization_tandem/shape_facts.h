// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPE_FACTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPE_FACTS_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL::Tandem {
namespace internal::facts {

// With the areas that areas_of(coordinates) returns.
template <class GeomTraits, class PointRange, class NP, class Areas>
std::vector<Shape_facts> facts_with_areas(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                          const NP& np, Areas areas_of)
{
  const std::array<double, 3>& axis = shapes.parameters().symmetry_direction;
  const CGAL::Simple_cartesian<double>::Vector_3 by_default(axis[0], axis[1], axis[2]);
  const Vector up = upward(parameter<internal_np::symmetry_direction_t>(np, by_default));
  const auto coordinates = checked_coordinates(shapes, points, np);
  std::vector<Shape_facts> facts = facts_table(coordinates, shapes.data(), up);
  const std::vector<double> areas = areas_of(coordinates);
  for(std::size_t s = 0; s < facts.size(); ++s)
    facts[s].area = areas[s];
  return facts;
}

} // namespace internal::facts

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief measures the shapes: position, size, inclination, and distances to their points.

Include `CGAL/Shape_regularization_tandem_models.h`.

A shape of n points takes O(n log n) time. Most of it is spent in `polygons()`, for the areas; the second function takes
the areas from polygons that the caller has already. With `CGAL_LINKED_WITH_TBB`, shapes are processed in parallel.
The result is the same for every number of threads.

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
\cgalNamedParamsEnd

\return an entry for each shape

\throw std::invalid_argument the number of points is not that of the detection; a point of a shape is not
finite or farther from its plane than `maximum_distance`; the direction is null or not finite
\throw std::logic_error the points are distributed over several processes (`Mpi_tag`)
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Shape_facts> shape_facts(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                     const NamedParameters& np = NamedParameters())
{
  return internal::facts::facts_with_areas(shapes, points, np, [&](const auto& coordinates) {
    return internal::outlines::outline_table(coordinates, shapes.data()).areas;
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
  if(areas.number_of_entries() != shapes.number_of_shapes())
    throw std::invalid_argument("There are " + std::to_string(areas.number_of_entries()) + " entries of polygons for " +
                                std::to_string(shapes.number_of_shapes()) +
                                " shapes: pass the polygons of the shapes.");
  std::vector<double> of_shapes;
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    of_shapes.push_back(areas.area(s));
  return internal::facts::facts_with_areas(shapes, points, np, [&](const auto&) { return of_shapes; });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_SHAPE_FACTS_H
