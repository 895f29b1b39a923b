// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SHAPE_FACTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SHAPE_FACTS_H

#include <array>
#include <cstddef>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief What a shape is in a building or a landscape. \ref Tandem_models_classes has the definitions.
*/
enum class Shape_class {
  none,    ///< a shape without points
  floor,   ///< level, under something
  ceiling, ///< level, above something, and under nothing closer than that
  wall,    ///< upright
  roof,    ///< under nothing, and higher than what is around it
  ground,  ///< level or sloping, neither above nor under something, nor higher than what is around it
  slanted  ///< neither level nor upright, and none of these
};

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns the word for a class, as in `floor`; an empty one for `Shape_class::none`.
*/
inline const char* shape_class_name(Shape_class c)
{
  constexpr std::array<const char*, 7> names = {"", "floor", "ceiling", "wall", "roof", "ground", "slanted"};
  return names[std::size_t(c)];
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief What is known of a shape beside its plane, as a row of a table. `shape_facts()` makes it.

Lengths are in the units of the points, areas in their squares, angles in degrees. Of a shape without points, all but
the angles of its plane is 0.
*/
struct Shape_facts {
  /// the number of points
  std::size_t number_of_points = 0;
  /// the mean of the points
  std::array<double, 3> centroid = {0, 0, 0};
  /// what the points cover: the area of the outline that `polygons()` finds for the shape. It is 0 for a shape of so
  /// few points that it has none.
  double area = 0;
  /// the longer side of the smallest rectangle in the plane that holds all points and the outline: that of smallest area
  double length = 0;
  /// the shorter side of that rectangle
  double width = 0;
  /// the height of the lowest point above the level through the origin, along the upward direction
  double lowest = 0;
  /// the height of the highest point
  double highest = 0;
  /// the angle between the upward direction and the normal of `Planar_shapes_3::oriented_plane()`, from 0 to 180: 0 for
  /// a floor, 90 for a wall, 180 for a ceiling, where normals point to the outward side. Where they are estimated,
  /// planes have no such side, and `tilt_deg` may as well be 180 minus that.
  double tilt_deg = 0;
  /// the angle between the plane and the level, from 0 to 90, whatever its side
  double dip_deg = 0;
  /// the direction in which the plane falls most steeply: clockwise from north, as seen from above, from 0 to below
  /// 360. North is the axis y, and east the axis x, where z is upward. It is 0 for a level plane. A vertical one has
  /// the direction to which the normal of `Planar_shapes_3::oriented_plane()` points; so has any plane whose `tilt_deg`
  /// is at most 90, and the others have the opposite one.
  double azimuth_deg = 0;
  /// the root mean square of the distances of the points to the plane
  double rms_distance = 0;
  /// the mean of these distances
  double mean_distance = 0;
  /// the angle by which regularization has turned the plane: that with the least-squares plane of the points
  double turned_deg = 0;
  /// how far it has shifted the plane: the distance of the centroid, through which the least-squares plane passes
  double shifted = 0;
  /// how much of the scatter of the points about a plane a curved surface explains, from 0 to 1: above 1/2, the shape is a
  /// facet of such a surface, otherwise a face. \ref Tandem_models_facets has the definition.
  double curved = 0;
  /// what the shape is, by its angle to the level and by the shapes above, below and around it
  Shape_class shape_class = Shape_class::none;
  /// whether the shape is a veil: no surface, but points that a sensor puts between a near and a far surface. False
  /// without `viewpoint_map`. \ref Tandem_models_sight has the definition.
  bool is_veil = false;
  /// the shape through which the sensor saw this one, as a mirrored room behind a window; -1 if there is none, or
  /// without `viewpoint_map`
  int behind = -1;
};

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SHAPE_FACTS_H
