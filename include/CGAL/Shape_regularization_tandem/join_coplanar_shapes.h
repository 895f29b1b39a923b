// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_JOIN_COPLANAR_SHAPES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_JOIN_COPLANAR_SHAPES_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/internal/measured_uncertainty.h>
#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

namespace internal {

// By plane, whether most points are of shapes that are flipped.
inline std::vector<char> are_mostly_flipped(const Shapes_data& data, std::size_t planes)
{
  std::vector<std::ptrdiff_t> flipped(planes, 0);
  for(std::size_t s = 0; s < data.size.size(); ++s)
    flipped[std::size_t(data.coplanar_group[s])] += std::ptrdiff_t(data.size[s]) * (data.is_flipped[s] ? 1 : -1);
  std::vector<char> result;
  for(std::ptrdiff_t points : flipped)
    result.push_back(points > 0);
  return result;
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief makes one shape of all shapes of each coplanar group: a result with one shape for each distinct plane.

Shape s of the result is coplanar group s of `shapes`, with all of its points. What `Planar_shapes_3` promises holds, but
for this:

- a shape need not be connected, so `is_valid_result()` returns `false`;
- a shape is flipped if the shapes with most of its points are, whatever the normals of most points;
- the links of `Statistics::score` remain those of the detection, and so do all statistics but the numbers of shapes
  and relations and the other terms of the score.

\return the result with one shape for each distinct plane
\param shapes the result of a detection
\param points the range of points that it is of
\param np an optional sequence of named parameters, of which `point_map` is read

\throw std::invalid_argument the number of points is not that of the detection, or a point of a shape is not
finite or farther from its plane than `maximum_distance`
\throw std::logic_error the points are distributed over several processes (`Mpi_tag`)
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
Planar_shapes_3<GeomTraits> join_coplanar_shapes(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                                 const NamedParameters& np = NamedParameters())
{
  const auto coordinates = internal::checked_coordinates(shapes, points, np);
  const internal::Shapes_data& of_shapes = shapes.data();
  internal::Shapes_data data = internal::relabel_shapes(of_shapes, shapes.distinct_planes(), of_shapes.coplanar_group);
  data.is_flipped = internal::are_mostly_flipped(of_shapes, data.size.size());
  const Planar_shapes_3<GeomTraits> joined(data);
  const auto position = [&](std::size_t i) {
    return internal::Vector{coordinates[i][0], coordinates[i][1], coordinates[i][2]};
  };
  for(std::size_t s = 0; s < data.size.size(); ++s)
    if(!joined.points(s).empty())
      data.uncertainty[s] = internal::measured_uncertainty(joined.points(s), position, data.coefficients[s],
                                                           data.parameters, data.statistics.grid_step);
  data.points = joined.point_groups();
  return Planar_shapes_3<GeomTraits>(std::move(data));
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_JOIN_COPLANAR_SHAPES_H
