// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sample of neighbors/measure_cloud.h, of the points of all ranks. Each rank gets the whole sample.

#ifndef CGAL_TANDEM_INTERNAL_MPI_SAMPLE_CELLS_H
#define CGAL_TANDEM_INTERNAL_MPI_SAMPLE_CELLS_H

#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>
#include <CGAL/Tandem/internal/mpi/octants.h>

#include <CGAL/Tandem/internal/base/tuning/cloud.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// Around the points of all ranks.
inline Code_frame make_common_frame(Communicator& communicator, const Host_buffer<Grid_point>& point)
{
  Box box;
  for(const Grid_point& p : point)
    box.add(p);
  communicator.minimize(box.low, 3);
  communicator.maximize(box.high, 3);
  return make_code_frame({box.low[0], box.low[1], box.low[2], 0}, {box.high[0], box.high[1], box.high[2], 0});
}

template <class Local>
std::vector<Grid_point> sample_cells(Mpi_backend<Local>& backend, const Host_buffer<Grid_point>& point)
{
  using namespace tuning::estimation;
  Communicator& communicator = backend.communicator();
  const Code_frame frame = make_common_frame(communicator, point);
  Host_sort_table sorted(point.size());
  backend.for_each(point.size(), Write_codes<Host_sort_table::View>{point.data(), frame, sorted.view()});
  backend.sort(sorted);
  const std::vector<Octant> leaves = find_leaves(communicator, sorted, frame, sampled_cell_size);
  std::uint64_t total = 0;
  for(const Octant& leaf : leaves)
    total += leaf.total;
  const std::uint64_t stride = (total + sampled_points - 1) / sampled_points;

  // Leaves of which a cell is in the sample. A leaf of several cells is cut when all of its points are here.
  struct Chosen {
    std::uint64_t first_cell, total;
  };
  std::vector<Chosen> chosen;
  std::vector<Grid_point> own;
  std::uint64_t cell = 0;
  for(const Octant& leaf : leaves) {
    const std::uint64_t end = cell + leaf.number_of_cells(sampled_cell_size);
    if((cell + stride - 1) / stride * stride < end) {
      chosen.push_back({cell, leaf.total});
      for(std::uint32_t i = leaf.own.first; i < leaf.own.last; ++i)
        own.push_back(point[sorted.view().index(i)]);
    }
    cell = end;
  }
  const std::vector<Grid_point> all = communicator.gather(own);
  const auto order = sort_along_curve(static_cast<Local&>(backend), all.data(), all.size(), frame);
  std::vector<Grid_point> sample;
  std::size_t first = 0;
  for(const Chosen& leaf : chosen) {
    for(std::uint64_t i = 0; i < leaf.total; ++i)
      if((leaf.first_cell + i / sampled_cell_size) % stride == 0)
        sample.push_back(all[order.view().index(first + i)]);
    first += leaf.total;
  }
  return sample;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_SAMPLE_CELLS_H
