// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of boxes over consecutive points of the sorted cloud. A bucket is eight points. There are no pointers: node m
// of level l covers the buckets [m 8^l, (m + 1) 8^l). Points along the curve are compact, so boxes are small without
// any choice of splits. It is built once for the neighbor search on the host, in linear time, and not changed.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_BOX_TREE_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_BOX_TREE_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/neighbors/Float8.h>
#include <CGAL/Tandem/internal/base/types.h>

#include <algorithm>

namespace CGAL::Tandem::internal {

// Eight points or boxes fill a Float8, so a bucket or the children of a node are tested at once.
constexpr std::uint32_t bucket_bits = 3;
constexpr std::uint32_t bucket_size = 1u << bucket_bits;
constexpr std::uint32_t branch_bits = 3;
constexpr std::uint32_t branching = 1u << branch_bits;
// Levels that are enough for 2^32 points. Level 0 are the buckets.
constexpr int maximum_levels = 1 + (32 - bucket_bits + branch_bits - 1) / branch_bits;

// The coordinates of eight points, by axis for loads of Float8. The last bucket repeats its last point.
struct Point_bucket {
  std::int32_t x[bucket_size], y[bucket_size], z[bucket_size];
};

// Corners in grid steps; both belong to the box. Unlike Box it is never empty.
struct Node_box {
  std::int32_t low[3], high[3];
};

// The boxes of eight siblings, by axis. Where there are fewer, the last one is repeated.
struct Sibling_boxes {
  std::int32_t low[3][branching], high[3][branching];
};

// The smallest box around both.
inline Node_box joined(const Node_box& a, const Node_box& b)
{
  Node_box r;
  for(int i = 0; i < 3; ++i) {
    r.low[i] = (std::min)(a.low[i], b.low[i]);
    r.high[i] = (std::max)(a.high[i], b.high[i]);
  }
  return r;
}

// The squared distance between the nearest points of two boxes; 0 if they overlap. Exact: gaps are at most 2^30 steps,
// the sum is below 2^62.
inline std::uint64_t squared_distance(const Node_box& a, const Node_box& b)
{
  std::uint64_t sum = 0;
  for(int i = 0; i < 3; ++i) {
    const std::int64_t gap = (std::max)(a.low[i] - b.high[i], b.low[i] - a.high[i]);
    sum += gap > 0 ? std::uint64_t(gap * gap) : 0;
  }
  return sum;
}

// The squared length of the diagonal. Exact: its widths have at most 2^30 steps.
inline std::uint64_t squared_diagonal(const Node_box& a)
{
  std::uint64_t sum = 0;
  for(int i = 0; i < 3; ++i) {
    const std::int64_t width = std::int64_t(a.high[i]) - a.low[i];
    sum += std::uint64_t(width * width);
  }
  return sum;
}

// The squared distances from a to each of the siblings, in float, rounded by a factor of at most 1 + 6u, u = 2^-24,
// however far apart the boxes are.
inline Float8 squared_distance8(const Sibling_boxes& b, const Node_box& a)
{
  Float8 gap[3];
  for(int i = 0; i < 3; ++i) {
    const Float8 below = difference8(b.low[i], a.high[i]);
    const Float8 above = fill8(0) - difference8(b.high[i], a.low[i]);
    gap[i] = max8(max8(below, above), fill8(0));
  }
  return squared_length8(gap[0], gap[1], gap[2]);
}

// Levels are stored one after the other, bottom up, in blocks of eight siblings. Memory: 12 bytes a point for the
// buckets, 3.5 for the boxes.
template <class Backend>
class Box_tree {
public:
  // Items of a level are independent; a level needs only the one below it.
  Box_tree(Backend& backend, const Grid_point* point, std::uint32_t n) : size_(n)
  {
    std::size_t blocks = 0;
    std::uint32_t count = n / bucket_size + (n % bucket_size != 0);
    for(levels_ = 0; levels_ == 0 || count > 1; ++levels_) {
      if(levels_ > 0)
        count = parents(count);
      begin_[levels_] = blocks;
      count_[levels_] = count;
      blocks += parents(count);
    }
    bucket_.reset(count_[0]);
    siblings_.reset(blocks);
    backend.for_each(parents(count_[0]), [this, point](std::size_t i) { fill_buckets(point, std::uint32_t(i)); });
    for(int level = 1; level < levels_; ++level)
      backend.for_each(parents(count_[level]),
                       [this, level](std::size_t i) { join_children(level, std::uint32_t(i)); });
  }

