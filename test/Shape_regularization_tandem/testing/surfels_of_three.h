// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cloud of surfels of several points, for tests of bodies that visit points by their surfels.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SURFELS_OF_THREE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SURFELS_OF_THREE_H

#include "body_fixture.h"

namespace CGAL {
namespace Tandem {
namespace internal {

// Surfels of three points each, at the first of them, with the labels of these; some points have lost theirs.
struct Surfels_of_three {
  std::vector<Grid_point> point;
  std::vector<std::uint32_t> first, surfel, neighbor, label, point_label;
  std::vector<std::uint8_t> level; // by surfel: of the smallest tolerance of its points; empty without levels
  std::vector<Range> cells;
  Cloud_view cloud;

  explicit Surfels_of_three(const Fixture& f)
  {
    for(std::uint32_t p = 0; p < f.point.size(); ++p) {
      if(p % 3 == 0) {
        first.push_back(p);
        point.push_back(f.point[p]);
        label.push_back(f.label[p]);
        if(!f.level.empty())
          level.push_back(f.level[p]);
      }
      if(!level.empty())
        level.back() = (std::max)(level.back(), f.level[p]);
      surfel.push_back(std::uint32_t(point.size() - 1));
      point_label.push_back(p % 5 == 0 ? locked_label : label.back());
    }
    first.push_back(std::uint32_t(f.point.size()));
    const std::uint32_t size = std::uint32_t(point.size());
    neighbor.resize(size * std::size_t(f.cloud.k));
    Sequential_backend backend;
    find_neighbors(backend, point.data(), size, f.cloud.k, neighbor.data());
    for(const Range& cell : f.cells)
      cells.push_back({(cell.first + 2) / 3, (cell.last + 2) / 3});
    cloud = {point.data(), neighbor.data(), size, f.cloud.k, {f.point.data(), first.data(), surfel.data()}};
    cloud.level = level.empty() ? nullptr : level.data();
    cloud.surfels.level = f.cloud.surfels.level;
  }
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SURFELS_OF_THREE_H
