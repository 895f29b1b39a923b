// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/shape_areas.h"

#include <CGAL/Shape_regularization_tandem/join_coplanar_shapes.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

namespace program {

Shape_areas areas_of_shapes(const Point_set& points, const Shapes& shapes)
{
  return CGAL::Tandem::polygons(shapes, points);
}

Shapes joined_shapes(const Point_set& points, const Shapes& shapes)
{
  return CGAL::Tandem::join_coplanar_shapes(shapes, points);
}

} // namespace program
