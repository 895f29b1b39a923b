// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "selection.h"

#include <CGAL/Shape_regularization_tandem/select_shapes.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace program {

Shapes selected_shapes(const Shapes& shapes, const Point_set& points, const Options& o)
{
  namespace np = CGAL::Tandem::parameters;
  const std::size_t all = (std::max)(shapes.number_of_shapes(), std::size_t(1));
  const std::size_t number = o.largest ? std::size_t(*o.largest) : all;
  const auto list =
    np::largest(number).minimum_area(o.minimum_area.value_or(0)).minimum_extent(o.minimum_extent.value_or(0));
  if(!o.near_direction)
    return CGAL::Tandem::select_shapes(shapes, points, list);
  const Direction_choice& choice = *o.near_direction;
  const std::array<double, 3>& upward = shapes.parameters().symmetry_direction;
  const std::array<double, 3>& d = choice.of == Direction_choice::direction ? choice.normal : upward;
  const Kernel::Vector_3 direction(d[0], d[1], d[2]);
  const auto near = list.near_angle(choice.degrees.value_or(CGAL::Tandem::internal::default_near_angle));
  return choice.of == Direction_choice::vertical
           ? CGAL::Tandem::select_shapes(shapes, points, near.orthogonal_direction(direction))
           : CGAL::Tandem::select_shapes(shapes, points, near.near_direction(direction));
}

} // namespace program
