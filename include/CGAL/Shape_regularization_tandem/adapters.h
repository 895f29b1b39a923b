// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The result in the form that other parts of CGAL take. Included are only the
// property maps; no consumer is.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_ADAPTERS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_ADAPTERS_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>

#include <memory>
#include <string>
#include <tuple>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief a property map from a position in the range to an `int`, -1 for none: what `CGAL::structure_point_set()` and
`regularize_planes()` take as `plane_index_map`.

\cgalModels `ReadablePropertyMap`
*/
class Position_index_map {
public:
  /// a position in the range of the points
  using key_type = std::size_t;
  /// an index of a plane, or -1
  using value_type = int;
  /// \cond SKIP_IN_MANUAL
  using reference = int;
  using category = boost::readable_property_map_tag;
  /// \endcond

  /// the map of these indices, one for each position; copies of the map share them
  explicit Position_index_map(std::vector<int> index = std::vector<int>())
    : index_(std::make_shared<const std::vector<int>>(std::move(index)))
  {}

  /// returns the index of the plane of the point at a position, or -1 if it has none
  friend int get(const Position_index_map& map, std::size_t position) { return (*map.index_)[position]; }

private:
  std::shared_ptr<const std::vector<int>> index_; // property maps are copied
};

/*!
\ingroup PkgShapeRegularizationTandemRef

returns a property map from the position of a point to its shape, which is an index of `shapes.planes()`; -1 for none.
*/
template <class GeomTraits>
Position_index_map shape_index_map(const Planar_shapes_3<GeomTraits>& shapes)
{
  return Position_index_map(std::vector<int>(shapes.shape_indices().begin(), shapes.shape_indices().end()));
}

/*!
\ingroup PkgShapeRegularizationTandemRef

returns a property map from the position of a point to its coplanar group, which is an index of the planes that
`distinct_planes()` returns; -1 for none.
*/
template <class GeomTraits>
Position_index_map plane_index_map(const Planar_shapes_3<GeomTraits>& shapes)
{
  std::vector<int> index(shapes.number_of_points(), -1);
  for(std::size_t i = 0; i < index.size(); ++i)
    if(shapes.shape_index(i) >= 0)
      index[i] = int(shapes.coplanar_group(std::size_t(shapes.shape_index(i))));
  return Position_index_map(std::move(index));
}

/*!
\ingroup PkgShapeRegularizationTandemRef

returns the distinct planes of the shapes, in the order of their coplanar groups.
*/
template <class GeomTraits>
std::vector<typename GeomTraits::Plane_3> distinct_planes(const Planar_shapes_3<GeomTraits>& shapes)
{
  std::vector<typename GeomTraits::Plane_3> planes;
  for(std::size_t s : shapes.distinct_planes())
    planes.push_back(shapes.plane(s));
  return planes;
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief a point, its normal, and the index of its plane: the items that `projected_points()` gives and
`CGAL::Polygonal_surface_reconstruction` takes, with `CGAL::Nth_of_tuple_property_map` of 0, 1 and 2.
*/
template <class GeomTraits>
using Point_with_plane = std::tuple<typename GeomTraits::Point_3, typename GeomTraits::Vector_3, int>;

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief returns the points of the shapes, projected onto their planes, each with the oriented normal of its plane and
with its coplanar group.

`CGAL::Polygonal_surface_reconstruction` fits a plane of its own to each group of points. Given the projected points of
a plane, that fit is the plane.

\param points the range that the shapes were detected in
\param shapes the shapes
\param np an optional sequence of named parameters, of which `point_map` is read

\return an item for each point of a shape, shape after shape
*/
template <class PointRange, class GeomTraits, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::vector<Point_with_plane<GeomTraits>> projected_points(const PointRange& points,
                                                           const Planar_shapes_3<GeomTraits>& shapes,
                                                           const NamedParameters& np = NamedParameters())
{
  using Traits_for = internal::Traits_for<CGAL::Sequential_tag, PointRange, NamedParameters, false>;
  std::vector<Point_with_plane<GeomTraits>> out;
  if constexpr(internal::Range_check<PointRange>::value && Traits_for::Check::value) {
    const auto map = internal::point_map_of<typename Traits_for::type>(points, np);
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
      const typename GeomTraits::Plane_3 plane = shapes.oriented_plane(s);
      const typename GeomTraits::Vector_3 normal = plane.orthogonal_vector();
      for(std::size_t i : shapes.points(s))
        out.emplace_back(plane.projection(get(map, *(points.begin() + std::ptrdiff_t(i)))), normal,
                         int(shapes.coplanar_group(s)));
    }
  }
  return out;
}

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief writes the index of the shape of each point, or -1 if it has none, into the `int` property `name` of the point
set, which is added if it is not there. CGAL writes the property to files and CGAL Lab shows it.

\param points the points that the shapes were detected in
\param shapes the shapes
\param name the name of the property

\return the property map
*/
template <class Point, class Vector, class GeomTraits>
auto add_shape_property(CGAL::Point_set_3<Point, Vector>& points, const Planar_shapes_3<GeomTraits>& shapes,
                        const std::string& name = "shape")
{
  auto map = points.template add_property_map<int>(name, -1).first;
  std::size_t position = 0;
  for(auto item : points)
    map[item] = shapes.shape_index(position++);
  return map;
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_ADAPTERS_H
