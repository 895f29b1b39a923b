// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components and links for the check of a result. The graph is made again, by the functions that the engine
// calls, since positions break ties between neighbors at equal distance.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H
#define CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/engine/connect_cloud.h>
#include <CGAL/Tandem/internal/engine/engine_api.h>
#include <CGAL/Tandem/internal/engine/make_options.h>
#include <CGAL/Tandem/internal/engine/sort_points.h>
#include <CGAL/Tandem/internal/finish/Seams.h>
#include <CGAL/Tandem/internal/finish/explain_free_points.h>
#include <CGAL/Tandem/internal/score/Score.h>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A union-find by one thread, with halved paths. Roots are the smallest indices.
class Parents {
public:
  explicit Parents(std::size_t n)
  {
    for(std::size_t i = 0; i < n; ++i)
      parent_.push_back(std::uint32_t(i));
  }

  std::uint32_t root(std::uint32_t i)
  {
    while(parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(std::uint32_t a, std::uint32_t b)
  {
    a = root(a);
    b = root(b);
    parent_[(std::max)(a, b)] = (std::min)(a, b);
  }

  // Connects a point with its neighbors, and these with each other, where their labels are the same shape.
  void unite_around(std::uint32_t i, const std::uint32_t* row, std::size_t k, const std::uint32_t* label)
  {
    const auto unite_alike = [&](std::uint32_t a, std::uint32_t b) {
      if(label[a] != free_label && label[a] == label[b])
        unite(a, b);
    };
    for(std::size_t j = 0; j < k && row[j] != no_index; ++j) {
      unite_alike(i, row[j]);
      for(std::size_t l = 0; l < j; ++l)
        unite_alike(row[l], row[j]);
    }
  }

private:
  std::vector<std::uint32_t> parent_;
};

// The neighbors of surfel i that have another shape, or one where it has none, for each of its points.
inline void count_links(const Cloud_view& cloud, std::uint32_t i, const std::uint32_t* label, Score_counts& counts)
{
  const std::uint32_t* row = cloud.row(i);
  for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
    if(label[row[j]] != label[i])
      (label[i] == free_label || label[row[j]] == free_label ? counts.free_links : counts.links) +=
        cloud.surfels.points(i).size();
}

// Of a result: how it was made, its planes, and what it says of the imported points.
struct Labeled_points {
  const Parameters& parameters;
  const std::vector<Coefficients>& planes;
  std::vector<std::int32_t> shape;   // by imported point, -1 = none
  std::vector<std::uint32_t> normal; // the same, packed; empty if normals were given

  std::size_t shapes() const { return planes.size(); }
};

// What is counted in the neighbor graph.
struct Graph_counts {
  Score_counts score; // links only
  Free_points free_points;
};

// The k nearest neighbors of each imported point, as imported points, without surfels.
template <class Backend>
std::vector<std::uint32_t> import_neighbors(Backend& backend, const Import& in, std::size_t k)
{
  const std::uint32_t n = std::uint32_t(in.size());
  std::vector<std::uint32_t> neighbor(n * k), result(n * k);
  if(n == 0)
    return result;
  const auto order =
    sort_along_curve(backend, {in.point.data(), n}, make_code_frame(in.low, in.high),
                     make_tie_order([&](std::uint32_t i, std::uint32_t j) { return in.precedes(i, j); }, Nothing()));
  std::vector<Grid_point> point(n);
  for(std::uint32_t i = 0; i < n; ++i)
    point[i] = in.point[order.view().index(i)];
  find_neighbors(backend, point.data(), n, int(k), neighbor.data());
  for(std::uint32_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < k; ++j) {
      const std::uint32_t q = neighbor[i * k + j];
      result[order.view().index(i) * k + j] = q == no_index ? no_index : std::uint32_t(order.view().index(q));
    }
  return result;
}

// The points of a rank: label and component, and the numbers of roots in the cloud of all ranks.
template <class Backend>
struct Labeled_components {
  const std::vector<std::uint32_t>& label;
  const std::vector<std::uint32_t>& component;
  const Seams<Backend>& seams;
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
      const std::uint64_t root = points.seams.global_root(points.component[i]);
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

// Surfels and points get the estimated normals of a result. In a result, all points of a surfel have one.
template <class Backend>
void take_normals(const Ranks<Backend>& ranks, const std::vector<std::uint32_t>& normal, Sorted_cloud<Backend>& cloud)
{
  const Surfels_view surfels = cloud.surfels();
  for(std::uint32_t p = 0; p < cloud.number_of_points(); ++p) {
    const std::uint32_t n = normal[cloud.order.data()[p]];
    cloud.point.data()[surfels.of_point(p)].normal = n;
    if(cloud.has_surfels())
      cloud.all_points.data()[p].normal = n;
  }
  ranks.refresh(cloud.point.data(), Rings::inner);
}

// The reasons why points have no shape. label: by surfel, with ghosts.
template <class Backend>
Free_points count_free_points(Labeled_cloud<Backend>& points, const Import& in, const Labeled_points& result,
                              const std::vector<std::uint32_t>& label)
{
  Sorted_cloud<Backend>& cloud = points.cloud;
  if(!in.has_normals) // on all ranks, also where one has no points
    take_normals(points.ranks, result.normal, cloud);
  std::vector<std::uint32_t> point_label;
  for(std::uint32_t p = 0; p < cloud.number_of_points(); ++p)
    point_label.push_back(std::uint32_t(result.shape[cloud.order.data()[p]])); // -1 becomes free_label
  static_assert(free_label == no_index && free_label == std::uint32_t(-1), "a free surfel has no shape");
  const Final_shapes shapes = {{cloud.surfels(), label.data(), point_label.data()}, label.data()};
  return explain_free_points(points, shapes, result.planes, in.grid,
                             make_options(in, result.parameters).growth.tolerance);
}

// The first shape whose surfels are not one component, or the number of shapes; and what is counted in the graph, of all
// ranks. The points are those of this rank; ranks have whole leaves of the octree.
template <class Backend>
std::size_t first_unconnected_here(Backend& backend, Import& in, const Labeled_points& result, Graph_counts& counts)
{
  Labeled_cloud<Backend> points(backend);
  Sorted_cloud<Backend>& cloud = points.cloud;
  const Ranks<Backend>& ranks = points.ranks;
  cloud.k = int(result.parameters.k_neighbors);
  sort_points(backend, in, result.parameters.cell_size, cloud, points.cells);
  connect_cloud(points, in, make_options(in, result.parameters).tight);
  std::size_t mixed = result.shapes();
  std::vector<std::uint32_t> label = surfel_labels(cloud, result.shape, mixed), component;
  ranks.refresh(label.data(), Rings::inner);
  Parents parents(label.size());
  const Cloud_view view = cloud.view();
  for(std::uint32_t i = 0; i < view.size; ++i) {
    parents.unite_around(i, view.row(i), std::size_t(view.k), label.data());
    count_links(view, i, label.data(), counts.score);
  }
  counts.score.links = std::int64_t(ranks.total(std::size_t(counts.score.links)));
  counts.score.free_links = std::int64_t(ranks.total(std::size_t(counts.score.free_links)));
  counts.free_points = count_free_points(points, in, result, label);
  for(std::uint32_t i = 0; i < label.size(); ++i)
    component.push_back(parents.root(i));
  Seams<Backend> seams(backend, ranks);
  seams.find(view, label.data(), component.data());
  std::size_t first = first_of_two_roots<Backend>(ranks, {label, component, seams}, view.size, result.shapes());
  for(const std::uint64_t m : ranks.gather(std::vector<std::uint64_t>{mixed}))
    first = (std::min)(first, std::size_t(m));
  return first;
}

// The first shape whose points are not one component, or the number of shapes; and what is counted in the graph.
template <class Backend>
std::size_t first_unconnected(Backend& backend, Import& in, const Labeled_points& result, Graph_counts& counts)
{
  static_assert(!Ranks<Backend>::are_many, "many ranks need the overload of mpi.h");
  return in.total.points == 0 ? result.shapes() : first_unconnected_here(backend, in, result, counts);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H
