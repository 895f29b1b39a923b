// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_LABEL_POINTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_LABEL_POINTS_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/Plane_choice.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Shape_regularization_tandem/internal/resolve_parameters.h>
#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/neighbors/measure_cloud.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

namespace internal {

// A range among the named parameters, which copy it unless it comes by std::cref().
template <class Range>
const Range& referred(const Range& range)
{
  return range;
}
template <class Range>
const Range& referred(const std::reference_wrapper<const Range>& range)
{
  return range.get();
}

constexpr double spacings_in_reach = 4;
constexpr std::size_t few_to_label = 4096; // points: fewer are not worth a second thread

// The points of the shapes, by a range and maps that are those of the detection.
template <class Backend, class Shapes, class PointRange, class NP>
Places_in_reach places_of_shapes(Backend& backend, const Shapes& shapes, const PointRange& points, const NP& np)
{
  check_number_of_points("shape_points", points.size(), shapes);
  check_points(shapes, coordinates_of(points, np));
  const Import in = read_positions(backend, points, np);
  double reach = 0;
  read_real<internal_np::reach_t>(np, reach);
  if(Is_given<internal_np::reach_t, NP>::value)
    check_length("reach", reach, smallest_length);
  else
    reach = spacings_in_reach * measure_cloud(backend, in).spacing;
  if(reach == 0 && shapes.number_of_shapes() > 0)
    throw std::invalid_argument("reach cannot be estimated, as the spacing of shape_points is 0: pass it.");
  std::vector<Shape_place> places;
  for(std::size_t i = 0; i < in.size(); ++i)
    if(const int s = shapes.shape_index(in.item_of(i)); s >= 0)
      places.push_back({in.position(i), s});
  return Places_in_reach(places, reach);
}

// maximum_distance: of points that have no tolerance of their own, or a larger one.
inline Point_to_label point_to_label(const Import& in, std::size_t i, double maximum_distance)
{
  const double own = in.has_tolerances ? in.tolerances[i] : maximum_distance;
  return {in.position(i), in.has_normals ? in.normal(i) : Vector{0, 0, 0}, (std::min)(own, maximum_distance)};
}

inline double largest_coordinate(const Coordinate_box& box)
{
  double largest = 0;
  for(int c = 0; c < 3; ++c)
    largest = (std::max)({largest, std::fabs(box.low[c]), std::fabs(box.high[c])});
  return largest;
}

// The points in the order of their cells.
template <class Backend>
void sort_by_cells(Backend& backend, const Import& in, const Places_in_reach& places,
                   typename Backend::Sort_table& order)
{
  backend.for_each_on_host(
    in.size(), [&](std::size_t i) { order.view().set(i, places.cell_of(in.position(i)), std::uint32_t(i)); },
    few_to_label);
  backend.sort(order);
}

// The labels of all items: by planes without end, or where there are places, by planes that end where no place of their
// shape is within reach. Then points of a cell share what is near it.
template <class Backend>
std::vector<std::int32_t> labels_by_planes(Backend& backend, const Import& in, const std::vector<Coefficients>& planes,
                                           const Parameters& p, const Places_in_reach* places = nullptr)
{
  std::vector<std::int32_t> labels(in.number_of_items, -1);
  const Plane_choice choice(planes, p.maximum_angle, largest_coordinate(in.box));
  typename Backend::Sort_table order(places != nullptr ? in.size() : 0);
  if(places != nullptr)
    sort_by_cells(backend, in, *places, order);
  backend.for_each_piece(in.size(), few_to_label, [&](std::size_t first, std::size_t last) {
    Places_in_reach::Nearby nearby;
    std::uint64_t cell = Places_in_reach::no_cell;
    for(std::size_t at = first; at < last; ++at) {
      const std::size_t i = places != nullptr ? order.view().index(at) : at;
      const Point_to_label point = point_to_label(in, i, p.maximum_distance);
      if(places != nullptr && std::exchange(cell, order.view().key(at)) != order.view().key(at))
        places->collect(cell, nearby);
      labels[in.item_of(i)] = places != nullptr ? choice.nearest(point, *places, nearby) : choice.nearest(point);
    }
  });
  return labels;
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief labels further points by the planes of a result: for example those of the full cloud, if shapes were detected in
a part of its points.

A point gets the shape with the nearest plane among the shapes that can take it. A shape can take a point
- within `maximum_distance` of its plane, and
- with a normal within `maximum_angle` of that of the plane, if there are normals, and
  - if `shape_points` are given, within `reach` of one of the points of the shape. Without them, planes are unbounded:
    all points of the plane of a roof are points of the roof, and coplanar shapes cannot be told from each other.

If several shapes have the nearest plane, the shape with the nearest of `shape_points` gets the point; without
`shape_points` the shape of the lowest index does. Each point is judged by itself. So the labels keep only one promise
of `Planar_shapes_3`: points are within the tolerances, up to rounding. The points of a shape need not be connected, and
may be fewer than `minimum_region_size`. A point that the detection has given to a shape may get another one, whose
plane is nearer.

The result is the same for every order of the points and for every tag and number of threads. Time grows with the number
of points times the number of planes or, with `shape_points`, the number of these within `reach`.

\tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`
\param shapes the result of a detection. Of a result of `Mpi_tag`, `shape_points` has only the points of this process,
so shapes without points here take none.
\param points the points to label
\param np an optional sequence of named parameters, among those listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{point_map, normal_map}
    \cgalParamDescription{as in `detect_planes()`, but normals are not estimated: without them, angles do not count}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance, maximum_angle}
    \cgalParamDescription{the tolerances, in the ranges that `detect_planes()` has}
    \cgalParamDefault{those of `shapes.parameters()`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance_map}
    \cgalParamDescription{as in `detect_planes()`: the tolerance of each point; larger ones, and infinity, count as
    `maximum_distance`}
    \cgalParamDefault{`maximum_distance` for all}
  \cgalParamNEnd
  \cgalParamNBegin{shape_points}
    \cgalParamDescription{the range that the shapes were detected in, or `std::cref()` of it, which is not copied. Its
    points are read through `point_map`, or that of the range.}
    \cgalParamDefault{planes are unbounded}
  \cgalParamNEnd
  \cgalParamNBegin{reach}
    \cgalParamDescription{the largest distance between a point and the nearest one of `shape_points` of its shape, above
    0 and finite}
    \cgalParamDefault{four times the median spacing of `shape_points`: more is needed where their density varies much}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the shape of each point, in the order of the range; -1 for points that no shape takes, and for those that a
detection would ignore: a coordinate or normal is not finite, the normal is null, or the tolerance is not above 0

\throw Parameter_error a parameter is outside of its range
\throw std::invalid_argument the number of `shape_points` is not that of the detection, or one that belongs to a shape
is not finite or farther from its plane than `maximum_distance`; or all are equal, and `reach` is not given
\throw std::length_error more than 2^31 points
\throw std::range_error `reach` is estimated, and the extent of `shape_points` is more than 2^24 times 1e270
*/
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class GeomTraits, class PointRange,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<std::int32_t> label_points(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                       const NamedParameters& np = NamedParameters())
{
  Parameters p = shapes.parameters();
  internal::read_real<internal_np::maximum_distance_t>(np, p.maximum_distance);
  internal::read_real<internal_np::maximum_angle_t>(np, p.maximum_angle);
  check_parameters(p);
  return internal::on_backend<ConcurrencyTag>(points, np, [&](auto& backend, const auto& traits) {
    const internal::Import in = internal::read_range(backend, points, np, traits);
    const std::vector<Coefficients>& planes = shapes.data().coefficients;
    if constexpr(internal::Is_given<internal_np::shape_points_t, NamedParameters>::value) {
      const auto given = internal::parameter<internal_np::shape_points_t>(np, 0);
      const auto places = internal::places_of_shapes(backend, shapes, internal::referred(given), np);
      return internal::labels_by_planes(backend, in, planes, p, &places);
    } else {
      return internal::labels_by_planes(backend, in, planes, p);
    }
  });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_LABEL_POINTS_H