  std::uint32_t size() const { return size_; }
  int levels() const { return levels_; }
  std::uint32_t count(int level) const { return count_[level]; }
  const Sibling_boxes& siblings(int level, std::uint32_t parent) const
  {
    return siblings_.data()[begin_[level] + parent];
  }
  const Point_bucket* buckets() const { return bucket_.data(); }
  std::uint32_t points_in_bucket(std::uint32_t i) const { return (std::min)(bucket_size, size_ - i * bucket_size); }

  // The position of the first point below a node.
  static std::uint32_t first_point(int level, std::uint32_t node)
  {
    return node << (bucket_bits + branch_bits * std::uint32_t(level));
  }

  // The box of one node; searches mostly read eight at once.
  Node_box box(int level, std::uint32_t node) const
  {
    const Sibling_boxes& s = siblings(level, node / branching);
    const std::uint32_t i = node % branching;
    return {{s.low[0][i], s.low[1][i], s.low[2][i]}, {s.high[0][i], s.high[1][i], s.high[2][i]}};
  }

private:
  static std::uint32_t parents(std::uint32_t count) { return count / branching + (count % branching != 0); }

  // Stores box(i) for each of the siblings below `parent`.
  template <class Get_box>
  void fill_siblings(int level, std::uint32_t parent, Get_box box)
  {
    Sibling_boxes& s = siblings_[begin_[level] + parent];
    const std::uint32_t last = count_[level] - 1;
    for(std::uint32_t i = 0; i < branching; ++i) {
      const Node_box b = box((std::min)(parent * branching + i, last));
      for(int axis = 0; axis < 3; ++axis) {
        s.low[axis][i] = b.low[axis];
        s.high[axis][i] = b.high[axis];
      }
    }
  }

  void fill_buckets(const Grid_point* point, std::uint32_t parent)
  {
    fill_siblings(0, parent, [this, point](std::uint32_t i) { return fill_bucket(point, i); });
  }

  // Copies the points of a bucket and returns its box.
  Node_box fill_bucket(const Grid_point* point, std::uint32_t i)
  {
    Point_bucket& bucket = bucket_[i];
    const Grid_point* first = point + std::size_t(i) * bucket_size;
    const std::uint32_t last = points_in_bucket(i) - 1;
    Node_box box = {{first->x, first->y, first->z}, {first->x, first->y, first->z}};
    for(std::uint32_t j = 0; j < bucket_size; ++j) {
      const Grid_point& p = first[(std::min)(j, last)];
      bucket.x[j] = p.x;
      bucket.y[j] = p.y;
      bucket.z[j] = p.z;
      box = joined(box, {{p.x, p.y, p.z}, {p.x, p.y, p.z}});
    }
    return box;
  }

  // Boxes of a level from those of the level below.
  void join_children(int level, std::uint32_t parent)
  {
    fill_siblings(level, parent, [this, level](std::uint32_t node) {
      Node_box b = box(level - 1, node * branching);
      for(std::uint32_t i = 1; i < branching; ++i)
        b = joined(b, box(level - 1, (std::min)(node * branching + i, count_[level - 1] - 1)));
      return b;
    });
  }

  std::uint32_t size_;
  int levels_ = 0;
  std::size_t begin_[maximum_levels];   // first block of siblings, by level
  std::uint32_t count_[maximum_levels]; // nodes, by level
  Buffer_of<Backend, Point_bucket> bucket_;
  Buffer_of<Backend, Sibling_boxes> siblings_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_BOX_TREE_H
