// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scene_normals.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <utility>

namespace CGAL::Tandem::scenes {

std::vector<Vec> pca_normals(const std::vector<Vec>& points, unsigned k)
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

void set_blended_normals(Scene& scene, double normal_noise_deg, std::uint64_t seed, unsigned k)
{
  Random random(seed ^ 0x6e6f726d616c73u);
  scene.normals = pca_normals(scene.ideal, k);
  for(Vec& n : scene.normals)
    n = perturbed(n, normal_noise_deg, random);
}

} // namespace CGAL::Tandem::scenes
