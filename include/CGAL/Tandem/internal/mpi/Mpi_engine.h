// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine over many processes: points go to the ranks of their leaves, the engine runs there, and labels come back.

#ifndef CGAL_TANDEM_INTERNAL_MPI_MPI_ENGINE_H
#define CGAL_TANDEM_INTERNAL_MPI_MPI_ENGINE_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/cloud/cells.h>
#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/engine/first_unconnected.h>
#include <CGAL/Tandem/internal/mpi/Mpi_backend.h>
#include <CGAL/Tandem/internal/mpi/Mpi_ranks.h>
#include <CGAL/Tandem/internal/mpi/messages/Communicator.h>
#include <CGAL/Tandem/internal/mpi/mpi_api.h>
#include <CGAL/Tandem/internal/result/group_points.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Which rank has which points: consecutive leaves of the octree, with about as many points on each rank. Points of the
// caller go to the rank of their leaf, with coordinates and normals; what is found of them comes back.

// Where the ranks begin along the curve: with a leaf of the octree, so that each has about as many points. Only the
// octants around a boundary are counted.

// The octants of one level of the octree, with the number of points of all ranks in each.
constexpr int counted_level = 6;

inline std::vector<std::uint64_t> count_level(Communicator& communicator, const std::uint64_t* code, std::size_t n)
{
  std::vector<std::uint64_t> count(std::size_t(1) << 3 * counted_level, 0);
  for(std::size_t i = 0; i < n; ++i)
    ++count[code[i] >> 3 * (curve_bits - counted_level)];
  communicator.sum(count.data(), count.size());
  return count;
}

// The leaf around a position in the sorted cloud of all ranks.
struct Boundary_leaf {
  std::uint64_t code = 0;  // of its first finest octant
  std::uint64_t first = 0; // position of its first point
  std::uint64_t total = 0; // points
  int level = 0;
  bool is_leaf = false;

  std::uint64_t end() const { return code + (std::uint64_t(1) << 3 * (curve_bits - level)); }

  // Becomes the child around the position. count: of the eight children.
  void enter(std::uint64_t position, const std::uint64_t* count)
  {
    ++level;
    const std::uint64_t width = std::uint64_t(1) << 3 * (curve_bits - level);
    int child = 0;
    for(; child < 7 && first + count[child] <= position; ++child)
      first += count[child];
    code += std::uint64_t(child) * width;
    total = count[child];
  }
};

class Boundary_search {
public:
  Boundary_search(Communicator& communicator, const Code_frame& frame, std::size_t cell_size, std::uint64_t total)
    : communicator_(communicator), frame_(frame), cell_size_(cell_size), total_(total)
  {}

  // By rank: the first code. Ranks whose part is within the leaf of another one have the same code as the next one.
  std::vector<std::uint64_t> operator()(const std::uint64_t* code, std::size_t n)
  {
    leaf_.assign(std::size_t(communicator_.size()), Boundary_leaf());
    for(Boundary_leaf& leaf : leaf_)
      leaf.total = total_;
    enter_counted_levels(count_level(communicator_, code, n));
    std::vector<std::uint64_t> near; // the codes in the octants that are not leaves
    std::copy_if(code, code + n, std::back_inserter(near), [&](std::uint64_t c) { return is_open(c); });
    std::sort(near.begin(), near.end());
    while(!close_leaves())
      enter_children(near);
    std::vector<std::uint64_t> begin;
    for(std::size_t r = 0; r < leaf_.size(); ++r) {
      // The middle of a leaf decides on which side of the boundary it is.
      const bool is_before = leaf_[r].first + leaf_[r].total / 2 < position(r);
      begin.push_back(r == 0 ? 0 : is_before ? leaf_[r].end() : leaf_[r].code);
    }
    return begin;
  }

private:
  std::uint64_t position(std::size_t r) const
  {
    return std::uint64_t(Int128(total_) * std::int64_t(r) / std::int64_t(leaf_.size()));
  }

  bool is_leaf(const Boundary_leaf& leaf) const
  {
    return internal::is_leaf(frame_, leaf.level, leaf.total, cell_size_);
  }

  // Whether all are leaves.
  bool close_leaves()
  {
    bool are_leaves = true;
    for(Boundary_leaf& leaf : leaf_) {
      leaf.is_leaf = is_leaf(leaf);
      are_leaves = are_leaves && leaf.is_leaf;
    }
    return are_leaves;
  }

  bool is_open(std::uint64_t code) const
  {
    // The octants ascend with the ranks.
    const auto it = std::upper_bound(leaf_.begin(), leaf_.end(), code,
                                     [](std::uint64_t c, const Boundary_leaf& leaf) { return c < leaf.end(); });
    return it != leaf_.end() && it->code <= code && !is_leaf(*it);
  }

