// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest points of this rank within balls around points of other ranks.

#ifndef CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BALL_SEARCH_H
#define CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BALL_SEARCH_H

#include <CGAL/Tandem/internal/neighbors/Box_tree.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A point for another rank, with the squared radius of its ball.
struct Ball {
  std::int32_t x, y, z;
  std::uint32_t gap; // so that all bytes are defined
  std::uint64_t squared;
};

// One of the points of a rank within a ball.
struct Point_in_ball {
  std::uint64_t squared;
  std::uint64_t index; // wide, so that all bytes are defined

  bool operator<(const Point_in_ball& p) const
  {
    return squared < p.squared || (squared == p.squared && index < p.index);
  }
};

// The nearest points within a ball, in a box tree. All distances are exact.
template <class Tree>
class Ball_search {
public:
  Ball_search(const Tree& tree, int k) : tree_(tree), k_(std::size_t(k)) {}

  // At most k points, ascending.
  std::vector<Point_in_ball> operator()(const Ball& ball) const
  {
    const Node_box center = {{ball.x, ball.y, ball.z}, {ball.x, ball.y, ball.z}};
    std::vector<Point_in_ball> found; // a heap, the worst one on top
    std::vector<Node> stack;
    visit({0, 0, tree_.levels() - 1}, center, ball.squared, found, stack);
    while(!stack.empty()) {
      const Node node = stack.back();
      stack.pop_back();
      if(node.squared <= reach(found, ball.squared))
        visit(node, center, ball.squared, found, stack);
    }
    std::sort_heap(found.begin(), found.end());
    return found;
  }

private:
  struct Node {
    std::uint64_t squared;
    std::uint32_t index;
    int level;
  };

  std::uint64_t reach(const std::vector<Point_in_ball>& found, std::uint64_t limit) const
  {
    return found.size() < k_ ? limit : found.front().squared;
  }

  void visit(const Node& node, const Node_box& center, std::uint64_t limit, std::vector<Point_in_ball>& found,
             std::vector<Node>& stack) const
  {
    if(node.level == 0)
      return scan(node.index, center, limit, found);
    const std::uint32_t first = node.index * branching;
    const std::uint32_t last = (std::min)(first + branching, tree_.count(node.level - 1));
    const std::size_t base = stack.size();
    for(std::uint32_t child = first; child < last; ++child) {
      const std::uint64_t squared = squared_distance(center, tree_.box(node.level - 1, child));
      if(squared <= reach(found, limit))
        stack.push_back({squared, child, node.level - 1});
    }
    // The nearest child is searched first.
    std::sort(stack.begin() + std::ptrdiff_t(base), stack.end(),
              [](const Node& a, const Node& b) { return a.squared > b.squared; });
  }

  void scan(std::uint32_t bucket, const Node_box& center, std::uint64_t limit, std::vector<Point_in_ball>& found) const
  {
    const Point_bucket& b = tree_.buckets()[bucket];
    for(std::uint32_t i = 0; i < tree_.points_in_bucket(bucket); ++i) {
      const Point_in_ball p = {squared_distance(center, {{b.x[i], b.y[i], b.z[i]}, {b.x[i], b.y[i], b.z[i]}}),
                               bucket * bucket_size + i};
      if(p.squared > limit || (found.size() == k_ && !(p < found.front())))
        continue;
      if(found.size() == k_) {
        std::pop_heap(found.begin(), found.end());
        found.pop_back();
      }
      found.push_back(p);
      std::push_heap(found.begin(), found.end());
    }
  }

  const Tree& tree_;
  std::size_t k_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BALL_SEARCH_H
