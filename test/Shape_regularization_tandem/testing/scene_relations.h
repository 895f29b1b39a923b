// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_RELATIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_RELATIONS_H

#include "plane_relations.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace scenes {

// Of the true faces.
inline benchmark::Plane_relations relations(const Scene& scene)
{
  std::vector<benchmark::Plane> planes;
  for(const Truth_face& f : scene.faces)
    planes.push_back({f.normal, f.offset});
  return benchmark::Plane_relations(planes, benchmark::relaxed_relations(scene.diagonal, {0, 0, 0}));
}

// The first two coplanar faces whose points share a voxel; equal ones if there are none. Then they would be one shape with
// two labels, and the truth would be wrong.
inline std::pair<std::size_t, std::size_t> touching_faces(const Scene& scene, const std::vector<Vec>& points)
{
  using Voxel = std::tuple<long, long, long>;
  const benchmark::Plane_relations r = relations(scene);
  const double size = 6e-4 * scene.diagonal;
  std::vector<std::set<Voxel>> voxels(scene.faces.size());
  for(std::size_t i = 0; i < points.size(); ++i)
    if(scene.label[i] >= 0) {
      const Vec p = (1 / size) * points[i];
      voxels[std::size_t(scene.label[i])].emplace(std::lround(p.x), std::lround(p.y), std::lround(p.z));
    }
  for(std::size_t f = 0; f < voxels.size(); ++f)
    for(std::size_t g = 0; g < f; ++g)
      if(r.are_coplanar(f, g) &&
         std::any_of(voxels[f].begin(), voxels[f].end(), [&](const Voxel& v) { return voxels[g].count(v) > 0; }))
        return {f, g};
  return {0, 0};
}

} // namespace scenes
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_RELATIONS_H
