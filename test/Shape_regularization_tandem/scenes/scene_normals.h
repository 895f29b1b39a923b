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
  using Item = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  std::vector<Item> items;
  for(const Vec& p : points) { // relative to the first point: eigenvectors lose digits far from the origin
    const Vec q = p - points[0];
    items.emplace_back(Kernel::Point_3(q.x, q.y, q.z), Kernel::Vector_3(0, 0, 1));
  }
  const auto list = parameters::point_map(First_of_pair_property_map<Item>());
  pca_estimate_normals<Parallel_if_available_tag>(items, k, list.normal_map(Second_of_pair_property_map<Item>()));
  std::vector<Vec> normals;
  for(const auto& [p, n] : items)
    normals.push_back({n.x(), n.y(), n.z()});
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
