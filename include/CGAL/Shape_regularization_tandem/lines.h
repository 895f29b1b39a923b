// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_LINES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_LINES_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <utility>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief The lines at which planar shapes meet: segments where two do, and corners where three do. `lines()` makes it.

A segment is a part of the line of two planes that is in the outlines of a shape of each. The shapes may both end there,
one may end at the other, or they may cross. A corner is at ends of segments, or inside of them.

\tparam GeomTraits a model of `Kernel`
*/
template <class GeomTraits>
struct Shape_lines_3 {
  /// the ends of all segments, and the corners. None is in it twice. Points that the outlines have, too, have the same
  /// coordinates there.
  std::vector<typename GeomTraits::Point_3> points;
  /// the segments, ascending by their shapes. Two shapes may have several. The coordinates of the first end are
  /// lexicographically smaller.
  std::vector<Indexed_segment> segments;
  /// the corners, ascending by their points
  std::vector<Indexed_corner> corners;
};

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief finds the lines at which shapes meet, of polygons that the caller has already.

\param shapes the result of a detection
\param areas the result of `polygons()` for these shapes, with an entry for each shape

\throw std::invalid_argument `areas` does not have one entry for each shape
*/
template <class GeomTraits>
Shape_lines_3<GeomTraits> lines(const Planar_shapes_3<GeomTraits>& shapes, const Shape_polygons_3<GeomTraits>& areas)
{
  using FT = typename GeomTraits::FT;
  internal::check_entries(shapes, areas);
  internal::outlines::Line_table table = internal::outlines::line_table(areas.table(), shapes.data());
  Shape_lines_3<GeomTraits> result;
  for(const auto& p : table.points)
    result.points.emplace_back(FT(p[0]), FT(p[1]), FT(p[2]));
  result.segments = std::move(table.segments);
  result.corners = std::move(table.corners);
  return result;
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief finds the lines at which shapes meet: segments of the lines of two planes, and corners of three planes.

\ref Tandem_models_lines describes the result. For one line for each two planes, pass the result of
`join_coplanar_shapes()`.

Include `CGAL/Shape_regularization_tandem_models.h`.

Most of the time is spent in `polygons()`; the function above takes polygons that the caller has already. Then two shapes
that are close to each other take time in proportion to the number of their corners. With `CGAL_LINKED_WITH_TBB`, shapes
are processed in parallel. The result is the same for every number of threads, and does not depend on the order of the
points of a shape.

\param shapes the result of a detection
\param points the range of points that it is of
\param np an optional sequence of named parameters, among those listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map from the values of the range to points}
    \cgalParamDefault{that of the range: the identity, or the point map of a `CGAL::Point_set_3`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\throw std::invalid_argument the points are not those of the detection, nor the projections of these: their number is
another one, or one of a shape is not finite or farther from its plane than `maximum_distance`
\throw std::logic_error the points are distributed over several processes (`Mpi_tag`)
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
Shape_lines_3<GeomTraits> lines(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                const NamedParameters& np = NamedParameters())
{
  return lines(shapes, Shape_polygons_3<GeomTraits>(internal::outlines::outline_table(
                         internal::checked_coordinates(shapes, points, np), shapes.data())));
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_LINES_H
