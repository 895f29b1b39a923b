// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which components become shapes: those with at least the minimum number of points. Also their order in the result.
// Reads labels and components, changes nothing.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_LARGE_COMPONENTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_LARGE_COMPONENTS_H

#include <CGAL/Tandem/internal/finish/Labels_of_points.h>
#include <CGAL/Tandem/internal/finish/Seams.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Adds the labeled points of each cell to their components: size[r] for the root r. Counts are gathered in the cell
// first, because all points of a face have the same root. Integer sums, so the order does not matter.
template <class Backend>
struct Count_components {
  const Range* cells;
  Labels_of_points labels;
  const std::uint32_t* component;
  std::uint32_t* size;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    scratch.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      std::uint32_t points = 0;
      labels.for_each_point(cell.first + at, [&](std::uint32_t) { ++points; });
      if(points > 0)
        scratch.template add<Backend>(block, component[cell.first + at], points, size);
    });
    scratch.template flush<Backend>(block, size);
  }
};

// The roots of the components that are large enough. A free point is a root of its own, and excluded by its label.
struct Is_large_root {
  const std::uint32_t* label;
  const std::uint32_t* component;
  const std::uint32_t* size;
  std::uint64_t minimum;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    return component[i] == i && label[i] < first_mark && size[i] >= minimum;
  }
};

// Packs what the host needs of each large component, so that one copy is enough.
struct Gather_components {
  const std::uint32_t* root;
  const std::uint32_t* label;
  const std::uint32_t* size;
  Component* component;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { component[i] = {root[i], label[root[i]], size[root[i]]}; }
};

// By root: the number of labeled points of its component; 0 for all other entries.
template <class Backend>
typename Backend::template Buffer<std::uint32_t> component_sizes(Labeled_cloud<Backend>& points,
                                                                 const Labels_of_points& labels,
                                                                 const std::uint32_t* component, Seams<Backend>& seams)
{
  auto size = filled_buffer(points.backend, points.cloud.size(), std::uint32_t(0));
  points.backend.template for_each_cell<Count_scratch>(
    points.number_of_cells(), Count_components<Backend>{points.cells.data(), labels, component, size.data()});
  seams.sum_sizes(size.size(), size.data());
  return size;
}

// By falling number of points, then by position of the root: they are found in that order.
template <class Backend>
std::vector<Component> large_components(Labeled_cloud<Backend>& points, std::int64_t minimum_size,
                                        const Labels_of_points& labels, const std::uint32_t* component,
                                        Seams<Backend>& seams)
{
  Backend& backend = points.backend;
  const std::size_t n = points.cloud.size();
  const auto size = component_sizes(points, labels, component, seams);
  const auto root =
    backend.compact(n, Is_large_root{labels.label, component, size.data(), std::uint64_t(minimum_size)});
  typename Backend::template Buffer<Component> buffer(root.size());
  backend.for_each(root.size(), Gather_components{root.data(), labels.label, size.data(), buffer.data()});
  std::vector<Component> components = seams.join_large(to_vector(backend, buffer));
  std::stable_sort(components.begin(), components.end(),
                   [](const Component& a, const Component& b) { return a.size > b.size; });
  return components;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_LARGE_COMPONENTS_H
