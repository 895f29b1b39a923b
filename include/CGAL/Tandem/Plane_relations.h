// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_PLANE_RELATIONS_H
#define CGAL_TANDEM_PLANE_RELATIONS_H

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

How planes are related after `regularize_planes()`. Planes are numbered as in the caller's range, groups from 0.
*/
struct Plane_relations {
  std::vector<int> parallel_group; ///< of each plane: those of a group have the same unit normal, up to its sign
  std::vector<int> coplanar_group; ///< of each plane: those of a group are the same plane
  /// pairs of parallel groups that are orthogonal, each with the smaller index first, sorted
  std::vector<std::pair<int, int>> orthogonal_groups;
  /// of each parallel group: which of `fixed_directions` it has, the first of those that are one; -1 if none
  std::vector<int> fixed_direction;
  /// of each parallel group: those of a symmetry group make the same angle with `symmetry_direction`, up to 1e-15 of its
  /// cosine. -1 without that direction, or without a normal.
  std::vector<int> symmetry_group;
  std::vector<bool> is_changed; ///< of each plane: whether it was changed
  /// of each plane: whether its points rejected all relations that were tested, so that it was rolled back
  std::vector<bool> is_rolled_back;
  std::vector<double> angle;            ///< of each plane: how far it was turned, in degrees
  std::vector<double> largest_distance; ///< of each plane: the largest distance of its points to it
  double maximum_distance = 0;          ///< the tolerance of the verification

  /// the number of distinct directions
  std::size_t number_of_parallel_groups() const { return number_of_groups(parallel_group); }
  /// the number of distinct planes
  std::size_t number_of_coplanar_groups() const { return number_of_groups(coplanar_group); }

private:
  static std::size_t number_of_groups(const std::vector<int>& group)
  {
    return group.empty() ? 0 : std::size_t(*std::max_element(group.begin(), group.end())) + 1;
  }
};

} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_PLANE_RELATIONS_H
