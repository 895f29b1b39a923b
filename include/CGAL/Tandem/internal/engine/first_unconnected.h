// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components and links for the check of a result. Neighbors are searched again, on points that are sorted as
// in the engine, since positions break ties between neighbors at equal distance.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H
#define CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/cloud/cells.h>
#include <CGAL/Tandem/internal/engine/engine_api.h>
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
  void unite_around(std::uint32_t i, const std::uint32_t* row, std::size_t k, const std::int32_t* label)
  {
    const auto unite_alike = [&](std::uint32_t a, std::uint32_t b) {
      if(label[a] >= 0 && label[a] == label[b])
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

// The neighbors of the point i that have another shape, or one where it has none.
inline void count_links(std::uint32_t i, const std::uint32_t* row, std::size_t k, const std::int32_t* label,
                        Score_counts& counts)
{
  for(std::size_t j = 0; j < k && row[j] != no_index; ++j)
    if(label[row[j]] != label[i])
      ++(label[i] < 0 || label[row[j]] < 0 ? counts.free_links : counts.links);
}

// Of a result: neighbors of a point, and shapes.
struct Label_graph {
  std::size_t k, shapes;
};

// The imported points in the order of the engine: the sorted table of their codes.
template <class Backend>
typename Backend::Sort_table sort_import(Backend& backend, const Import& in, const Grid_point* point)
{
  return sort_along_curve(
    backend, point, in.size(), make_code_frame(in.low, in.high),
    make_tie_order([&](std::uint32_t i, std::uint32_t j) { return in.precedes(i, j); }, Nothing()));
}

// The k nearest neighbors of each point, as positions in that order.
template <class Backend>
std::vector<std::uint32_t> sorted_neighbors(Backend& backend, const Import& in,
                                            const typename Backend::Sort_table& order, std::size_t k)
{
  const std::uint32_t n = std::uint32_t(in.size());
  std::vector<Grid_point> point(n);
  for(std::uint32_t i = 0; i < n; ++i)
    point[i] = in.point[order.view().index(i)];
  std::vector<std::uint32_t> neighbor(n * k);
  find_neighbors(backend, point.data(), n, int(k), neighbor.data());
  return neighbor;
}

// The same of each imported point, as imported points.
template <class Backend>
std::vector<std::uint32_t> import_neighbors(Backend& backend, const Import& in, std::size_t k)
{
  const std::uint32_t n = std::uint32_t(in.size());
  std::vector<std::uint32_t> result(n * k);
  if(n == 0)
    return result;
  const auto order = sort_import(backend, in, in.point.data());
  const std::vector<std::uint32_t> neighbor = sorted_neighbors(backend, in, order, k);
  for(std::uint32_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < k; ++j) {
      const std::uint32_t q = neighbor[i * k + j];
      result[order.view().index(i) * k + j] = q == no_index ? no_index : std::uint32_t(order.view().index(q));
    }
  return result;
}

// The first shape whose points are not one component, or the number of shapes; and the links of the score. labels: by
// imported point, -1 = none.
template <class Backend>
std::size_t first_unconnected(Backend& backend, const Import& in, const std::vector<std::int32_t>& labels,
                              const Label_graph& graph, Score_counts& counts)
{
  static_assert(!Ranks<Backend>::are_many, "many ranks need the overload of mpi.h");
  const std::size_t n = in.size(), k = graph.k;
  std::size_t shapes = graph.shapes;
  if(n == 0)
    return shapes;
  const auto order = sort_import(backend, in, in.point.data());
  const std::vector<std::uint32_t> neighbor = sorted_neighbors(backend, in, order, k);
  std::vector<std::int32_t> label(n);
  for(std::size_t i = 0; i < n; ++i)
    label[i] = labels[order.view().index(i)];
  Parents parents(n);
  for(std::uint32_t i = 0; i < n; ++i) {
    parents.unite_around(i, neighbor.data() + i * k, k, label.data());
    count_links(i, neighbor.data() + i * k, k, label.data(), counts);
  }
  std::vector<std::uint32_t> component(shapes, no_index);
  for(std::uint32_t i = 0; i < n; ++i) {
    if(label[i] < 0)
      continue;
    std::uint32_t& first = component[std::size_t(label[i])];
    if(first == no_index)
      first = parents.root(i);
    else if(first != parents.root(i))
      shapes = (std::min)(shapes, std::size_t(label[i]));
  }
  return shapes;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_FIRST_UNCONNECTED_H
