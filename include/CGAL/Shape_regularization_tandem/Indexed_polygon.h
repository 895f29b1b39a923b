// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INDEXED_POLYGON_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INDEXED_POLYGON_H

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief A polygon with holes in a plane, whose corners are positions in a table of points. The order of corners is
that seen from the side to which the normal of `Planar_shapes_3::plane()` points, whatever the normals of the points are.
*/
struct Indexed_polygon {
  /// the corners of a closed line, the first one once
  using Loop = std::vector<std::uint32_t>;

  /// counterclockwise
  Loop outer;
  /// clockwise
  std::vector<Loop> holes;
  /// a constrained Delaunay triangulation, without further vertices: counterclockwise
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INDEXED_POLYGON_H
