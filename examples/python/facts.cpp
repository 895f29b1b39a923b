// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Planar_shapes.h"

#include <CGAL/Shape_regularization_tandem/shape_facts.h>

namespace tandem_python {

std::vector<CGAL::Tandem::Shape_facts> shape_facts(const Cloud& cloud, const Shapes& shapes)
{
  return CGAL::Tandem::shape_facts(shapes.data().shapes, rows_of(cloud), np::point_map(Point_map{cloud.points}));
}

} // namespace tandem_python
