// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesh/mesh_methods.h"

#include <CGAL/Shape_regularization_tandem/Kinetic_partition.h>
#include <CGAL/Shape_regularization_tandem/closed_surface.h>

namespace program {

Surface kinetic_mesh(const Point_set& points, const Shapes& shapes, std::size_t number_of_planes,
                     const Kernel::Vector_3& up)
try {
  auto made = CGAL::Tandem::closed_surface(shapes, points,
                                           CGAL::Tandem::parameters::maximum_number_of_planes(int(number_of_planes))
                                             .symmetry_direction(up)
                                             .partition(CGAL::Tandem::Kinetic_partition()));
  return {std::move(made.points), std::move(made.faces), made.number_of_planes, made.number_of_points};
} catch(const std::runtime_error&) {
  throw std::runtime_error("--mesh: the kinetic space partition of CGAL fails at these planes: take fewer by "
                           "--mesh-planes, or the method cells");
}

} // namespace program
