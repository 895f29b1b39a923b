// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_NEAR_BOXES_H
#define DETECT_PLANES_NEAR_BOXES_H

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace program {

inline CGAL::Bbox_3 grown(const CGAL::Bbox_3& b, double d)
{
  return {b.xmin() - d, b.ymin() - d, b.zmin() - d, b.xmax() + d, b.ymax() + d, b.zmax() + d};
}

// For each box those that it has points in common with, ascending, without a look at each pair.
inline std::vector<std::vector<std::size_t>> near_boxes(const std::vector<CGAL::Bbox_3>& boxes)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  std::vector<Box> items;
  for(const CGAL::Bbox_3& box : boxes)
    items.emplace_back(box, items.size());
  std::vector<std::vector<std::size_t>> result(boxes.size());
  CGAL::box_self_intersection_d(items.begin(), items.end(), [&](const Box& a, const Box& b) {
    result[a.info()].push_back(b.info());
    result[b.info()].push_back(a.info());
  });
  for(std::vector<std::size_t>& near : result)
    std::sort(near.begin(), near.end());
  return result;
}

} // namespace program

#endif // DETECT_PLANES_NEAR_BOXES_H
