// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_POLYGONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_POLYGONS_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/checked_coordinates.h>
#include <CGAL/Shape_regularization_tandem/internal/relabel_shapes.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/named_parameters.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief The areas that the points of planar shapes cover: for each shape, or each distinct plane, polygons with holes.
`polygons()` makes it.

An *entry* is what one shape or one plane has: any number of polygons. An entry whose points cover less than 20 squares
of their spacing has none: `number_of_empty_entries()` counts these. The corners of all polygons are in one table of
points. Each corner is on its plane, as closely as doubles allow, and where two shapes meet, corners on the line of
their planes are on both; a point that several polygons have is in the table once. Where a common corner would make an
outline cross itself, it is left out of that one. Polygons of one entry are simple and have no common points, holes
included: this holds exactly in the frame of the entry. Polygons of two entries may overlap, also where both are in one
plane: `one_for_each_plane` makes one entry of these.

\tparam GeomTraits a model of `Kernel`
*/
template <class GeomTraits>
class Shape_polygons_3 {
public:
  /// \name Types
  /// @{

  /// a point of the kernel
  using Point_3 = typename GeomTraits::Point_3;
  /// the kernel of the polygons in two dimensions
  using Kernel_2 = CGAL::Exact_predicates_inexact_constructions_kernel;
  /// a point in the frame of an entry
  using Point_2 = typename Kernel_2::Point_2;
  /// a polygon in the frame of an entry
  using Polygon_2 = CGAL::Polygon_2<Kernel_2>;
  /// a polygon with holes in the frame of an entry
  using Polygon_with_holes_2 = CGAL::Polygon_with_holes_2<Kernel_2>;
  /// \cond SKIP_IN_MANUAL
  using Table = internal::outlines::Polygon_table;
  /// \endcond

  /// @}

  /*!
  The frame of an entry: the coordinates of its plane without the one along which the plane is steepest, that is, of the
  largest number in its normal, such that the normal of `Planar_shapes_3::plane()` points to the viewer. Coordinates are
  not computed, so that what is simple here is simple in space. Lengths, angles and areas are not those in space:
  `Shape_polygons_3::area()` is.
  */
  class Frame {
  public:
    /// returns two of the three coordinates of point `p`, without the one that the frame leaves out
    Point_2 to_2d(const Point_3& p) const
    {
      const std::array<double, 3> position = {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
      return frame_.projected(position);
    }

    /// returns the point of the plane whose two coordinates in the frame are those of `p`. The third one is computed
    /// from the plane. For a corner of a polygon it may differ by rounding from that in `points()`.
    Point_3 to_3d(const Point_2& p) const
    {
      using FT = typename GeomTraits::FT;
      const std::array<double, 3> q = frame_.on_plane(p);
      return Point_3(FT(q[0]), FT(q[1]), FT(q[2]));
    }

    /// \cond SKIP_IN_MANUAL
    explicit Frame(const internal::outlines::Projection& frame) : frame_(frame) {}
    /// \endcond

  private:
    internal::outlines::Projection frame_;
  };

  /// \cond SKIP_IN_MANUAL
  const Table& table() const { return table_; }

  explicit Shape_polygons_3(Table table = Table()) : table_(std::move(table))
  {
    using FT = typename GeomTraits::FT;
    for(const auto& p : table_.points)
      points_.emplace_back(FT(p[0]), FT(p[1]), FT(p[2]));
  }
  /// \endcond

  /// \name Entries
  /// @{

  /// returns the number of entries, which is that of shapes, or of distinct planes with `one_for_each_plane`
  std::size_t number_of_entries() const { return table_.polygons.size(); }

  /// returns whether shape `i`, or distinct plane `i` with `one_for_each_plane`, has no polygon: it has too few points
  bool is_empty(std::size_t i) const { return table_.polygons[i].empty(); }

  /// returns the number of shapes, or of distinct planes with `one_for_each_plane`, that have no polygon
  std::size_t number_of_empty_entries() const
  {
    return std::size_t(std::count_if(table_.polygons.begin(), table_.polygons.end(),
                                     [](const std::vector<Indexed_polygon>& polygons) { return polygons.empty(); }));
  }

