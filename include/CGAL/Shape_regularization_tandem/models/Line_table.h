// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines at which shapes meet, before they are points of the caller's kernel.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_LINE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_LINE_TABLE_H

#include <CGAL/Tandem/internal/result/Shapes_data.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief A part of the line of two planes, which the outlines of two shapes of these planes have in common.
*/
struct Indexed_segment {
  /// positions of its two ends in a table of points
  std::array<std::uint32_t, 2> ends;
  /// the two shapes, ascending
  std::array<std::uint32_t, 2> shapes;
  /// where each of the two shapes is, beside the plane of the other one: 1 on the side to which the normal of
  /// `Planar_shapes_3::plane()` points, -1 on the other side, 0 on both sides. So {0, 0} are shapes that cross, one 0 is
  /// a shape at which the other one ends, and there is none at an edge.
  std::array<int, 2> sides;
};

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief A point at which segments of three planes or more meet.
*/
struct Indexed_corner {
  /// its position in a table of points
  std::uint32_t point;
  /// the shapes that meet there, ascending
  std::vector<std::uint32_t> shapes;
};

} // namespace CGAL::Tandem

namespace CGAL::Tandem::internal::outlines {

// See Shape_lines_3.
struct Line_table {
  std::vector<Position> points;
  std::vector<Indexed_segment> segments;
  std::vector<Indexed_corner> corners;
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_LINE_TABLE_H
