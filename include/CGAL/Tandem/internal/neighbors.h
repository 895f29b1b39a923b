// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact k nearest neighbors. The answer is defined without reference to this
// search, the k smallest (squared grid distance, index), so every back end may
// have a search of its own.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_H

#include <CGAL/Tandem/internal/Box_tree.h>
#include <CGAL/Tandem/internal/Float8.h>

namespace CGAL {
namespace Tandem {
namespace internal {

constexpr int maximum_k = 64;

__extension__ typedef unsigned __int128 Wide_key;

// Answers the points of one leaf together. A key is a squared distance in the
// upper bits and an index in the lower `shift` bits, so that one comparison
// decides by (distance, index). The narrow key of 64 bits serves leaves whose
// neighborhood is small enough, the wide one any leaf. K = 0: k is known at run time.
//
// Why the float filter loses nothing: a lane's coordinates relative to the origin
// are at most 2^22, hence exact; those of a candidate are exact up to 2^24, and
// beyond that are rounded by a factor 1 + u, u = 2^-24, while the difference
// from the lane is at least 3/4 of them. Differences are therefore exact up to a
// factor 1 + 3u, squares, products and sums make that less than 1 + 12u, and
// `reach` adds 2^-19 = 32u to the worst distance.
template <class Tree, class Key, int K>
class Leaf_search {
public:
  Leaf_search(const Tree& tree, int k, int shift) : tree_(tree), k_(k), shift_(shift) {}

  void operator()(std::uint32_t leaf, const Range& window, std::uint32_t* out)
  {
    leaf_ = leaf;
    window_ = window;
    const int lanes = int(tree_.points_in_leaf(leaf));
    for(int lane = 0; lane < lanes; ++lane)
      seed(lane);
    if(is_compact(lanes))
      search(0, lanes);
    else
      for(int lane = 0; lane < lanes; ++lane)
        search(lane, lane + 1);
    for(int lane = 0; lane < lanes; ++lane)
      for(int i = 0; i < k(); ++i)
        *out++ = std::uint32_t(key_[lane][i] & index_mask());
  }

private:
  struct Node {
    Key key;     // no point of the node has a smaller one
    std::uint32_t node;
    int level;
  };

  int k() const { return K > 0 ? K : k_; }
  Key index_mask() const { return (Key(1) << shift_) - 1; }
  const Point_leaf& own() const { return tree_.leaf(leaf_); }
  Key worst(int lane) const { return key_[lane][k() - 1]; }

  Key make_key(std::uint64_t squared_distance, std::uint32_t index) const
  {
    return Key(squared_distance) << shift_ | index;
  }

  // All points of the window, without a filter: most of them are neighbors.
  void seed(int lane)
  {
    for(int i = 0; i < k(); ++i)
      key_[lane][i] = ~Key(0);
    for(std::uint32_t leaf = window_.first; leaf < window_.last; ++leaf)
      for(std::uint32_t i = 0; i < tree_.points_in_leaf(leaf); ++i)
        if(leaf != leaf_ || int(i) != lane)
          offer(lane, leaf, int(i));
  }

  // Is the leaf small beside its neighborhood, and its coordinates exact in float?
  bool is_compact(int lanes) const
  {
    const Node_box& box = tree_.box(0, leaf_);
    const std::uint64_t squared = squared_diagonal(box);
    Key largest = 0;
    for(int lane = 0; lane < lanes; ++lane)
      largest = (std::max)(largest, worst(lane));
    return squared < (std::uint64_t(1) << 44) && Key(squared) / 16 < (largest >> shift_);
  }

  void search(int first, int last)
  {
    first_ = first;
    last_ = last;
    place_lanes();
    Node stack[maximum_levels * branching];
    int size = 0;
    if(tree_.levels() > 1) // else the window was everything
      stack[size++] = {0, 0, tree_.levels() - 1};
    while(size > 0) {
      const Node node = stack[--size];
      if(node.key >= worst_)
        continue;
      if(node.level == 0)
        scan(node.node);
      else
        size = expand(node, stack, size);
    }
  }

