// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_PLANE_RELATIONS_H
#define CGAL_TANDEM_PLANE_RELATIONS_H

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

How planes are related after `regularize_planes()`. Planes are numbered as in the caller's range, groups from 0.
*/
struct Plane_relations {
  /// the parallel group of each plane: planes of a parallel group have the same unit normal, up to its sign
  std::vector<int> parallel_group;
  std::vector<int> coplanar_group; ///< the coplanar group of each plane: planes of a coplanar group are the same plane
  /// pairs of parallel groups that are orthogonal, each with the smaller index first, sorted
  std::vector<std::pair<int, int>> orthogonal_groups;
  /// for each parallel group the index of the first of `fixed_directions` that it has, -1 if it has none
  std::vector<int> fixed_direction;
  /// the symmetry group of each parallel group: parallel groups of a symmetry group make the same angle with
  /// `symmetry_direction`, up to 1e-15 of its cosine. It is -1 if there is no `symmetry_direction`, or if the planes of
  /// the parallel group have no normal.
  std::vector<int> symmetry_group;
  std::vector<bool> is_changed; ///< for each plane, whether it was changed
  /// for each plane, whether it has a direction of its own although another one is within `maximum_angle`: to take that
  /// one would have cost its points more than it is worth
  std::vector<bool> is_rolled_back;
  std::vector<double> angle;            ///< for each plane, how far it was turned, in degrees
  std::vector<double> largest_distance; ///< for each plane, the largest distance of its points to it
  double maximum_distance = 0;          ///< the distance that costs were measured by

  /// returns the number of distinct directions
  std::size_t number_of_parallel_groups() const { return number_of_groups(parallel_group); }
  /// returns the number of distinct planes
  std::size_t number_of_coplanar_groups() const { return number_of_groups(coplanar_group); }

private:
  static std::size_t number_of_groups(const std::vector<int>& group)
  {
    return group.empty() ? 0 : std::size_t(*std::max_element(group.begin(), group.end())) + 1;
  }
};

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_PLANE_RELATIONS_H
