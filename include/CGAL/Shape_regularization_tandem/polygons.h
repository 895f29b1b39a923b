// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_POLYGONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_POLYGONS_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/Shape_polygons_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief finds the areas that the points of shapes cover, as polygons with holes in the planes of the shapes.

Where a shape ends at the plane of another one, the boundary is straight, and its corners are on both planes; three
planes meet in one corner. The rest of a boundary follows the points at their spacing. \ref Tandem_models_polygons
describes the result.

It is in the header `CGAL/Shape_regularization_tandem/polygons.h`, which `CGAL/Shape_regularization_tandem.h` does not
include.

Each shape of n points takes O(n log n) time for a Delaunay triangulation in its plane, and time in proportion to the
points that are close to planes of shapes nearby. With `CGAL_LINKED_WITH_TBB`, shapes are processed in parallel. The
result is the same for every number of threads, and does not depend on the order of the points of a shape.

\param shapes the result of a detection
\param points the range of points that it is of
\param np an optional sequence of named parameters, among those listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map from the values of the range to points}
    \cgalParamDefault{that of the range: the identity, or the point map of a `CGAL::Point_set_3`}
  \cgalParamNEnd
  \cgalParamNBegin{one_for_each_plane}
    \cgalParamDescription{whether an entry is a distinct plane, with the points of all of its shapes, in the order of
    `Planar_shapes_3::distinct_planes()`, instead of a shape}
    \cgalParamType{`bool`}
    \cgalParamDefault{`false`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\throw std::invalid_argument the points are not those of the detection, nor the projections of these: their number is
another one, or one of a shape is not finite or farther from its plane than `maximum_distance`
\throw std::logic_error a part of the points of the shapes are in other processes: `Mpi_tag`
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
Shape_polygons_3<GeomTraits> polygons(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                      const NamedParameters& np = NamedParameters())
{
  const std::vector<internal::Position> coordinates = internal::checked_coordinates(shapes, points, np);
  const bool is_by_plane = internal::parameter<internal_np::one_for_each_plane_t>(np, false);
  const Shapes_data data =
    is_by_plane ? internal::relabel_shapes(shapes.data(), shapes.distinct_planes(), shapes.data().coplanar_group)
                : shapes.data();
  return Shape_polygons_3<GeomTraits>(internal::outlines::outline_table(coordinates, data));
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_POLYGONS_H
