// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The areas that the points of the shapes cover, an entry for each shape; and coplanar shapes as one.

#ifndef DETECT_PLANES_SHAPE_AREAS_H
#define DETECT_PLANES_SHAPE_AREAS_H

#include "output/write_results.h"
#include "sentence.h"

#include <CGAL/Shape_regularization_tandem/Shape_polygons_3.h>

#include <string>

namespace program {

using Shape_areas = CGAL::Tandem::Shape_polygons_3<Kernel>;

Shape_areas areas_of_shapes(const Point_set& points, const Shapes& shapes);

// One shape for each plane.
Shapes joined_shapes(const Point_set& points, const Shapes& shapes);

// Of the entries without polygons: a sentence.
inline std::string why_empty(const Shape_areas& areas)
{
  return sentence(areas.number_of_empty_entries(), " of ", areas.number_of_entries(),
                  " shapes cover too few points for an outline: --polygons has no polygon of them");
}

} // namespace program

#endif // DETECT_PLANES_SHAPE_AREAS_H
