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
#include <CGAL/Tandem/internal/neighbors/Box_tree.h>
#include <CGAL/Tandem/internal/neighbors/Float8.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace CGAL::Tandem::internal {

// --- The nearest points found so far of up to eight query points, the queries, side by side. Distances are compared in
// float, with a margin. Where they differ by less than the margin, integers decide. So the result is exact.
//
// Why no neighbor is lost, with u = 2^-24. Float coordinates are relative to the box of the queries, which is narrower
// than 2^22. So those of queries are exact. Those of a candidate are exact within 2^24. Beyond, they are off by a
// factor 1 + u, and differences from a query are at least 3/4 of them. So differences are exact up to 1 + 3u, and
// squared distances up to 1 + 12u. A key is that plus one, with its lowest 8 bits replaced: off by 1 + 14u + 2^-15.
// This is less than a third of the margin of 1 + 2^-13. So keys a margin apart are in the right order. A point farther
// than the worst key and a margin is no neighbor.

// The largest k_neighbors; it bounds the tables of a search.
constexpr int maximum_k = 64;

// The widest bucket whose points may be queries of one search, in steps^2: see the bound of 2^22 above.
constexpr std::uint64_t maximum_squared_width = std::uint64_t(1) << 44;

// Keeps, for each query, the k + 2 smallest keys. The first belongs to the query itself. The last is that of the
// nearest point that is no neighbor: it shows whether the k-th is certain. Records are all candidates that came within
// reach of a query; a key holds the number of its record. In a Float8 of keys or records, element i belongs to query i.
// K = 0: k is known at run time only.
template <int K>
class Bucket_neighbors {
public:
  Bucket_neighbors(const Point_bucket* bucket, int k) : bucket_(bucket), k_(k) {}

  int k() const { return K > 0 ? K : k_; }

  // Begins a search: the points [first, last) of a bucket are the queries. Their box must be narrower than 2^22,
  // which is always true of one query.
  void start(std::uint32_t bucket, int first, int last)
  {
    own_ = bucket;
    first_ = first;
    last_ = last;
    size_ = 0;
    is_reduced_ = false;
    const Point_bucket& p = bucket_[bucket];
    box_ = box_of(p, first);
    for(int query = first + 1; query < last; ++query)
      box_ = joined(box_, box_of(p, query));
    x_ = difference8(p.x, box_.low[0]);
    y_ = difference8(p.y, box_.low[1]);
    z_ = difference8(p.z, box_.low[2]);
    for(int axis = 0; axis < 3; ++axis)
      width_[axis] = float(box_.high[axis] - box_.low[axis]);
    float key[8];
    for(int query = 0; query < 8; ++query)
      key[query] = query >= first && query < last ? unknown : -1; // no point is nearer than -1
    for(int i = 0; i < k() + 2; ++i)
      best_[i] = load8(key);
    update_reach();
    update_limit();
  }

  // The box of the queries.
  const Node_box& box() const { return box_; }

  // The largest reach of a query. Points and boxes with a larger squared distance to the box are too far. Infinite in
  // effect (2^100) until each query has k + 1 keys.
  float limit() const { return limit_; }

  // Once the records were full, boxes are tested in integers as well. This bounds the search among
  // any number of points at the same distance. The margin of the keys would admit them all.
  bool is_reduced() const { return is_reduced_; }
  bool may_contain_neighbor(const Node_box& node, std::uint32_t first_index) const
  {
    return Candidate{squared_distance(box_, node), first_index} < worst_;
  }

  // Compares the first `count` points of a bucket with all queries, and records those within reach of one.
  // Points too far from the box of the queries are skipped, eight at a time.
  void scan(std::uint32_t bucket, std::uint32_t count)
  {
    if(size_ + int(bucket_size) > capacity)
      reduce();
    const int before = size_;
    const Point_bucket& p = bucket_[bucket];
    float x[8], y[8], z[8];
    const Float8 x8 = difference8(p.x, box_.low[0]);
    const Float8 y8 = difference8(p.y, box_.low[1]);
    const Float8 z8 = difference8(p.z, box_.low[2]);
    store8(x, x8);
    store8(y, y8);
    store8(z, z8);
    const Float8 to_box = squared_length8(outside(x8, width_[0]), outside(y8, width_[1]), outside(z8, width_[2]));
    for(unsigned near = less_equal8(to_box, fill8(limit_)) & ((1u << count) - 1); near != 0; near &= near - 1) {
      const int i = __builtin_ctz(near);
      const Float8 squared = squared_length8(fill8(x[i]) - x_, fill8(y[i]) - y_, fill8(z[i]) - z_);
      if(less_equal8(squared, reach_) != 0)
        record(squared, bucket * bucket_size + std::uint32_t(i));
    }
    if(size_ > before)
      update_limit();
  }