  void enter_counted_levels(std::vector<std::uint64_t> count)
  {
    std::vector<std::vector<std::uint64_t>> levels = {std::move(count)};
    while(levels.back().size() > 8) {
      std::vector<std::uint64_t> parents(levels.back().size() / 8, 0);
      for(std::size_t i = 0; i < levels.back().size(); ++i)
        parents[i / 8] += levels.back()[i];
      levels.push_back(std::move(parents));
    }
    for(std::size_t level = levels.size(); level-- > 0 && !close_leaves();)
      for(std::size_t r = 0; r < leaf_.size(); ++r)
        if(!leaf_[r].is_leaf) {
          const int bits = 3 * (curve_bits - leaf_[r].level - 1);
          leaf_[r].enter(position(r), levels[level].data() + (leaf_[r].code >> bits));
        }
  }

  void enter_children(const std::vector<std::uint64_t>& near)
  {
    std::vector<std::uint64_t> count;
    for(const Boundary_leaf& leaf : leaf_) {
      const std::uint64_t width = std::uint64_t(1) << 3 * (curve_bits - leaf.level) >> 3;
      auto first = std::lower_bound(near.begin(), near.end(), leaf.code);
      for(std::uint64_t child = 1; child <= 8; ++child) {
        const auto last = std::lower_bound(first, near.end(), leaf.code + child * width);
        count.push_back(leaf.is_leaf ? 0 : std::uint64_t(last - first));
        first = last;
      }
    }
    communicator_.sum(count.data(), count.size());
    for(std::size_t r = 0; r < leaf_.size(); ++r)
      if(!leaf_[r].is_leaf)
        leaf_[r].enter(position(r), count.data() + 8 * r);
  }

  Communicator& communicator_;
  Code_frame frame_;
  std::size_t cell_size_;
  std::uint64_t total_;
  std::vector<Boundary_leaf> leaf_; // by rank
};

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

// --- The engine.

// Each function is called by all ranks.
template <class Local>
class Mpi_engine : public Detection_engine {
  using Backend = Mpi_backend<Local>;
  using Host = Mpi_backend<Search_host<Local>>;

public:
  Mpi_engine(Host& host, Import& in, const Parameters& parameters, Progress& progress)
    : host_(host), distribution_(host_, in, parameters.cell_size), in_(take(distribution_, in)),
      backend_(host.shared_communicator()), engine_(backend_, in_, parameters, progress)
  {}

  const char* name() const override { return engine_.name(); }
  bool iterate() override { return engine_.iterate(); }
  void finish() override { engine_.finish(); }

  Engine_result result() override
  {
    Engine_result r = engine_.result();
    if(host_.communicator().sum(std::uint64_t(r.shape_of.size())) == 0)
      return r; // cancelled before the first round
    r.shape_of = distribution_.collect(r.shape_of);
    if(!in_.has_normals)
      r.normal = distribution_.collect(r.normal);
    r.points = group_points(host_, r.shape_of.data(), r.shape_of.size(), r.shapes.size());
    return r;
  }

private:
  // The caller's import keeps its numbers of points.
  static Import take(Distribution<Search_host<Local>>& distribution, Import& in)
  {
    Import own = distribution.distribute(in);
    in.coordinates = Vector_table();
    in.normals = Vector_table();
    return own;
  }

  Host& host_;
  Distribution<Search_host<Local>> distribution_;
  Import in_; // the points of this rank
  Backend backend_;
  Engine<Backend> engine_;
};

template <class Local>
std::unique_ptr<Detection_engine> make_engine(Mpi_backend<Local>& backend, Import& in, const Parameters& parameters,
                                              Progress& progress)
{
  return std::make_unique<Mpi_engine<Local>>(backend, in, parameters, progress);
}

// Connectivity is checked on the points of each rank and their ghosts.
template <class Local>
std::size_t first_unconnected(Mpi_backend<Local>& backend, Import& in, const Labeled_points& result)
{
  if(in.total.points == 0)
    return result.shapes();
  Distribution<Local> distribution(backend, in, result.parameters.cell_size);
  Import own = distribution.distribute(in);
  Labeled_points of_own = {result.parameters, result.planes, {}, {}};
  of_own.shape = distribution.distribute_values([&](std::size_t i) { return result.shape[i]; });
  if(!in.has_normals)
    of_own.normal = distribution.distribute_values([&](std::size_t i) { return result.normal[i]; });
  return first_unconnected_here(backend, own, of_own);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MPI_MPI_ENGINE_H
