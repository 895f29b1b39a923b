// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The check of connectivity over many ranks: that of one process on the points of each rank and their ghosts, whose
// components are joined as in the engine.

#ifndef CGAL_TANDEM_INTERNAL_MPI_FIRST_UNCONNECTED_H
#define CGAL_TANDEM_INTERNAL_MPI_FIRST_UNCONNECTED_H

#include <CGAL/Tandem/internal/engine/first_unconnected.h>
#include <CGAL/Tandem/internal/mpi/Distribution.h>
#include <CGAL/Tandem/internal/mpi/Mpi_ranks.h>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Local>
std::size_t first_unconnected(Mpi_backend<Local>& backend, const Import& in, const std::vector<std::int32_t>& labels,
                              const Label_graph& graph, Score_counts& counts)
{
  Communicator& communicator = backend.communicator();
  const std::size_t k = graph.k, shapes = graph.shapes;
  if(in.total.points == 0)
    return shapes;
  Distribution<Local> distribution(backend, in, Parameters().cell_size);
  const Import own = distribution.distribute(in);
  const std::vector<std::int32_t> own_labels = distribution.distribute(labels.data());
  const std::uint32_t n = std::uint32_t(own.size());
  Host_buffer<Grid_point> unsorted(n), point(n);
  backend.for_each(n, place_on_grid(own, unsorted.data()));
  const auto order = sort_import(backend, own, unsorted.data());
  for(std::uint32_t i = 0; i < n; ++i)
    point[i] = unsorted[order.view().index(i)];
  std::vector<std::uint32_t> neighbor(n * k);
  find_neighbors(static_cast<Local&>(backend), point.data(), n, int(k), neighbor.data());
  const std::vector<Remote_entry> remote =
    Border_search<Local>(communicator, point.data(), n, int(k), neighbor.data())();
  Ghosts<Mpi_backend<Local>> ghosts(backend, n);
  ghosts.add_ring(points_of(remote));
  for(const Remote_entry& e : remote)
    neighbor[e.entry] = ghosts.place_of(e.point);

  std::vector<std::int32_t> label(n + ghosts.size());
  for(std::uint32_t i = 0; i < n; ++i)
    label[i] = own_labels[order.view().index(i)];
  ghosts.update(0, label.data());
  Parents parents(label.size());
  for(std::uint32_t i = 0; i < n; ++i) {
    parents.unite_around(i, neighbor.data() + i * k, k, label.data());
    count_links(i, neighbor.data() + i * k, k, label.data(), counts);
  }
  counts.links = std::int64_t(communicator.sum(std::uint64_t(counts.links)));
  counts.free_links = std::int64_t(communicator.sum(std::uint64_t(counts.free_links)));
  std::vector<std::uint32_t> mark, component;
  for(std::uint32_t i = 0; i < label.size(); ++i) {
    mark.push_back(label[i] < 0 ? free_label : std::uint32_t(label[i]));
    component.push_back(parents.root(i));
  }
  const Seams seams = join_components(communicator, ghosts, mark.data(), component.data());

  // The smallest and the largest root of each shape.
  const std::uint64_t rank = std::uint64_t(communicator.rank());
  std::vector<std::uint64_t> first(shapes, ~std::uint64_t(0)), last(shapes, 0);
  for(std::uint32_t i = 0; i < n; ++i)
    if(label[i] >= 0) {
      const std::uint64_t root = seams.global_root(rank, component[i]);
      first[std::size_t(label[i])] = (std::min)(first[std::size_t(label[i])], root);
      last[std::size_t(label[i])] = (std::max)(last[std::size_t(label[i])], root);
    }
  communicator.minimize(first.data(), shapes);
  communicator.maximize(last.data(), shapes);
  for(std::size_t s = 0; s < shapes; ++s)
    if(first[s] != last[s])
      return s;
  return shapes;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_FIRST_UNCONNECTED_H
