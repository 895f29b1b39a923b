// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The areas that the points of the shapes cover, an entry for each shape.

#ifndef DETECT_PLANES_SHAPE_AREAS_H
#define DETECT_PLANES_SHAPE_AREAS_H

#include "output/write_results.h"

#include <CGAL/Shape_regularization_tandem/Shape_polygons_3.h>

namespace program {

using Shape_areas = CGAL::Tandem::Shape_polygons_3<Kernel>;

Shape_areas areas_of_shapes(const Point_set& points, const Shapes& shapes);

} // namespace program

#endif // DETECT_PLANES_SHAPE_AREAS_H
