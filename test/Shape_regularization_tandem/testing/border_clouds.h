// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds at the border of what there can be: equal, joined, moved and bad points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BORDER_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BORDER_CLOUDS_H

#include "test_support.h"

#include <limits>

inline Cloud make_cloud(const std::string& scene, std::size_t points, double noise = .001, double outliers = .1)
{
  return to_cloud(scenes::make_scene(scene, scene_options(points, noise, outliers)));
}

inline Cloud repeated(std::size_t n) { return Cloud(n, {Kernel::Point_3(1, 2, 3), Kernel::Vector_3(0, 0, 1)}); }

inline Cloud joined(Cloud a, const Cloud& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline Cloud moved(Cloud cloud, double x, double y, double z)
{
  for(auto& item : cloud)
    item.first = item.first + Kernel::Vector_3(x, y, z);
  return cloud;
}

// Only among the first points: in blocks, those of the first rank.
inline Cloud spoiled(Cloud cloud, std::size_t n)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for(std::size_t i = 0; i < n; ++i)
    if(i % 2 == 0)
      cloud[i].first = Kernel::Point_3(0, i % 4 == 0 ? nan : infinite, 0);
    else
      cloud[i].second = Kernel::Vector_3(0, i % 3 == 0 ? nan : 0, 0);
  return cloud;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BORDER_CLOUDS_H
