// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact k nearest neighbors: the k smallest pairs of squared grid distance and position. This definition does not
// depend on the search, so every back end may have its own. The one here is for hosts. Points of a bucket are searched
// together, in the box tree, and buckets are independent. It writes the table of neighbors, nothing else.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_FIND_NEIGHBORS_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_FIND_NEIGHBORS_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/neighbors/Bucket_neighbors.h>

#include <type_traits>

namespace CGAL {
namespace Tandem {
namespace internal {

// Searches for all points of one bucket together. They lie next to each other on the curve, so they have most
// candidates in common. A thread reuses its search for one bucket after the other. K: see Bucket_neighbors.
template <class Tree, int K>
class Bucket_search {
public:
  Bucket_search(const Tree& tree, int k)
    : tree_(tree), found_(tree.buckets(), k), window_radius_(std::uint32_t(k + 15) / 12)
  {}

  // Writes k positions for each point of the bucket, point after point.
  void operator()(std::uint32_t bucket, std::uint32_t* out)
  {
    const int queries = int(tree_.points_in_bucket(bucket));
    window_ = {bucket > window_radius_ ? bucket - window_radius_ : 0,
               (std::min)(bucket + window_radius_ + 1, tree_.count(0))};
    const std::uint64_t squared_width = squared_diagonal(tree_.box(0, bucket));
    if(squared_width < maximum_squared_width) {
      scan_window(bucket, 0, queries);
      // While the box is at most four times as wide as the reach of its points, one search is cheapest.
      if(float(squared_width) <= 16 * found_.limit()) {
        search(out);
        return;
      }
    }
    // An outlier is among the points. A search around all of them would find too many candidates.
    for(int query = 0; query < queries; ++query) {
      scan_window(bucket, query, query + 1);
      search(out + query * found_.k());
    }
  }

private:
  struct Node {
    float squared; // squared distance to the box of the queries
    std::uint32_t index;
    int level;
  };

  // The buckets before and after on the curve give a first bound, without a descent in the tree.
  void scan_window(std::uint32_t bucket, int first, int last)
  {
    found_.start(bucket, first, last);
    for(std::uint32_t i = window_.first; i < window_.last; ++i)
      found_.scan(i, tree_.points_in_bucket(i));
  }

  // Depth first, smallest positions first: of equally near points those are the neighbors. Nearest first would not be
  // faster, as the window has been scanned already.
  void search(std::uint32_t* out)
  {
    Node stack[maximum_levels * branching];
    int size = 0;
    stack[size++] = {0, 0, tree_.levels() - 1};
    while(size > 0) {
      const Node node = stack[--size];
      if(is_too_far(node))
        continue;
      if(node.level > 1)
        size = push_children(node, stack, size);
      else if(node.level == 1)
        scan_children(node);
      else
        scan(node.index);
    }
    found_.write(out);
  }

  // Whether no point below the node can be a neighbor of any query.
  bool is_too_far(const Node& n) const
  {
    return n.squared > found_.limit() ||
           (found_.is_reduced() &&
            !found_.may_contain_neighbor(tree_.box(n.level, n.index), tree_.first_point(n.level, n.index)));
  }

  // A mask of the children that are near enough, with the squared distances of all. Repeated children are masked out.
  unsigned near_children(const Node& parent, float* squared) const
  {
    const std::uint32_t count = (std::min)(branching, tree_.count(parent.level - 1) - parent.index * branching);
    const Float8 squared8 = squared_distance8(tree_.siblings(parent.level - 1, parent.index), found_.box());
    store8(squared, squared8);
    return less_equal8(squared8, fill8(found_.limit())) & ((1u << count) - 1);
  }

  // The first child comes to the top, to be searched next. Returns the size of the stack.
  int push_children(const Node& parent, Node* stack, int size) const
  {
    float squared[8];
    const unsigned near = near_children(parent, squared);
    for(int child = int(branching) - 1; child >= 0; --child)
      if(near >> child & 1u)
        stack[size++] = {squared[child], parent.index * branching + std::uint32_t(child), parent.level - 1};
    return size;
  }

  // Buckets are scanned at once: the limit may fall from one to the next.
  void scan_children(const Node& parent)
  {
    float squared[8];
    for(unsigned near = near_children(parent, squared); near != 0; near &= near - 1) {
      const int child = __builtin_ctz(near);
      const Node bucket = {squared[child], parent.index * branching + std::uint32_t(child), 0};
      if(!is_too_far(bucket))
        scan(bucket.index);
    }
  }

  // Skips the window, which has been scanned before.
  void scan(std::uint32_t bucket)
  {
    if(bucket < window_.first || bucket >= window_.last)
      found_.scan(bucket, tree_.points_in_bucket(bucket));
  }

  const Tree& tree_;
  Bucket_neighbors<K> found_;
  std::uint32_t window_radius_; // buckets to each side of the window's center
  Range window_ = {0, 0};
};

// Fills the rows of neighbors of the buckets [first, last), for one thread. Rows of different buckets do not overlap.
template <class Tree, int K>
class Find_bucket_neighbors {
public:
  Find_bucket_neighbors(const Tree& tree, int k, std::uint32_t* out) : tree_(tree), k_(k), out_(out) {}

  void operator()(std::size_t first, std::size_t last) const
  {
    Bucket_search<Tree, K> search(tree_, k_);
    for(std::size_t bucket = first; bucket < last; ++bucket)
      search(std::uint32_t(bucket), out_ + bucket * bucket_size * std::size_t(k_));
  }

private:
  const Tree& tree_;
  int k_;
  std::uint32_t* out_;
};

template <class Backend, int K>
void find_bucket_neighbors(Backend& backend, const Box_tree<Backend>& tree, int k, std::uint32_t* out)
{
  constexpr std::size_t grain = 64;
  backend.for_each_piece(tree.count(0), grain, Find_bucket_neighbors<Box_tree<Backend>, K>(tree, k, out));
}

// Writes the neighbors of each point i of the sorted cloud to the row out[i k], ... out[i k + k - 1]. They are the k
// smallest pairs (squared distance, j) with j != i, ascending. no_index fills up where the cloud has fewer than k + 1
// points. 1 <= k <= maximum_k.
template <class Backend>
void find_neighbors(Backend& backend, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* out)
{
  if(n == 0)
    return;
  if constexpr(Stage_overrides<Backend>::finds_neighbors)
    Stage_overrides<Backend>::find_neighbors(backend, point, n, k, out);
  else {
    static_assert(std::is_base_of<Host_memory, Backend>::value, "a device has to replace this stage");
    const Box_tree<Backend> tree(backend, point, n);
    switch(k) { // common numbers as constants: the compiler unrolls the insertion of keys
    case 8:
      return find_bucket_neighbors<Backend, 8>(backend, tree, k, out);
    case 12:
      return find_bucket_neighbors<Backend, 12>(backend, tree, k, out);
    case 16:
      return find_bucket_neighbors<Backend, 16>(backend, tree, k, out);
    case 20:
      return find_bucket_neighbors<Backend, 20>(backend, tree, k, out);
    default:
      return find_bucket_neighbors<Backend, 0>(backend, tree, k, out);
    }
  }
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_FIND_NEIGHBORS_H
