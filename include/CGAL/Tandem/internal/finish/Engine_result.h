// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the engine hands over. Plain data: all back ends see it.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_ENGINE_RESULT_H
#define CGAL_TANDEM_INTERNAL_FINISH_ENGINE_RESULT_H

#include <CGAL/Shape_regularization_tandem/Statistics.h>
#include <CGAL/Tandem/internal/base/planes.h>
#include <CGAL/Tandem/internal/memory/Host_buffer.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

struct Engine_shape {
  Coefficients plane; // common to the shapes of a plane group; its normal to those of a direction
  int direction;      // parallel group
  int plane_group;    // coplanar group
  std::size_t size;   // points
  bool is_flipped;    // most of the given normals of its points are opposite to the plane
};

// The points of each shape, ascending: those of shape s are position[first[s]] ... position[first[s + 1] - 1].
struct Point_groups {
  std::vector<std::size_t> first;
  Shared_table<std::uint32_t> position;
};

struct Engine_result {
  std::vector<Engine_shape> shapes;    // by falling number of points
  Shared_table<std::int32_t> shape_of; // per imported point, -1 = none
  Point_groups points;                 // imported points of each shape
  Shared_table<std::uint32_t> normal;  // per imported point, the packed normal, if normals were estimated
  double mean_distance = 0;            // of the points to their planes, in epsilons
  std::size_t rounds = 0;
  bool is_cancelled = false;
  bool is_coarse = false;
  Stage_times times;
  std::size_t peak_bytes = 0;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_ENGINE_RESULT_H