  void place_lanes()
  {
    const Point_leaf& p = own();
    query_ = box_of({p.x[first_], p.y[first_], p.z[first_]});
    for(int lane = first_ + 1; lane < last_; ++lane)
      query_ = joined(query_, box_of({p.x[lane], p.y[lane], p.z[lane]}));
    for(int axis = 0; axis < 3; ++axis)
      origin_[axis] = query_.low[axis];
    for(int lane = first_; lane < last_; ++lane) {
      x_[lane] = float(p.x[lane] - origin_[0]);
      y_[lane] = float(p.y[lane] - origin_[1]);
      z_[lane] = float(p.z[lane] - origin_[2]);
      update_reach(lane);
    }
    update_worst();
  }

  // The children nearer than the worst neighbor, nearest on top of the stack.
  int expand(const Node& parent, Node* stack, int size)
  {
    const int level = parent.level - 1;
    const std::uint32_t first = parent.node << branch_bits;
    const std::uint32_t last = (std::min)(first + branching, tree_.count(level));
    const int bottom = size;
    for(std::uint32_t child = first; child < last; ++child) {
      if(level == 0 && child >= window_.first && child < window_.last)
        continue;
      const std::uint64_t squared = squared_distance(query_, tree_.box(level, child));
      if(sizeof(Key) == 8 && squared >> (64 - shift_) != 0)
        continue;
      const Key key = make_key(squared, child << (leaf_bits + branch_bits * std::uint32_t(level)));
      if(key >= worst_)
        continue;
      int i = size++;
      for(; i > bottom && stack[i - 1].key < key; --i)
        stack[i] = stack[i - 1];
      stack[i] = {key, child, level};
    }
    return size;
  }

  void scan(std::uint32_t leaf)
  {
    const Point_leaf& p = tree_.leaf(leaf);
    const Float8 x = difference8(p.x, origin_[0]);
    const Float8 y = difference8(p.y, origin_[1]);
    const Float8 z = difference8(p.z, origin_[2]);
    const unsigned valid = (1u << tree_.points_in_leaf(leaf)) - 1;
    for(int lane = first_; lane < last_; ++lane) {
      const Float8 squared = squared_length8(x - fill8(x_[lane]), y - fill8(y_[lane]), z - fill8(z_[lane]));
      for(unsigned near = less_equal8(squared, fill8(reach_[lane])) & valid; near != 0; near &= near - 1)
        if(offer(lane, leaf, __builtin_ctz(near)))
          update_reach(lane);
    }
    update_worst();
  }

  bool offer(int lane, std::uint32_t leaf, int i)
  {
    const Point_leaf &p = own(), &q = tree_.leaf(leaf);
    const std::int64_t dx = std::int64_t(p.x[lane]) - q.x[i];
    const std::int64_t dy = std::int64_t(p.y[lane]) - q.y[i];
    const std::int64_t dz = std::int64_t(p.z[lane]) - q.z[i];
    const Key key = make_key(std::uint64_t(dx * dx + dy * dy + dz * dz), leaf * leaf_size + std::uint32_t(i));
    if(key >= worst(lane))
      return false;
    insert(key_[lane], key);
    return true;
  }

  void insert(Key* keys, Key key)
  {
    int i = k() - 1;
    for(; i > 0 && keys[i - 1] > key; --i)
      keys[i] = keys[i - 1];
    keys[i] = key;
  }

  void update_reach(int lane) { reach_[lane] = float(worst(lane) >> shift_) * (1 + 0x1p-19f); }

  void update_worst()
  {
    worst_ = worst(first_);
    for(int lane = first_ + 1; lane < last_; ++lane)
      worst_ = (std::max)(worst_, worst(lane));
  }

