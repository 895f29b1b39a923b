// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of small components become free, so that an assignment can give them to the shapes around: a component of less
// than the minimum number of points is no shape of the result. Changes labels only. See the manual, "Small Components".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_FREE_COMPONENTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_FREE_COMPONENTS_H

#include <CGAL/Tandem/internal/finish/components.h>
#include <CGAL/Tandem/internal/finish/large_components.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Points of small components become free. An item writes its own label only, so points may come in any order.
struct Free_small_components {
  const std::uint32_t* component;
  const std::uint32_t* size; // by root
  std::uint64_t minimum;
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(label[i] < first_mark && size[component[i]] < minimum)
      label[i] = free_label;
  }
};

// Afterwards each shape has the minimum size, or no point at all. Moments do not follow.
template <class Backend>
void free_small_components(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Options& options)
{
  const std::size_t n = points.cloud.size();
  typename Backend::template Buffer<std::uint32_t> component(points.cloud.size_with_ghosts());
  auto seams = find_components(points, options.growth.cell_size, points.label(), component.data());
  const auto size = component_sizes(points, {points.cloud.surfels(), points.label(), nullptr}, component.data(), seams);
  const Labels_view labels = points.change_labels(true); // lists may have shapes without points
  shapes.lose_moments();
  points.backend.for_each(
    n, Free_small_components{component.data(), size.data(), std::uint64_t(options.minimum_region_size), labels.label});
  points.refresh_labels();
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_FREE_COMPONENTS_H
