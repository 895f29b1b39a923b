// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The result of a detection as the caller gets it: by items of the range, with groups of shapes and statistics.

#ifndef CGAL_TANDEM_INTERNAL_RESULT_SHAPES_DATA_H
#define CGAL_TANDEM_INTERNAL_RESULT_SHAPES_DATA_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/Statistics.h>
#include <CGAL/Tandem/internal/result/Shared_table.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

using Position = std::array<double, 3>; // the coordinates of a point

// The points of each shape, ascending: those of shape s are position[first[s]] ... position[first[s + 1] - 1]. So
// `first` has one entry more than there are shapes.
struct Point_groups {
  std::vector<std::size_t> first;
  Shared_table<std::uint32_t> position;
};

// What Planar_shapes_3 is made of. Tests corrupt it to see whether Result_checker finds each violation.
struct Shapes_data {
  std::vector<Coefficients> coefficients;             // of each shape
  std::vector<std::size_t> size;                      // points of each shape, of all ranks
  std::vector<int> parallel_group;                    // of each shape
  std::vector<int> coplanar_group;                    // of each shape
  std::vector<std::pair<int, int>> orthogonal_groups; // pairs of parallel groups, first < second, sorted
  std::vector<int> fixed_direction;           // of each parallel group: which of the fixed directions it has, or -1
  std::vector<int> symmetry_group;            // of each parallel group, -1 without an axis
  std::vector<char> is_flipped;               // of each shape: the majority of the normals is opposite to its plane
  std::vector<Plane_uncertainty> uncertainty; // of each shape
  Shared_table<std::int32_t> shape_of;        // of each item of the range, -1 = none
  Shared_table<std::uint32_t> normal;         // of each item, packed; empty if normals were given
  Parameters parameters;
  Statistics statistics;
  Point_groups points; // of the shapes, until Planar_shapes_3 takes them
};

// The first shape of each group, by group. -1 stands for a number that no shape has: only corrupted data have such
// groups.
inline std::vector<int> representatives(const std::vector<int>& group)
{
  std::vector<int> first;
  for(std::size_t s = 0; s < group.size(); ++s) {
    if(std::size_t(group[s]) >= first.size())
      first.resize(std::size_t(group[s]) + 1, -1);
    if(first[group[s]] < 0)
      first[group[s]] = int(s);
  }
  return first;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_SHAPES_DATA_H