  const Tree& tree_;
  const int k_, shift_;
  std::uint32_t leaf_ = 0;
  Range window_ = {0, 0};  // leaves that are scanned before the search
  int first_ = 0, last_ = 0; // lanes under search
  Node_box query_;
  std::int32_t origin_[3];
  Key worst_ = 0;
  float x_[leaf_size], y_[leaf_size], z_[leaf_size], reach_[leaf_size];
  Key key_[leaf_size][K > 0 ? K : maximum_k];
};

// Leaves around `leaf` with at least k other points, where there are as many.
template <class Tree>
Range seed_window(const Tree& tree, std::uint32_t leaf, int k)
{
  const std::uint32_t side = (std::uint32_t(k) + 2 * leaf_size) / (2 * leaf_size);
  Range r = {leaf > side ? leaf - side : 0, (std::min)(leaf + side + 1, tree.count(0))};
  r.first = r.last - r.first >= 2 * side + 1 ? r.first : (r.last > 2 * side + 1 ? r.last - (2 * side + 1) : 0);
  r.last = (std::min)(r.first + 2 * side + 1, tree.count(0));
  return r;
}

template <class Tree, int K>
class Find_leaf_neighbors {
public:
  Find_leaf_neighbors(const Tree& tree, int k, std::uint32_t* out) : tree_(tree), k_(k), out_(out)
  {
    while(index_bits_ < 32 && tree.size() >> index_bits_ != 0)
      ++index_bits_;
  }

  void operator()(std::size_t first, std::size_t last) const
  {
    Leaf_search<Tree, std::uint64_t, K> narrow(tree_, k_, index_bits_);
    Leaf_search<Tree, Wide_key, K> wide(tree_, k_, 32);
    for(std::uint32_t leaf = std::uint32_t(first); leaf < last; ++leaf) {
      std::uint32_t* out = out_ + std::size_t(leaf) * leaf_size * std::size_t(k_);
      const Range window = seed_window(tree_, leaf, k_);
      if(fits_narrow_key(window))
        narrow(leaf, window, out);
      else
        wide(leaf, window, out);
    }
  }

private:
  // k points of the window are nearer than its diagonal, so no farther point
  // becomes a candidate; one bit is left for the slack of the filter.
  bool fits_narrow_key(const Range& window) const
  {
    Node_box box = tree_.box(0, window.first);
    for(std::uint32_t leaf = window.first + 1; leaf < window.last; ++leaf)
      box = joined(box, tree_.box(0, leaf));
    const std::uint64_t points = std::uint64_t(window.size() - 1) * leaf_size + tree_.points_in_leaf(window.last - 1);
    return points > std::uint64_t(k_) && squared_diagonal(box) >> (63 - index_bits_) == 0;
  }

  const Tree& tree_;
  const int k_;
  std::uint32_t* const out_;
  int index_bits_ = 1;
};

// The k smallest (squared distance, index j), j != i, of each point i of the
// sorted cloud, ascending, in out[i k .. i k + k); no_index fills up where the
// cloud has fewer than k + 1 points. 1 <= k <= maximum_k.
template <class Backend>
void find_neighbors(Backend& backend, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* out)
{
  if(n == 0)
    return;
  using Tree = Box_tree<Backend>;
  const Tree tree(backend, point, n);
  constexpr std::size_t grain = 64;
  switch(k) {
  case 8: return backend.for_each_piece(tree.count(0), grain, Find_leaf_neighbors<Tree, 8>(tree, k, out));
  case 12: return backend.for_each_piece(tree.count(0), grain, Find_leaf_neighbors<Tree, 12>(tree, k, out));
  case 16: return backend.for_each_piece(tree.count(0), grain, Find_leaf_neighbors<Tree, 16>(tree, k, out));
  case 20: return backend.for_each_piece(tree.count(0), grain, Find_leaf_neighbors<Tree, 20>(tree, k, out));
  default: return backend.for_each_piece(tree.count(0), grain, Find_leaf_neighbors<Tree, 0>(tree, k, out));
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_H
