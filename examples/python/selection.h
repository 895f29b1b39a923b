// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the Python module does with shapes that are known: it selects some of them, and labels points by their planes.

#ifndef TANDEM_PYTHON_SELECTION_H
#define TANDEM_PYTHON_SELECTION_H

#include "detection.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace tandem_python {

// Criteria; those that are not given hold for all shapes.
struct Selection {
  std::optional<long long> largest;
  std::optional<double> minimum_area, minimum_extent, near_angle;
  std::optional<std::array<double, 3>> near_direction, orthogonal_direction;
};

// What is not given is that of the shapes.
struct Labeling {
  std::optional<double> maximum_distance, maximum_angle, reach;
  Cloud shape_points; // of the detection; null: planes have no end
};

Shapes select_shapes(const Shapes& shapes, const std::vector<long long>& indices);

// The points are those of the detection, which are read for areas and extents.
Shapes select_shapes(const Shapes& shapes, const Cloud& points, const Selection& selection);

// The normals of the cloud count where there are some.
std::vector<std::int32_t> label_points(const Shapes& shapes, const Cloud& cloud, const Labeling& labeling);

} // namespace tandem_python

#endif // TANDEM_PYTHON_SELECTION_H
