// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals as most programs make them: the smallest eigenvector of the k nearest
// points. At edges they are blended, which is what costs detectors thin faces.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_NORMALS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_NORMALS_H

#include "scenes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <utility>

namespace CGAL::Tandem::scenes {

inline std::vector<Vec> pca_normals(const std::vector<Vec>& points, unsigned k = 20)
{
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  std::vector<Point_with_normal> range;
  range.reserve(points.size());
  // Relative to the first point: eigenvectors lose digits far from the origin.
  for(const Vec& p : points) {
    Vec q = p - points[0];
    range.emplace_back(Kernel::Point_3(q.x, q.y, q.z), Kernel::Vector_3(0, 0, 1));
  }
  pca_estimate_normals<Parallel_if_available_tag>(range, k,
                                                  parameters::point_map(First_of_pair_property_map<Point_with_normal>())
                                                    .normal_map(Second_of_pair_property_map<Point_with_normal>()));
  std::vector<Vec> normals;
  normals.reserve(points.size());
  for(const Point_with_normal& p : range)
    normals.push_back({p.second.x(), p.second.y(), p.second.z()});
  return normals;
}

// A scanner that knows its own noise: fitted on the ideal points (so blended at
// edges and arbitrary at outliers), then perturbed.
inline void set_blended_normals(Scene& scene, double normal_noise_deg, std::uint64_t seed)
{
  Random random(seed ^ 0x6e6f726d616c73u);
  scene.normals = pca_normals(scene.ideal);
  for(Vec& n : scene.normals)
    n = perturbed(n, normal_noise_deg, random);
}

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_NORMALS_H
