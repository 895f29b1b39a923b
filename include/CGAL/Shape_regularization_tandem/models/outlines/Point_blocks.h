// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds what is close without a look at everything.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_POINT_BLOCKS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_POINT_BLOCKS_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

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

// Blocks of consecutive points, blocks of these, and so on, so that the points at a place are found without a look at
// each one.
class Point_blocks {
public:
  struct Block {
    CGAL::Bbox_3 box;
    float spacing = 0; // the largest
  };

  Point_blocks(const std::vector<Kernel::Point_3>& points, const std::vector<float>& spacing) : size(points.size())
  {
    std::vector<Block> level;
    for(std::size_t i = 0; i < size; ++i)
      add(level, i / points_of_block, {points[i].bbox(), spacing[i]});
    levels.push_back(level);
    while(levels.back().size() > fan_out) {
      level.clear();
      for(std::size_t i = 0; i < levels.back().size(); ++i)
        add(level, i / fan_out, levels.back()[i]);
      levels.push_back(level);
    }
  }

  const std::vector<Block>& smallest() const { return levels.front(); }

  // f(position) for the points, in their order, of the blocks that `is_near` accepts, which are inside of others that
  // it accepts.
  template <class Is_near, class Function>
  void for_each(Is_near is_near, Function f) const
  {
    visit(levels.size() - 1, 0, levels.back().size(), is_near, f);
  }

private:
  static constexpr std::size_t points_of_block = 64, fan_out = 8;

  static void add(std::vector<Block>& level, std::size_t block, const Block& part)
  {
    level.resize(block + 1);
    level.back().box += part.box;
    level.back().spacing = (std::max)(level.back().spacing, part.spacing);
  }

  template <class Is_near, class Function>
  void visit(std::size_t level, std::size_t first, std::size_t last, Is_near& is_near, Function& f) const
  {
    for(std::size_t b = first; b < last; ++b) {
      if(!is_near(levels[level][b]))
        continue;
      const std::size_t count = level == 0 ? size : levels[level - 1].size();
      const std::size_t parts = level == 0 ? points_of_block : fan_out;
      const std::size_t begin = b * parts, end = (std::min)(begin + parts, count);
      if(level > 0)
        visit(level - 1, begin, end, is_near, f);
      else
        for(std::size_t i = begin; i < end; ++i)
          f(i);
    }
  }

  std::size_t size;
  std::vector<std::vector<Block>> levels; // from the smallest blocks to the largest
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_POINT_BLOCKS_H
