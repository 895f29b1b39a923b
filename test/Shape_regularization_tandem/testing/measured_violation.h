// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is wrong with a result.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEASURED_VIOLATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEASURED_VIOLATION_H

#include <CGAL/Shape_regularization_tandem/is_valid_result.h>

#include <string>

// Or nothing.
template <class PointRange, class GeomTraits, class NP>
std::string violation_of(const PointRange& points, const CGAL::Tandem::Planar_shapes_3<GeomTraits>& shapes,
                         const NP& np)
{
  std::string why;
  CGAL::Tandem::is_valid_result(points, shapes, np, &why);
  return why;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEASURED_VIOLATION_H
