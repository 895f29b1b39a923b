// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a shape in its frame.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_POINTS_OF_SHAPE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_POINTS_OF_SHAPE_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Border_finder.h>

#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/hilbert_sort.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// The order of the caller's points does not matter.
inline Shape_points points_of_shape(const std::vector<Position>& points, const Shapes& shapes, const Unit& unit,
                                    std::size_t s)
{
  std::vector<Kernel::Point_3> sorted;
  for(std::uint32_t i : shapes.points(s))
    sorted.push_back(unit.in(points[i]));
  std::sort(sorted.begin(), sorted.end());
  Shape_points result = {Plane_frame(shapes, s, sorted[0]), {}, {}, {}};
  using Item = std::pair<Kernel::Point_2, std::uint32_t>;
  std::vector<Item> items;
  for(const Kernel::Point_3& p : sorted)
    items.emplace_back(result.frame.flat(p), std::uint32_t(items.size()));
  CGAL::hilbert_sort(items.begin(), items.end(),
                     CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::First_of_pair_property_map<Item>>());
  for(const auto& [flat, i] : items) {
    result.flat.push_back(flat);
    result.points.push_back(sorted[i]);
  }
  return result;
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_POINTS_OF_SHAPE_H
