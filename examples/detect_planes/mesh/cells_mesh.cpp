// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/mesh_methods.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>

namespace program {

Surface cells_mesh(const Point_set& points, const Shapes& shapes, std::size_t number_of_planes,
                   const Kernel::Vector_3& up)
{
  auto made = CGAL::Tandem::closed_surface(
    shapes, points, CGAL::Tandem::parameters::maximum_number_of_planes(int(number_of_planes)).symmetry_direction(up));
  return {std::move(made.points), std::move(made.faces), made.number_of_planes, made.number_of_points};
}

} // namespace program
