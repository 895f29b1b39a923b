// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components for the check of a result. The graph is made again, by the functions that the engine
// calls, since positions break ties between neighbors at equal distance.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H
#define CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/engine/connect_cloud.h>
#include <CGAL/Tandem/internal/engine/engine_api.h>
#include <CGAL/Tandem/internal/engine/make_stage_parameters.h>
#include <CGAL/Tandem/internal/finish/Border_components.h>

#include <numeric>
#include <vector>

namespace CGAL::Tandem::internal {

// A union-find by one thread.
using Parents = Union_find<Shared_parents<Sequential_backend>>;

// Connects a point with its neighbors, and these with each other, where their labels are the same shape.
inline void unite_around(const Parents& sets, std::uint32_t i, const std::uint32_t* row, std::size_t k,
                         const std::uint32_t* label)
{
  const auto unite_alike = [&](std::uint32_t a, std::uint32_t b) {
    if(label[a] != free_label && label[a] == label[b])
      sets.unite(a, b);
  };
  for(std::size_t j = 0; j < k && row[j] != no_index; ++j) {
    unite_alike(i, row[j]);
    for(std::size_t l = 0; l < j; ++l)
      unite_alike(row[l], row[j]);
  }
}

// Of a result: how it was made, its planes, and what it says of the imported points.
struct Labeled_points {
  const Parameters& parameters;
  const std::vector<Coefficients>& planes;
  std::vector<std::int32_t> shape;   // by imported point, -1 = none
  std::vector<std::uint32_t> normal; // the same, packed; empty if normals were given

  std::size_t shapes() const { return planes.size(); }
};

// The points of a rank: label and component, and the numbers of roots in the cloud of all ranks.
template <class Backend>
struct Labeled_components {
  const std::vector<std::uint32_t>& label;
  const std::vector<std::uint32_t>& component;
  const Border_components<Backend>& borders;
};

// The first shape with points in two components, or the number of shapes; n: own points.
template <class Backend>
std::size_t first_of_two_roots(const Ranks<Backend>& ranks, const Labeled_components<Backend>& points, std::uint32_t n,
                               std::size_t shapes)
{
  // Of each shape on this rank two roots, which differ if any do; then the same of all ranks.
  struct Roots {
    std::uint64_t shape, first, last;
  };
  std::vector<Roots> own;
  std::vector<std::size_t> place(shapes, shapes);
  for(std::uint32_t i = 0; i < n; ++i)
    if(points.label[i] != free_label) {
      const std::uint64_t root = points.borders.global_root(points.component[i]);
      std::size_t& at = place[points.label[i]];
      if(at == shapes) {
        at = own.size();
        own.push_back({points.label[i], root, root});
      } else if(own[at].first != root)
        own[at].last = root;
    }
  std::vector<std::uint64_t> root(shapes, ~std::uint64_t(0));
  std::size_t unconnected = shapes;
  for(const Roots& r : ranks.gather(own)) {
    if(root[r.shape] == ~std::uint64_t(0))
      root[r.shape] = r.first;
    if(r.first != root[r.shape] || r.last != root[r.shape])
      unconnected = (std::min)(unconnected, std::size_t(r.shape));
  }
  return unconnected;
}

// The label of each surfel, which is that of its points in shapes. `mixed` becomes the least label of a shape whose
// points share a surfel with those of another one: no result has such surfels.
template <class Backend>
std::vector<std::uint32_t> surfel_labels(const Sorted_cloud<Backend>& cloud, const std::vector<std::int32_t>& labels,
                                         std::size_t& mixed)
{
  std::vector<std::uint32_t> label(cloud.size_with_ghosts(), free_label);
  const Surfels_view surfels = cloud.surfels();
  for(std::uint32_t p = 0; p < cloud.number_of_points(); ++p) {
    const std::int32_t s = labels[cloud.order.data()[p]];
    std::uint32_t& of_surfel = label[surfels.of_point(p)];
    if(s >= 0 && of_surfel != free_label && of_surfel != std::uint32_t(s))
      mixed = (std::min)({mixed, std::size_t(s), std::size_t(of_surfel)});
    else if(s >= 0)
      of_surfel = std::uint32_t(s);
  }
  return label;
}

// Makes the graph of a result again, and returns the labels of its surfels, with those of ghosts; `mixed` as above. The
// points are those of this rank; ranks have whole leaves of the octree.
template <class Backend>
std::vector<std::uint32_t> label_graph(Labeled_cloud<Backend>& points, Import& in, const Labeled_points& result,
                                       std::size_t& mixed)
{
  Sorted_cloud<Backend>& cloud = points.cloud;
  cloud.k = int(result.parameters.k_neighbors);
  sort_points(points.backend, in, result.parameters.cell_size, cloud, points.cells);
  connect_cloud(points, in, make_stage_parameters(in, result.parameters).maximum_distance_steps);
  std::vector<std::uint32_t> label = surfel_labels(cloud, result.shape, mixed);
  points.ranks.refresh(label.data(), Rings::inner);
  return label;
}

// The first shape whose surfels are not one component, or the number of shapes.
template <class Backend>
std::size_t first_unconnected_here(Backend& backend, Import& in, const Labeled_points& result)
{
  Labeled_cloud<Backend> points(backend);
  const Ranks<Backend>& ranks = points.ranks;
  std::size_t mixed = result.shapes();
  const std::vector<std::uint32_t> label = label_graph(points, in, result, mixed);
  std::vector<std::uint32_t> component(label.size());
  std::iota(component.begin(), component.end(), 0u);
  const Parents sets = {{component.data()}};
  const Cloud_view view = points.cloud.view();
  for(std::uint32_t i = 0; i < view.size; ++i)
    unite_around(sets, i, view.row(i), std::size_t(view.k), label.data());
  for(std::uint32_t i = 0; i < label.size(); ++i)
    component[i] = sets.root(i);
  Border_components<Backend> borders(backend, ranks);
  borders.find(view, label.data(), component.data());
  std::size_t first = first_of_two_roots<Backend>(ranks, {label, component, borders}, view.size, result.shapes());
  for(const std::uint64_t m : ranks.gather(std::vector<std::uint64_t>{mixed}))
    first = (std::min)(first, std::size_t(m));
  return first;
}

// The first shape whose points are not one component, or the number of shapes.
template <class Backend>
std::size_t first_unconnected(Backend& backend, Import& in, const Labeled_points& result)
{
  static_assert(!Ranks<Backend>::are_many, "many ranks need the overload of mpi.h");
  return in.total.points == 0 ? result.shapes() : first_unconnected_here(backend, in, result);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H
