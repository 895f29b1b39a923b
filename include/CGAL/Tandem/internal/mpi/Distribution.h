// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which rank has which points: consecutive leaves of the octree, with about as many points on each rank. Points of the
// caller go to the rank of their leaf, with coordinates and normals; what is found of them comes back.

#ifndef CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H
#define CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H

#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/finish/group_points.h>
#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>
#include <CGAL/Tandem/internal/mpi/rank_boundaries.h>

#include <algorithm>
#include <array>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The code of an imported point.
struct Write_code {
  Place_on_grid grid;
  const Import& in;
  Code_frame frame;
  std::uint64_t* code;

  void operator()(std::size_t i) const
  {
    code[i] = frame.code(grid.at(i), in.has_tolerances ? level_of(in.tolerances[i], in.epsilon) : 0);
  }
};

template <class Host>
class Distribution {
public:
  // Decides from the points of all ranks, of which the grid is chosen.
  Distribution(Mpi_backend<Host>& backend, const Import& in, std::size_t cell_size)
    : backend_(backend), communicator_(backend.communicator())
  {
    const Code_frame frame = make_code_frame(in.low, in.high, in.surfel_cells);
    Host_buffer<std::uint64_t> code(in.size());
    backend_.for_each(in.size(), Write_code{place_on_grid(in, nullptr), in, frame, code.data()});
    const std::vector<std::uint64_t> begin =
      Boundary_search(communicator_, frame, cell_size, in.total.points)(code.data(), in.size());
    Host_buffer<std::int32_t> rank_of(in.size());
    backend_.for_each(in.size(), [&](std::size_t i) {
      rank_of[i] = std::int32_t(std::upper_bound(begin.begin(), begin.end(), code[i]) - begin.begin()) - 1;
    });
    const Point_groups groups = group_points(static_cast<Host&>(backend_), rank_of.data(), in.size(), begin.size());
    sent_ = groups.position;
    for(std::size_t r = 0; r < begin.size(); ++r)
      sizes_.push_back(groups.first[r + 1] - groups.first[r]);
  }

  // Sends the values to the ranks of their leaves. There they have the order of the ranks they come from, and of their
  // imports: ties of exact duplicates are broken as in one process that has the imports one after the other.
  Import distribute(const Import& in)
  {
    Import own;
    own.has_normals = in.has_normals;
    own.box = in.box;
    own.grid = in.grid;
    own.surfel_cells = in.surfel_cells;
    own.has_tolerances = in.has_tolerances;
    own.smallest_tolerance = in.smallest_tolerance;
    own.epsilon = in.epsilon;
    own.low = in.low;
    own.high = in.high;
    own.total = in.total;
    own.count = own.number_of_items = send_values(in.coordinates, own.coordinates);
    if(in.has_normals)
      send_values(in.normals, own.normals);
    if(in.has_tolerances)
      own.tolerances = distribute_values([&](std::size_t i) { return in.tolerances[i]; });
    return own;
  }

  // Sends value(i) of each imported point to where distribute() sends the point.
  template <class F>
  auto distribute_values(F value)
  {
    std::vector<decltype(value(std::size_t(0)))> send(sent_.size());
    backend_.for_each(send.size(), [&](std::size_t i) { send[i] = value(sent_[i]); });
    return communicator_.exchange(send, sizes_, &received_);
  }

  // Brings back what was found for each point of distribute(), in its order; the result has the order of the import.
  template <class T>
  Host_buffer<T> collect(const Shared_table<T>& found) const
  {
    const std::vector<T> values = communicator_.exchange(std::vector<T>(found.begin(), found.end()), received_, sizes_);
    Host_buffer<T> result(sent_.size());
    backend_.for_each(values.size(), [&](std::size_t i) { result[sent_[i]] = values[i]; });
    return result;
  }

private:
  // A rank without points does not know the type.
  std::size_t send_values(const Vector_table& from, Vector_table& to)
  {
    const std::uint32_t is_double = sent_.size() > 0 && !from.view().is_float;
    return communicator_.sum(is_double) > 0 ? send_as<double>(from, to) : send_as<float>(from, to);
  }

  template <class T>
  std::size_t send_as(const Vector_table& from, Vector_table& to)
  {
    const auto received = distribute_values([&](std::size_t i) {
      const Vector v = from[i];
      return std::array<T, 3>{T(v.x), T(v.y), T(v.z)};
    });
    const std::size_t total = received.size();
    if(total > maximum_number_of_points)
      throw std::length_error("a rank would get " + to_text(total) + " points, at most " +
                              to_text(maximum_number_of_points) + " (2^31) can be handled: use more ranks");
    to.reset<T>(total);
    T* const out = to.data<T>();
    backend_.for_each(total, [&](std::size_t i) { std::copy_n(received[i].data(), 3, out + 3 * i); });
    return total;
  }

  Mpi_backend<Host>& backend_;
  Communicator& communicator_;
  Shared_table<std::uint32_t> sent_;  // imported points, rank by rank, ascending ...
  std::vector<std::size_t> sizes_;    // ... and how many of them go to each rank
  std::vector<std::size_t> received_; // points from each rank
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H
