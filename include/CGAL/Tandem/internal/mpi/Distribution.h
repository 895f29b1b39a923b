// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which rank has which points: consecutive leaves of the octree, with about as many points on each rank. Points of the
// caller go to the rank of their leaf, with coordinates and normals; what is found of them comes back.

#ifndef CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H
#define CGAL_TANDEM_INTERNAL_MPI_DISTRIBUTION_H

#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>
#include <CGAL/Tandem/internal/mpi/octants.h>

#include <array>

namespace CGAL {
namespace Tandem {
namespace internal {

class Distribution {
public:
  // Decides from the points of all ranks, of which the grid is chosen.
  template <class Local>
  Distribution(Mpi_backend<Local>& backend, const Import& in, std::size_t cell_size)
    : communicator_(backend.communicator()), sent_(std::size_t(communicator_.size())), size_(in.size())
  {
    std::vector<int> rank_of(in.size());
    {
      Host_buffer<Grid_point> point(in.size());
      backend.for_each(in.size(), place_on_grid(in, point.data()));
      const Code_frame frame = make_code_frame(in.low, in.high);
      Host_sort_table sorted(in.size());
      backend.for_each(in.size(), Write_codes<Host_sort_table::View>{point.data(), frame, sorted.view()});
      backend.sort(sorted);
      std::uint64_t first = 0;
      for(const Octant& leaf : find_leaves(communicator_, sorted, frame, cell_size)) {
        for(std::uint32_t i = leaf.own.first; i < leaf.own.last; ++i)
          rank_of[sorted.view().index(i)] = rank_of_leaf(first, leaf, in.total.points);
        first += leaf.total;
      }
    }
    for(std::size_t i = 0; i < in.size(); ++i)
      sent_[std::size_t(rank_of[i])].push_back(std::uint32_t(i));
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
  // The middle point of a leaf decides, so that ranks ascend with leaves.
  int rank_of_leaf(std::uint64_t first, const Octant& leaf, std::uint64_t total) const
  {
    return int(Int128(first + leaf.total / 2) * communicator_.size() / Int128(total));
  }

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
    std::vector<std::vector<Value>> send(sent_.size());
    const Value* const values = reinterpret_cast<const Value*>(from.view().data);
    for(std::size_t r = 0; r < sent_.size(); ++r)
      for(const std::uint32_t i : sent_[r])
        send[r].push_back(values[i]);
    const std::vector<std::vector<Value>> received = communicator_.exchange(send);
    send.clear();
    received_.clear();
    std::size_t total = 0;
    for(const std::vector<Value>& part : received) {
      received_.push_back(part.size());
      total += part.size();
    }
    if(total > maximum_number_of_points)
      throw std::length_error("a rank would get " + to_text(total) + " points, at most " +
                              to_text(maximum_number_of_points) + " (2^31) can be handled: use more ranks");
    to.reset<T>(total);
    T* out = to.data<T>();
    for(const std::vector<Value>& part : received)
      out = std::copy_n(reinterpret_cast<const T*>(part.data()), 3 * part.size(), out);
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
