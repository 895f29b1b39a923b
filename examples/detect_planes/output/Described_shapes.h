// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What several outputs tell of the shapes: the areas that their points cover, and a table with a row for each.

#ifndef DETECT_PLANES_DESCRIBED_SHAPES_H
#define DETECT_PLANES_DESCRIBED_SHAPES_H

#include "Options.h"
#include "output/report.h"

#include <CGAL/Shape_regularization_tandem/Shape_polygons_3.h>

namespace program {

// --- The areas that the points of the shapes cover, an entry for each shape; and coplanar shapes as one.

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

// Those of the shapes that fit: of the points of this rank and others, the same on all ranks.
Shapes selected_shapes(const Shapes& shapes, const Point_set& points, const Options& o);

// --- A table with a row for each shape: that of --shapes, which the page of --view has, too.

// A list for each column: a number of each shape.
Json shape_table(const Point_set& points, const Shapes& shapes, const Shape_areas& areas);

// As CSV, with a line of names, and the number of the shape in front.
void write_shape_table(std::ostream& out, const Json& table);

// The shapes of a cloud, both of which outlive it, with what several outputs tell of them. Areas and table are made when
// they are asked for first.
class Described_shapes {
public:
  Described_shapes(const Point_set& points, const Shapes& shapes) : points(points), shapes(shapes) {}

  const Shape_areas& areas() const
  {
    if(!areas_)
      areas_ = areas_of_shapes(points, shapes);
    return *areas_;
  }

  const Json& table() const
  {
    if(!table_)
      table_ = shape_table(points, shapes, areas());
    return *table_;
  }

  const Point_set& points;
  const Shapes& shapes;

private:
  mutable std::optional<Shape_areas> areas_;
  mutable std::optional<Json> table_;
};

} // namespace program

#endif // DETECT_PLANES_DESCRIBED_SHAPES_H
