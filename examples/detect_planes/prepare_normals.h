// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The normals that the detection gets: those of the input, or none, or others than those of the library.

#ifndef DETECT_PLANES_PREPARE_NORMALS_H
#define DETECT_PLANES_PREPARE_NORMALS_H

#include "Options.h"
#include "input/point_set.h"
#include "output/report.h"

#include <CGAL/Real_timer.h>
#include <CGAL/pca_estimate_normals.h>

#include <string>
#include <utility>
#include <vector>

namespace program {

// The plain PCA of K neighbors, for comparisons. Points at infinity have no place in a kd-tree.
inline void estimate_normals_by_pca(Point_set& points, unsigned int k)
{
  using Item = std::pair<Kernel::Point_3, Kernel::Vector_3>;
  std::vector<Item> finite;
  for(Point_set::Index i : points)
    if(is_finite(points.point(i)))
      finite.emplace_back(points.point(i), CGAL::NULL_VECTOR);
  CGAL::pca_estimate_normals<CGAL::Parallel_if_available_tag>(
    finite, k,
    CGAL::parameters::point_map(CGAL::First_of_pair_property_map<Item>())
      .normal_map(CGAL::Second_of_pair_property_map<Item>()));
  points.add_normal_map();
  auto next = finite.begin();
  for(Point_set::Index i : points)
    points.normal(i) = is_finite(points.point(i)) ? (next++)->second : Kernel::Vector_3(CGAL::NULL_VECTOR);
}

inline void prepare_normals(Point_set& points, const Options& o, Run& run)
{
  run.normals = points.has_normal_map() ? "given" : o.known_planes.empty() ? "estimated" : "none";
  if(!o.estimate_normals)
    return;
  points.remove_normal_map();
  run.normals = "estimated";
  if(*o.estimate_normals == by_library)
    return;
  CGAL::Real_timer timer;
  timer.start();
  estimate_normals_by_pca(points, unsigned(*o.estimate_normals));
  run.normals = "by PCA of " + std::to_string(*o.estimate_normals) + " neighbors";
  run.normal_seconds = timer.time();
}

} // namespace program

#endif // DETECT_PLANES_PREPARE_NORMALS_H