  /// returns the corners of all polygons: the table of which `Indexed_polygon` has positions. No corner is in it twice.
  const std::vector<Point_3>& points() const { return points_; }

  /// returns the polygons of entry `i`, with positions of their corners in `points()`
  const std::vector<Indexed_polygon>& polygons(std::size_t i) const { return table_.polygons[i]; }

  /// returns the triangles of all polygons of entry `i`, with positions of their corners in `points()`: for each
  /// polygon a constrained Delaunay triangulation in the frame, without further vertices. They are counterclockwise as
  /// seen from the side to which the normal of the plane points. If `Planar_shapes_3::is_flipped()`, the points were
  /// seen from the other side.
  std::vector<std::array<std::uint32_t, 3>> triangles(std::size_t i) const
  {
    std::vector<std::array<std::uint32_t, 3>> result;
    for(const Indexed_polygon& polygon : polygons(i))
      result.insert(result.end(), polygon.triangles.begin(), polygon.triangles.end());
    return result;
  }

  /// returns the area of the polygons of entry `i`, in squared units of the points
  double area(std::size_t i) const { return table_.areas[i]; }
  /// @}

  /// \name In Two Dimensions
  /// @{

  /// returns the frame of entry `i`, in which `polygons_2()` has its polygons
  Frame frame(std::size_t i) const { return Frame(table_.frames[i]); }

  /// returns the polygons of entry `i` with two-dimensional coordinates, those of `frame(i)`, in the order of
  /// `polygons(i)`: outer boundaries are counterclockwise, the holes of each are clockwise
  std::vector<Polygon_with_holes_2> polygons_2(std::size_t i) const
  {
    std::vector<Polygon_with_holes_2> result;
    for(const Indexed_polygon& polygon : polygons(i)) {
      std::vector<Polygon_2> holes;
      for(const Indexed_polygon::Loop& hole : polygon.holes)
        holes.push_back(polygon_2(i, hole));
      result.emplace_back(polygon_2(i, polygon.outer), holes.begin(), holes.end());
    }
    return result;
  }
  /// @}

private:
  Polygon_2 polygon_2(std::size_t i, const Indexed_polygon::Loop& loop) const
  {
    Polygon_2 result;
    for(std::uint32_t corner : loop)
      result.push_back(table_.frames[i].projected(table_.points[corner]));
    return result;
  }

  Table table_;
  std::vector<Point_3> points_;
};

namespace internal {

template <class GeomTraits>
void check_entries(const Planar_shapes_3<GeomTraits>& shapes, const Shape_polygons_3<GeomTraits>& areas)
{
  if(areas.number_of_entries() != shapes.number_of_shapes())
    throw std::invalid_argument("There are " + std::to_string(areas.number_of_entries()) + " entries of polygons for " +
                                std::to_string(shapes.number_of_shapes()) +
                                " shapes: pass the polygons of the shapes.");
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief finds the areas that the points of shapes cover, as polygons with holes in the planes of the shapes.

Where a shape ends at the plane of another one, the boundary is straight, and its corners are on both planes; three
planes meet in one corner. The rest of a boundary follows the points at their spacing. \ref Tandem_models_polygons
describes the result.

Include `CGAL/Shape_regularization_tandem_models.h`.

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
\throw std::logic_error the points are distributed over several processes (`Mpi_tag`)
*/
template <class GeomTraits, class PointRange, class NamedParameters = CGAL::parameters::Default_named_parameters>
Shape_polygons_3<GeomTraits> polygons(const Planar_shapes_3<GeomTraits>& shapes, const PointRange& points,
                                      const NamedParameters& np = NamedParameters())
{
  const std::vector<internal::Position> coordinates = internal::checked_coordinates(shapes, points, np);
  const bool is_by_plane = internal::parameter<internal_np::one_for_each_plane_t>(np, false);
  const internal::Shapes_data data =
    is_by_plane ? internal::relabel_shapes(shapes.data(), shapes.distinct_planes(), shapes.data().coplanar_group)
                : shapes.data();
  return Shape_polygons_3<GeomTraits>(internal::outlines::outline_table(coordinates, data));
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_POLYGONS_H
