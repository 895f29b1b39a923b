// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of boxes over consecutive points of the sorted cloud. It has no
// pointers: node m of level l covers the leaves [m 8^l, (m + 1) 8^l), and a leaf
// is eight points.

#ifndef CGAL_TANDEM_INTERNAL_BOX_TREE_H
#define CGAL_TANDEM_INTERNAL_BOX_TREE_H

#include <CGAL/Tandem/internal/types.h>

#include <algorithm>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr std::uint32_t leaf_bits = 3;
constexpr std::uint32_t leaf_size = 1u << leaf_bits;
constexpr std::uint32_t branch_bits = 3;
constexpr std::uint32_t branching = 1u << branch_bits;
constexpr int maximum_levels = 1 + (32 - leaf_bits + branch_bits - 1) / branch_bits;

// The coordinates of eight points; the last leaf repeats its last point.
struct Point_leaf {
  std::int32_t x[leaf_size], y[leaf_size], z[leaf_size];
};

struct Node_box {
  std::int32_t low[3], high[3];
};

inline Node_box joined(const Node_box& a, const Node_box& b)
{
  Node_box r;
  for(int i = 0; i < 3; ++i) {
    r.low[i] = (std::min)(a.low[i], b.low[i]);
    r.high[i] = (std::max)(a.high[i], b.high[i]);
  }
  return r;
}

inline Node_box box_of(const std::int32_t (&c)[3]) { return {{c[0], c[1], c[2]}, {c[0], c[1], c[2]}}; }

// Exact: the sides are at most 2^30 steps, the sum is below 2^62.
inline std::uint64_t squared_distance(const Node_box& a, const Node_box& b)
{
  std::uint64_t sum = 0;
  for(int i = 0; i < 3; ++i) {
    const std::int64_t gap = (std::max)(a.low[i] - b.high[i], b.low[i] - a.high[i]);
    sum += gap > 0 ? std::uint64_t(gap * gap) : 0;
  }
  return sum;
}

inline std::uint64_t squared_diagonal(const Node_box& a)
{
  std::uint64_t sum = 0;
  for(int i = 0; i < 3; ++i) {
    const std::int64_t side = std::int64_t(a.high[i]) - a.low[i];
    sum += std::uint64_t(side * side);
  }
  return sum;
}

template <class Backend>
class Box_tree {
public:
  Box_tree(Backend& backend, const Grid_point* point, std::uint32_t n) : size_(n)
  {
    std::size_t nodes = 0;
    std::uint32_t count = (n + (leaf_size - 1)) / leaf_size;
    for(levels_ = 0; levels_ == 0 || count > 1; ++levels_) {
      if(levels_ > 0)
        count = (count + (branching - 1)) / branching;
      begin_[levels_] = nodes;
      count_[levels_] = count;
      nodes += count;
    }
    leaf_.reset(count_[0]);
    box_.reset(nodes);
    backend.for_each(count_[0], [this, point](std::size_t i) { fill_leaf(point, std::uint32_t(i)); });
    for(int level = 1; level < levels_; ++level)
      backend.for_each(count_[level], [this, level](std::size_t i) { join_children(level, std::uint32_t(i)); });
  }

  std::uint32_t size() const { return size_; }
  int levels() const { return levels_; }
  std::uint32_t count(int level) const { return count_[level]; }
  const Node_box& box(int level, std::uint32_t node) const { return box_.data()[begin_[level] + node]; }
  const Point_leaf& leaf(std::uint32_t i) const { return leaf_.data()[i]; }
  std::uint32_t points_in_leaf(std::uint32_t i) const { return (std::min)(leaf_size, size_ - i * leaf_size); }

private:
  void fill_leaf(const Grid_point* point, std::uint32_t i)
  {
    Point_leaf& leaf = leaf_[i];
    const std::uint32_t last = points_in_leaf(i) - 1;
    Node_box box = box_of({point[i * leaf_size].x, point[i * leaf_size].y, point[i * leaf_size].z});
    for(std::uint32_t j = 0; j < leaf_size; ++j) {
      const Grid_point& p = point[i * leaf_size + (std::min)(j, last)];
      leaf.x[j] = p.x;
      leaf.y[j] = p.y;
      leaf.z[j] = p.z;
      box = joined(box, box_of({p.x, p.y, p.z}));
    }
    box_[begin_[0] + i] = box;
  }

  void join_children(int level, std::uint32_t i)
  {
    const std::uint32_t first = i * branching;
    const std::uint32_t last = (std::min)(first + branching, count_[level - 1]);
    Node_box b = box(level - 1, first);
    for(std::uint32_t child = first + 1; child < last; ++child)
      b = joined(b, box(level - 1, child));
    box_[begin_[level] + i] = b;
  }

  std::uint32_t size_;
  int levels_ = 0;
  std::size_t begin_[maximum_levels];
  std::uint32_t count_[maximum_levels];
  typename Backend::template Buffer<Point_leaf> leaf_;
  typename Backend::template Buffer<Node_box> box_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_BOX_TREE_H
