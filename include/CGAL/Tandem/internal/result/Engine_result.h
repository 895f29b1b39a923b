// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an engine returns: shapes, labels of the points, points of the shapes, and times. Plain data without a type of a
// back end, so that both compilers accept it. Nothing is computed here.

#ifndef CGAL_TANDEM_INTERNAL_RESULT_ENGINE_RESULT_H
#define CGAL_TANDEM_INTERNAL_RESULT_ENGINE_RESULT_H

#include <CGAL/Tandem/internal/result/Shapes_data.h>
#include <CGAL/Tandem/internal/score/Score.h>

#include <cstdint>
#include <vector>

namespace CGAL::Tandem::internal {

// A connected component of the points of one plane. Directions and planes are numbered from 0, in the order in which
// shapes have them first. The shapes of a plane group have the same four coefficients, bit for bit.
struct Engine_shape {
  Coefficients plane; // in the caller's units; its normal is that of all shapes of the direction
  int direction;      // parallel group
  int plane_group;    // coplanar group
  std::size_t size;   // points
  bool is_flipped;    // most of the given normals of its points are opposite to the plane
  Plane_uncertainty uncertainty = {};
};

// Tables of points are indexed by imported points: the valid items of the caller's range, in its order. Shapes and
// tables are the same for every back end and number of threads.
struct Engine_result {
  std::vector<Engine_shape> shapes;    // by falling number of points
  Shared_table<std::int32_t> shape_of; // per imported point, -1 = none
  Point_groups points;                 // imported points of each shape
  Shared_table<std::uint32_t> normal;  // per imported point, the packed normal, if normals were estimated
  double mean_distance = 0;            // of the points to their planes, in epsilons
  Score_counts counts;
  Free_points free_points; // of all ranks
  std::size_t rounds = 0;
  bool is_cancelled = false;
  bool is_coarse = false;
  Stage_times times;
  std::size_t peak_bytes = 0;
  double line_spacing_steps = 0; // 0 without scan lines
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_ENGINE_RESULT_H
