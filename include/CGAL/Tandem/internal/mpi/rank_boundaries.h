// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the ranks begin along the curve: with a leaf of the octree, so that each has about as many points. Only the
// octants around a boundary are counted.

#ifndef CGAL_TANDEM_INTERNAL_MPI_RANK_BOUNDARIES_H
#define CGAL_TANDEM_INTERNAL_MPI_RANK_BOUNDARIES_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/cloud/cells.h>
#include <CGAL/Tandem/internal/mpi/messages/Communicator.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_RANK_BOUNDARIES_H
