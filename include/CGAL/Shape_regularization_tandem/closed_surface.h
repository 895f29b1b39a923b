// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_CLOSED_SURFACE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_CLOSED_SURFACE_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

namespace internal {

inline double finite(const char* name, double number)
{
  if(!std::isfinite(number))
    throw_out_of_range(name, number, "finite");
  return number;
}

// The outer boundary of a polygon with holes, and the holes. The coordinates are x and y of points. As in files, the last
// corner of a boundary may be the first one again.
template <class Polygon>
std::vector<surface::Flat_polygon> rings_of(const Polygon& polygon, const Vector& up)
{
  if(up.x != 0 || up.y != 0 || !(up.z > 0))
    throw Parameter_error("symmetry_direction", to_text(up.x) + ", " + to_text(up.y) + ", " + to_text(up.z),
                          "(0, 0, 1) with footprints, which are seen along z");
  std::vector<surface::Flat_polygon> result;
  const auto add = [&result](const auto& ring) {
    surface::Flat_polygon corners;
    for(const auto& p : ring)
      corners.emplace_back(finite("footprints", CGAL::to_double(p.x())), finite("footprints", CGAL::to_double(p.y())));
    if(corners.size() > 1 && corners.front() == corners.back())
      corners.pop_back();
    if(corners.size() < 3 || !CGAL::is_simple_2(corners.begin(), corners.end()))
      throw Parameter_error("footprints", "a boundary of " + std::to_string(corners.size()) + " corners",
                            "boundaries of three corners or more that do not touch themselves");
    result.push_back(std::move(corners));
  };
  add(polygon.outer_boundary());
  for(const auto& hole : polygon.holes())
    add(hole);
  return result;
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief A closed surface of the planes of shapes, as points and faces. `closed_surface()` makes it.

Each edge has two faces, which are oriented alike, and the faces at a point are one fan: `points` and `faces` are a
polygon soup that `CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh()` takes as it is.

\tparam GeomTraits a model of `Kernel`
*/
template <class GeomTraits>
struct Closed_surface_3 {
  /// the corners
  std::vector<typename GeomTraits::Point_3> points;
  /// positions of the corners of each face in `points`, counterclockwise as seen from outside. Faces need not be
  /// convex; a part of a plane with holes is several faces.
  std::vector<std::vector<std::size_t>> faces;
  /// the coplanar group of the plane of each face; -1 for a wall that was added, the base, and a face of the box of
  /// the points
  std::vector<int> plane_of_face;
  /// the share of the area of each face that the outlines of shapes cover, from 0 to 1. The rest is assumed.
  std::vector<double> supported_of_face;
  /// the same share of the area of all faces; 0 if there is none
  double supported = 0;
  /// the triangles of all faces, in the order of the faces and without further corners: positions of their corners in
  /// `points`, counterclockwise as seen from outside
  std::vector<std::array<std::size_t, 3>> triangles;
  /// the face of each triangle
  std::vector<std::size_t> face_of_triangle;
  /// the number of distinct planes that were considered
  std::size_t number_of_planes = 0;
  /// the number of those that were not, which have fewer points
  std::size_t number_of_omitted_planes = 0;
  /// the number of points of shapes whose plane is the surface where they are. What is far below the number of all
  /// points of shapes says that much of the scan is no part of a volume.
  std::size_t number_of_points = 0;

  /// returns whether nothing is enclosed
  bool is_empty() const { return faces.empty(); }
};

namespace internal {

// Of these outlines of the shapes, or of those that it finds.
template <class GeomTraits, class PointRange, class NamedParameters>
Closed_surface_3<GeomTraits> closed_surface(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                            const outlines::Polygon_table* outlines, const NamedParameters& np)
{
  using FT = typename GeomTraits::FT;
  const auto coordinates = checked_coordinates(shapes, points, np);
  const int most = parameter<internal_np::maximum_number_of_planes_t>(np, (std::numeric_limits<int>::max)());
  if(most < 4)
    throw_out_of_range("maximum_number_of_planes", most, "at least 4");
  const int components = parameter<internal_np::maximum_number_of_components_t>(np, 0);
  if(components < 0)
    throw_out_of_range("maximum_number_of_components", components, "at least 0");
  const Vector up =
    upward(parameter<internal_np::symmetry_direction_t>(np, typename GeomTraits::Vector_3(FT(0), FT(0), FT(1))));
  surface::Surface_request request = {std::size_t(most), std::size_t(components), up, {}, {}};
  if constexpr(Is_given<internal_np::base_height_t, NamedParameters>::value)
    request.base_height = finite("base_height", CGAL::to_double(parameter<internal_np::base_height_t>(np, 0)));
  if constexpr(Is_given<internal_np::footprints_t, NamedParameters>::value)
    for(const auto& footprint : parameter<internal_np::footprints_t>(np, 0))
      request.footprints.push_back(rings_of(footprint, up));
  request.callback = parameter<internal_np::callback_t>(np, Callback());
  request.outlines = outlines;
  auto table = surface::surface_table(coordinates, shapes.data(), request);
  Closed_surface_3<GeomTraits> result;
  for(const Position& p : table.points)
    result.points.emplace_back(FT(p[0]), FT(p[1]), FT(p[2]));
  result.faces = std::move(table.faces);
  result.plane_of_face = std::move(table.plane_of_face);
  result.supported_of_face = std::move(table.supported_of_face);
  result.supported = table.area > 0 ? table.supported_area / table.area : 0;
  result.triangles = std::move(table.triangles);
  result.face_of_triangle = std::move(table.face_of_triangle);
  result.number_of_planes = table.groups.size();
  result.number_of_omitted_planes = table.omitted_groups.size();
  result.number_of_points = table.number_of_points;
  return result;
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns a closed surface whose faces are in the planes of shapes.

The planes cut the box of the points into cells, and a minimum cut chooses those that are inside. Walls that have no
points, as in airborne scans, are added below the borders of shapes. \ref Tandem_models_surface describes the method.

The surface is closed, oriented outward and a two-manifold, and does not cross itself: exact predicates have checked its
triangles. It has several components where there are several buildings. It is empty if the planes
enclose nothing, or if fewer than four planes, walls included, have an area. A corner within 10<sup>-7</sup> of the extent
of the points from a plane is in that plane: so no edge is shorter, and faces are in their planes up to that. Corners are
rounded to `FT` last: of a `Kernel` of `float` far from the origin, faces may touch or cross.

Include `CGAL/Shape_regularization_tandem_models.h`.

Time grows with the number of cells, which is O(n) for n planes that meet only their neighbors, and O(n<sup>3</sup>) for
planes that all cross each other; 64 rays leave each facet that has points or a wall. The function also finds the
outlines of `polygons()`. With `CGAL_LINKED_WITH_TBB` it runs in parallel. The result is the same for every number of
threads and every order of the points.

\param shapes the result of a detection
\param points the range of points that it is of
\param np an optional sequence of named parameters, among those listed below

\cgalNamedParamsBegin
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map from the values of the range to points}
    \cgalParamDefault{that of the range: the identity, or the point map of a `CGAL::Point_set_3`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_number_of_planes}
    \cgalParamDescription{how many distinct planes may bound the surface, those with most points; walls without points
    are not counted}
    \cgalParamType{`int`, at least 4}
    \cgalParamDefault{all; of so many that they cut the box into more than 400,000 cells, half of them, or a quarter,
    and so on}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_number_of_components}
    \cgalParamDescription{how many components the surface may have, those with the largest areas; 0: all that have at
    least a hundredth of the area of the largest}
    \cgalParamType{`int`, at least 0}
    \cgalParamDefault{0}
  \cgalParamNEnd
  \cgalParamNBegin{symmetry_direction}
    \cgalParamDescription{the direction upward: the rays that tell inside from outside go upward, and walls without points
    go down from the borders of shapes}
    \cgalParamType{`GeomTraits::Vector_3`}
    \cgalParamDefault{(0, 0, 1)}
  \cgalParamNEnd
  \cgalParamNBegin{base_height}
    \cgalParamDescription{the height of the ground in the direction upward, in units of the points: nothing below it is
    inside, and walls without points go down to it. So roofs alone enclose volumes}
    \cgalParamType{`GeomTraits::FT`, finite}
    \cgalParamDefault{not known: walls without points end at the lowest shape below; below a footprint, the lowest point of
    a shape that is not farther from it than half of its extent}
  \cgalParamNEnd
  \cgalParamNBegin{footprints}
    \cgalParamDescription{polygons with holes, whose coordinates are x and y of points. Each has a surface of its own, of
    the points in it: nothing else is inside, and the edges of the polygon are walls. Numbers of planes and of components
    are those of one footprint}
    \cgalParamType{a range of `CGAL::Polygon_with_holes_2` of any kernel, with simple boundaries. The direction upward must
    be z}
    \cgalParamDefault{none: one surface of all points}
  \cgalParamNEnd
  \cgalParamNBegin{callback}
    \cgalParamDescription{a `std::function<bool(double)>` that gets the progress, in [0, 1], on the calling thread. By
    returning `false` it cancels the work, and the surface is empty. What it throws reaches the caller.}
    \cgalParamDefault{none}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the surface, empty if there is none

\throw Parameter_error fewer than four planes or fewer than no components are asked for, the base is not finite, or the
direction is null or not finite
\throw std::runtime_error the surface would cross itself as its corners are rounded; `what()` tells of which planes
\throw std::invalid_argument the number of points is not that of the detection, or a point of a shape is not finite or
farther from its plane than `maximum_distance`; or a footprint has a boundary that crosses itself, or a direction upward
other than z
\throw std::logic_error the points are distributed over several processes (`Mpi_tag`)
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
Closed_surface_3<GeomTraits> closed_surface(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                            const NamedParameters& np = NamedParameters())
{
  return internal::closed_surface(shapes, points, nullptr, np);
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns a closed surface whose faces are in the planes of shapes, as the function above, of polygons that the caller
has already.

\param shapes, points, np as above
\param areas the result of `polygons()` for these shapes, with an entry for each shape

\throw std::invalid_argument `areas` does not have one entry for each shape; and what the function above throws
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
Closed_surface_3<GeomTraits> closed_surface(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                            const Shape_polygons_3<GeomTraits>& areas,
                                            const NamedParameters& np = NamedParameters())
{
  internal::check_entries(shapes, areas);
  return internal::closed_surface(shapes, points, &areas.table(), np);
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_CLOSED_SURFACE_H
