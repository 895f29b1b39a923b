// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_DESCRIBED_SHAPES_H
#define DETECT_PLANES_DESCRIBED_SHAPES_H

#include "output/shape_areas.h"
#include "output/shape_table.h"

#include <optional>

namespace program {

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
