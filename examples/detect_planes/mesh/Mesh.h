// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_MESH_H
#define DETECT_PLANES_MESH_H

#include "input/point_set.h"

#include <CGAL/Shape_regularization_tandem/closed_surface.h>

#include <optional>
#include <vector>

namespace program {

struct Mesh {
  CGAL::Tandem::Closed_surface_3<Kernel> surface;
  std::vector<int> shape_of_face; // the first one in its plane; -1 if there is none
  std::optional<double> base;     // the height of the ground
};

} // namespace program

#endif // DETECT_PLANES_MESH_H