  // Writes the neighbors: k positions a query, ascending by (squared distance, position). Certain orders come from the
  // keys, the others from a sort in integers.
  void write(std::uint32_t* out)
  {
    if(is_reduced_)
      reduce();
    const unsigned ambiguous = is_reduced_ ? 0xffu : ambiguous_queries();
    for(int query = first_; query < last_; ++query, out += k()) {
      if((ambiguous >> query & 1u) == 0)
        write_by_key(query, out);
      else if(is_reduced_)
        write_candidates(reduced_[query], k(), out);
      else
        write_exactly(query, out);
    }
  }

private:
  struct Candidate {
    std::uint64_t squared;
    std::uint32_t index;

    bool operator<(const Candidate& c) const
    {
      return squared < c.squared || (squared == c.squared && index < c.index);
    }
  };

  // A key holds the number of its record in its lowest bits, so there are at most 256 records.
  static constexpr int tag_bits = 8;
  static constexpr int capacity = 1 << tag_bits;
  static constexpr std::uint32_t tag_mask = std::uint32_t(capacity) - 1;
  static constexpr int maximum = K > 0 ? K : maximum_k;
  static constexpr float margin = 1 + 0x1p-13f;
  static constexpr float unknown = 0x1p100f; // instead of keys not found yet; far above 3 * 2^58

  static Node_box box_of(const Point_bucket& p, int i) { return {{p.x[i], p.y[i], p.z[i]}, {p.x[i], p.y[i], p.z[i]}}; }

  // By how much coordinates lie outside of [0, side].
  static Float8 outside(const Float8& c, float side) { return max8(max8(c - fill8(side), fill8(0) - c), fill8(0)); }

  // Adds a record, and inserts its keys into the sorted keys of all queries without a branch. One is added to squared
  // distances, because a tag would change a key near 0 by more than the margin.
  void record(const Float8& squared, std::uint32_t index)
  {
    Float8 key = tagged8(squared + fill8(1), std::uint32_t(size_), tag_mask);
    index_[size_] = index;
    store8(squared_[size_], squared);
    ++size_;
    const int size = k() + 2;
#ifndef __CUDACC__ // it warns, and a device has its own search
#pragma GCC unroll 32
#endif
    for(int i = 0; i < size; ++i) {
      const Float8 larger = max8(best_[i], key);
      best_[i] = min8(best_[i], key);
      key = larger;
    }
    update_reach();
  }

  // The squared distance that a neighbor of each query may have. The query itself is the first of the k + 1 nearest.
  void update_reach() { reach_ = best_[k()] * fill8(margin); }

  void update_limit()
  {
    float reach[8];
    store8(reach, reach_);
    limit_ = *std::max_element(reach, reach + 8);
  }

  // A mask of the queries with keys too close to each other to trust their order. Keys that were not found are among
  // them: the cloud has fewer than k + 1 points then.
  unsigned ambiguous_queries() const
  {
    unsigned queries = 0;
    for(int i = 0; i <= k(); ++i)
      queries |= less_equal8(best_[i + 1], best_[i] * fill8(margin));
    return queries;
  }

  // The numbers of the records are in the keys.
  void write_by_key(int query, std::uint32_t* out) const
  {
    for(int i = 0; i < k(); ++i) {
      std::uint32_t bits;
      std::memcpy(&bits, reinterpret_cast<const float*>(&best_[i + 1]) + query, sizeof bits);
      out[i] = index_[bits & tag_mask];
    }
  }

  void write_exactly(int query, std::uint32_t* out) const
  {
    Candidate found[capacity];
    const int n = collect(query, found);
    std::sort(found, found + n);
    write_candidates(found, n, out);
  }

