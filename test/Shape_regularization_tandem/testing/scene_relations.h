// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_RELATIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_RELATIONS_H

#include "plane_relations.h"
#include "scenes.h"

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

} // namespace scenes
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_RELATIONS_H
