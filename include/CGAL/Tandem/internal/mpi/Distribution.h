// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which rank has which points: consecutive leaves of the octree, with about as many points on each rank. Points of the
// caller go to the rank of their leaf, with coordinates and normals; what is found of them comes back.

#ifndef CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H
#define CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H

#include <CGAL/Tandem/internal/cloud/Import.h>
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
  Code_frame frame;
  std::uint64_t* code;

  void operator()(std::size_t i) const
  {
    code[i] = frame.code(to_grid(grid.grid, grid.inverse_step, grid.coordinates[i], no_normal));
  }
};

class Distribution {
public:
  // Decides from the points of all ranks, of which the grid is chosen.
  template <class Local>
  Distribution(Mpi_backend<Local>& backend, const Import& in, std::size_t cell_size)
    : communicator_(backend.communicator()), sent_(std::size_t(communicator_.size())), size_(in.size())
  {
    Host_buffer<std::uint64_t> code(in.size());
    backend.for_each(in.size(), Write_code{place_on_grid(in, nullptr), make_code_frame(in.low, in.high), code.data()});
    const std::vector<std::uint64_t> begin = Boundary_search(communicator_, make_code_frame(in.low, in.high), cell_size,
                                                             in.total.points)(code.data(), in.size());
    for(std::size_t i = 0; i < in.size(); ++i)
      sent_[std::size_t(std::upper_bound(begin.begin(), begin.end(), code[i]) - begin.begin() - 1)].push_back(
        std::uint32_t(i));
  }

  // Sends the values to the ranks of their leaves. There they have the order of the ranks they come from, and of their
  // imports: ties of exact duplicates are broken as in one process that has the imports one after the other.
  Import distribute(const Import& in) const
  {
    Import own;
    own.has_normals = in.has_normals;
    own.box = in.box;
    own.grid = in.grid;
    own.low = in.low;
    own.high = in.high;
    own.total = in.total;
    own.count = own.number_of_items = send_values(in.coordinates, own.coordinates);
    if(in.has_normals)
      send_values(in.normals, own.normals);
    return own;
  }

  // Sends a value of each imported point to where distribute() sends the point.
  template <class T>
  std::vector<T> distribute(const std::vector<T>& values) const
  {
    std::vector<std::vector<T>> send(sent_.size());
    for(std::size_t r = 0; r < sent_.size(); ++r)
      for(const std::uint32_t i : sent_[r])
        send[r].push_back(values[i]);
    std::vector<T> all;
    for(const std::vector<T>& part : communicator_.exchange(send))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  // Brings back what was found for each point of distribute(), in its order; the result has the order of the import.
  template <class T>
  Host_buffer<T> collect(const Shared_table<T>& found) const
  {
    std::vector<std::vector<T>> back(sent_.size());
    std::size_t first = 0;
    for(std::size_t r = 0; r < sent_.size(); ++r) {
      back[r].assign(found.begin() + first, found.begin() + first + received_[r]);
      first += received_[r];
    }
    const std::vector<std::vector<T>> values = communicator_.exchange(back);
    Host_buffer<T> result(size_);
    for(std::size_t r = 0; r < sent_.size(); ++r)
      for(std::size_t i = 0; i < sent_[r].size(); ++i)
        result[sent_[r][i]] = values[r][i];
    return result;
  }

private:
  // A rank without points does not know the type.
  std::size_t send_values(const Vector_table& from, Vector_table& to) const
  {
    int is_double = size_ > 0 && !from.view().is_float;
    communicator_.maximize(&is_double, 1);
    return is_double ? send_as<double>(from, to) : send_as<float>(from, to);
  }

  template <class T>
  std::size_t send_as(const Vector_table& from, Vector_table& to) const
  {
    using Value = std::array<T, 3>;
    const Value* const values = reinterpret_cast<const Value*>(from.view().data);
    std::vector<Value> send;
    send.reserve(size_);
    std::vector<std::size_t> sizes;
    for(const std::vector<std::uint32_t>& to_rank : sent_) {
      for(const std::uint32_t i : to_rank)
        send.push_back(values[i]);
      sizes.push_back(to_rank.size());
    }
    const std::vector<Value> received = communicator_.exchange(send, sizes, &received_);
    const std::size_t total = received.size();
    if(total > maximum_number_of_points)
      throw std::length_error("a rank would get " + to_text(total) + " points, at most " +
                              to_text(maximum_number_of_points) + " (2^31) can be handled: use more ranks");
    to.reset<T>(total);
    std::copy_n(reinterpret_cast<const T*>(received.data()), 3 * total, to.data<T>());
    return total;
  }

  Communicator& communicator_;
  std::vector<std::vector<std::uint32_t>> sent_; // by rank: imported points, ascending
  std::size_t size_;                             // of the import
  mutable std::vector<std::size_t> received_;    // points from each rank
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H