  void write_candidates(const Candidate* sorted, int n, std::uint32_t* out) const
  {
    for(int i = 0; i < k(); ++i)
      out[i] = i < n ? sorted[i].index : no_index;
  }

  // The records that may be neighbors of the query, with exact distances and without the query itself.
  int collect(int query, Candidate* found) const
  {
    float reach[8];
    store8(reach, reach_);
    int n = 0;
    for(int i = 0; i < size_; ++i)
      if(squared_[i][query] <= reach[query] && index_[i] != own_ * bucket_size + std::uint32_t(query))
        found[n++] = exact(query, index_[i]);
    return n;
  }

  Candidate exact(int query, std::uint32_t index) const
  {
    const Point_bucket &p = bucket_[own_], &q = bucket_[index / bucket_size];
    const std::uint32_t i = index % bucket_size;
    const std::int64_t x = std::int64_t(p.x[query]) - q.x[i];
    const std::int64_t y = std::int64_t(p.y[query]) - q.y[i];
    const std::int64_t z = std::int64_t(p.z[query]) - q.z[i];
    return {std::uint64_t(x * x + y * y + z * z), index};
  }

  // Makes room when the records are full. For each query the exact k nearest are kept apart, and the records are
  // emptied. From then on boxes are compared with the worst of them in integers.
  void reduce()
  {
    worst_ = {0, 0};
    for(int query = first_; query < last_; ++query) {
      Candidate found[capacity + maximum];
      const int n = collect(query, found);
      for(int i = 0; i < k(); ++i)
        found[n + i] = is_reduced_ ? reduced_[query][i] : Candidate{~std::uint64_t(0), no_index};
      std::partial_sort(found, found + k(), found + n + k());
      std::copy(found, found + k(), reduced_[query]);
      worst_ = (std::max)(worst_, found[k() - 1]);
    }
    is_reduced_ = true;
    size_ = 0;
  }

  const Point_bucket* bucket_; // of the tree
  int k_;
  std::uint32_t own_ = 0;    // the bucket of the queries
  int first_ = 0, last_ = 0; // the queries in it
  Node_box box_;             // of the queries; its low corner is the origin of float coordinates
  float width_[3];
  float limit_ = 0;
  Float8 x_, y_, z_, reach_; // by query
  Float8 best_[maximum + 2]; // the smallest keys of each query, ascending
  int size_ = 0;
  std::uint32_t index_[capacity]; // by record
  float squared_[capacity][8];    // by record and query
  bool is_reduced_ = false;
  Candidate worst_;                         // of the neighbors of all queries, after a reduction
  Candidate reduced_[bucket_size][maximum]; // by query, ascending
};

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

  // The buckets before and after on the curve give a first bound, without a descent in the tree. The nearest come first,
  // as they lower the bound for the others.
  void scan_window(std::uint32_t bucket, int first, int last)
  {
    found_.start(bucket, first, last);
    found_.scan(bucket, tree_.points_in_bucket(bucket));
    for(std::uint32_t i = 1; i <= window_radius_; ++i)
      for(const std::uint32_t other : {bucket - i, bucket + i})
        if(window_.first <= other && other < window_.last)
          found_.scan(other, tree_.points_in_bucket(other));
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
    for(unsigned near = near_children(parent, squared); near != 0;) {
      const unsigned child = 31u - unsigned(__builtin_clz(near));
      near ^= 1u << child;
      stack[size++] = {squared[child], parent.index * branching + child, parent.level - 1};
    }
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

// Fills the rows of neighbors of all buckets. Those of different buckets do not overlap.
template <class Backend, int K>
void find_bucket_neighbors(Backend& backend, const Box_tree<Backend>& tree, int k, std::uint32_t* out)
{
  constexpr std::size_t grain = 64;
  backend.for_each_piece(tree.count(0), grain, [&](std::size_t first, std::size_t last) {
    Bucket_search<Box_tree<Backend>, K> search(tree, k);
    for(std::size_t bucket = first; bucket < last; ++bucket)
      search(std::uint32_t(bucket), out + bucket * bucket_size * std::size_t(k));
  });
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

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_FIND_NEIGHBORS_H
