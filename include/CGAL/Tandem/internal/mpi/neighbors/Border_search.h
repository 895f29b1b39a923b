// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact neighbors across ranks. Each rank has searched its own surfels. A surfel whose ball, up to its last neighbor,
// meets a box of another rank is sent there; the nearest surfels within the ball come back, and the k smallest keys of
// all are its neighbors. A key is (squared distance, rank, position): the order of one process, as ranks have
// consecutive surfels.

#ifndef CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BORDER_SEARCH_H
#define CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BORDER_SEARCH_H

#include <CGAL/Tandem/internal/mpi/messages/Communicator.h>
#include <CGAL/Tandem/internal/neighbors/Box_tree.h>

#include <algorithm>
#include <iterator>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Where the surfels of each rank are: some boxes of each, which all ranks know, with a tree over all of them.

inline Node_box box_of(const Grid_point& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

// n > 0.
inline Node_box box_around(const Grid_point* point, std::size_t n)
{
  Node_box box = box_of(point[0]);
  for(std::size_t i = 1; i < n; ++i)
    box = joined(box, box_of(point[i]));
  return box;
}

// At most so many boxes around sorted surfels. The largest box is halved again and again, so that gaps between
// consecutive surfels are in no box.
inline std::vector<Node_box> cover(const Grid_point* point, std::size_t n, std::size_t maximum)
{
  constexpr std::size_t grain = 32;
  std::vector<Node_box> part; // of so many surfels each
  for(std::size_t i = 0; i < n; i += grain)
    part.push_back(box_around(point + i, (std::min)(grain, n - i)));
  struct Run {
    std::uint64_t squared_size;
    std::size_t first, last; // surfels; multiples of the grain, or within one part
    Node_box box;

    bool operator<(const Run& r) const { return squared_size < r.squared_size; }
  };
  const auto run_of = [&](std::size_t first, std::size_t last) {
    Node_box box = last - first > grain ? part[first / grain] : box_around(point + first, last - first);
    for(std::size_t i = first + grain; i < last; i += grain)
      box = joined(box, part[i / grain]);
    return Run{squared_diagonal(box), first, last, box};
  };
  std::priority_queue<Run> runs;
  if(n > 0)
    runs.push(run_of(0, n));
  while(!runs.empty() && runs.size() < maximum && runs.top().squared_size > 0) { // hence at least two surfels
    const Run r = runs.top();
    runs.pop();
    std::size_t middle = (r.first + r.last) / 2;
    if(r.last - r.first > grain)
      middle = (std::max)(middle / grain * grain, r.first + grain);
    runs.push(run_of(r.first, middle));
    runs.push(run_of(middle, r.last));
  }
  std::vector<Run> ordered; // as the surfels, so that boxes beside each other are near each other
  for(; !runs.empty(); runs.pop())
    ordered.push_back(runs.top());
  std::sort(ordered.begin(), ordered.end(), [](const Run& a, const Run& b) { return a.first < b.first; });
  std::vector<Node_box> boxes;
  for(const Run& r : ordered)
    boxes.push_back(r.box);
  return boxes;
}

class Rank_boxes {
public:
  // The boxes of this rank, which all others get.
  Rank_boxes(Communicator& communicator, const std::vector<Node_box>& own)
  {
    std::vector<std::size_t> first;
    level_.push_back(communicator.gather(own, &first));
    for(std::uint32_t r = 0; r + 1 < first.size(); ++r)
      rank_.insert(rank_.end(), first[r + 1] - first[r], r);
    while(level_.back().size() > 1) {
      const std::vector<Node_box>& below = level_.back();
      std::vector<Node_box> level;
      for(std::size_t i = 0; i < below.size(); ++i)
        if(i % children == 0)
          level.push_back(below[i]);
        else
          level.back() = joined(level.back(), below[i]);
      level_.push_back(std::move(level));
    }
  }

  std::uint32_t rank(std::size_t i) const { return rank_[i]; }
  const Node_box& operator[](std::size_t i) const { return level_[0][i]; }

  // f(i) for the boxes within a squared distance, in their order, hence rank by rank.
  template <class F>
  void for_each_near(const Node_box& box, std::uint64_t squared, F f) const
  {
    if(!level_[0].empty())
      visit(level_.size() - 1, 0, box, squared, f);
  }

private:
  static constexpr std::size_t children = 8;

  template <class F>
  void visit(std::size_t level, std::size_t i, const Node_box& box, std::uint64_t squared, F& f) const
  {
    if(squared_distance(level_[level][i], box) > squared)
      return;
    if(level == 0)
      return f(i);
    for(std::size_t child = children * i; child < (std::min)(children * (i + 1), level_[level - 1].size()); ++child)
      visit(level - 1, child, box, squared, f);
  }

  std::vector<std::vector<Node_box>> level_; // from the boxes up to one around all
  std::vector<std::uint32_t> rank_;          // by box
};

// --- The nearest surfels of this rank within balls around surfels of other ranks.

// A surfel for another rank, with the squared radius of its ball.
struct Ball {
  std::int32_t x, y, z;
  std::uint32_t gap; // so that all bytes are defined
  std::uint64_t squared;
};

// One of the surfels of a rank within a ball.
struct Point_in_ball {
  std::uint64_t squared;
  std::uint64_t index; // wide, so that all bytes are defined

  bool operator<(const Point_in_ball& p) const
  {
    return squared < p.squared || (squared == p.squared && index < p.index);
  }
};

// The nearest surfels within a ball, in a box tree. All distances are exact.
template <class Tree>
class Ball_search {
public:
  Ball_search(const Tree& tree, int k) : tree_(tree), k_(std::size_t(k)) {}

  // At most k surfels, ascending.
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

// A surfel of any rank: its position there.
struct Rank_point {
  std::uint32_t rank, index;

  bool operator<(const Rank_point& p) const { return rank < p.rank || (rank == p.rank && index < p.index); }
  bool operator==(const Rank_point& p) const { return rank == p.rank && index == p.index; }
};

// Where an entry of the rows of this rank is a surfel of another one.
struct Remote_entry {
  std::size_t entry;
  Rank_point point;
};

// Host: the back end that searches.
template <class Host>
class Border_search {
public:
  // The surfels of this rank, and their rows from a search among them.
  Border_search(Communicator& communicator, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* neighbor)
    : communicator_(communicator), point_(point), n_(n), k_(std::size_t(k)), neighbor_(neighbor)
  {}

  // Completes the rows. Entries that are surfels of other ranks are returned; their places in the table are undefined.
  std::vector<Remote_entry> operator()()
  {
    find_balls();
    std::vector<std::vector<std::uint32_t>> sizes(balls_.size());
    std::vector<std::vector<Point_in_ball>> found(balls_.size());
    search(communicator_.exchange(balls_), sizes, found);
    return merge(communicator_.exchange(sizes), communicator_.exchange(found));
  }

private:
  // A surfel that may have neighbors on a rank.
  struct Query {
    std::uint32_t rank, point;
  };

  static constexpr std::size_t boxes_of_rank = 256;
  static constexpr std::uint32_t chunk = 256; // surfels that are tested together first

  // The squared distance to the last neighbor. A row that is not full has none that is far enough.
  std::uint64_t squared_radius(std::uint32_t i) const
  {
    const std::uint32_t last = neighbor_[std::size_t(i) * k_ + k_ - 1];
    return last == no_index ? ~std::uint64_t(0) : squared_distance(box_of(point_[i]), box_of(point_[last]));
  }

  void find_balls()
  {
    const Rank_boxes boxes(communicator_, cover(point_, n_, boxes_of_rank));
    balls_.resize(std::size_t(communicator_.size()));
    queries_.resize(balls_.size());
    const std::size_t chunks = (n_ + chunk - 1) / chunk;
    std::vector<std::vector<Query>> found(chunks);
    backend_.for_each(
      chunks, [&](std::size_t c) { find_balls_of_chunk(boxes, std::uint32_t(c), found[c]); }, 16);
    for(const auto& of_chunk : found)
      for(const Query& a : of_chunk) {
        const Grid_point& p = point_[a.point];
        balls_[a.rank].push_back({p.x, p.y, p.z, 0, squared_radius(a.point)});
        queries_[a.rank].push_back(a.point);
      }
  }

  // Most surfels have a small ball: of these only the boxes near the chunk are looked at. Stray surfels have large
  // ones, and look at all.
  void find_balls_of_chunk(const Rank_boxes& boxes, std::uint32_t c, std::vector<Query>& found) const
  {
    const std::uint32_t first = c * chunk, last = (std::min)(first + chunk, n_),
                        own = std::uint32_t(communicator_.rank());
    std::vector<std::uint64_t> radius;
    for(std::uint32_t i = first; i < last; ++i)
      radius.push_back(squared_radius(i));
    std::vector<std::uint64_t> ordered = radius;
    const auto median = ordered.begin() + std::ptrdiff_t(ordered.size() / 2);
    std::nth_element(ordered.begin(), median, ordered.end());
    const std::uint64_t usual = *median < (std::uint64_t(1) << 60) ? 4 * *median : *median;
    std::vector<std::size_t> near;
    boxes.for_each_near(box_around(point_ + first, last - first), usual, [&](std::size_t b) {
      if(boxes.rank(b) != own)
        near.push_back(b);
    });
    for(std::uint32_t i = first; i < last; ++i) {
      const std::uint64_t squared = radius[i - first];
      const Node_box center = box_of(point_[i]);
      std::uint32_t last_rank = own; // of the last box
      const auto add = [&](std::size_t b) {
        if(boxes.rank(b) == own || boxes.rank(b) == last_rank)
          return;
        last_rank = boxes.rank(b);
        found.push_back({last_rank, i});
      };
      if(squared > usual)
        boxes.for_each_near(center, squared, add);
      else
        for(const std::size_t b : near)
          if(squared_distance(center, boxes[b]) <= squared)
            add(b);
    }
  }

  // For the balls of each rank: the number of surfels in each, and the surfels.
  void search(const std::vector<std::vector<Ball>>& balls, std::vector<std::vector<std::uint32_t>>& sizes,
              std::vector<std::vector<Point_in_ball>>& points)
  {
    if(n_ == 0) {
      for(std::size_t r = 0; r < balls.size(); ++r)
        sizes[r].assign(balls[r].size(), 0);
      return;
    }
    const Box_tree<Host> tree(backend_, point_, n_);
    const Ball_search<Box_tree<Host>> in_ball(tree, int(k_));
    for(std::size_t r = 0; r < balls.size(); ++r) {
      std::vector<std::vector<Point_in_ball>> found(balls[r].size());
      backend_.for_each(
        found.size(), [&](std::size_t i) { found[i] = in_ball(balls[r][i]); }, 64);
      for(const auto& of_ball : found) {
        sizes[r].push_back(std::uint32_t(of_ball.size()));
        points[r].insert(points[r].end(), of_ball.begin(), of_ball.end());
      }
    }
  }

  // A candidate of a row.
  struct Candidate {
    std::uint64_t squared;
    Rank_point point;

    bool operator<(const Candidate& c) const
    {
      return squared < c.squared || (squared == c.squared && point < c.point);
    }
  };

  // One after the other: the surfels with queries are few.
  std::vector<Remote_entry> merge(const std::vector<std::vector<std::uint32_t>>& sizes,
                                  const std::vector<std::vector<Point_in_ball>>& found)
  {
    std::vector<std::size_t> ball(sizes.size(), 0), place(sizes.size(), 0);
    std::vector<std::uint32_t> points;
    for(const auto& of_rank : queries_)
      points.insert(points.end(), of_rank.begin(), of_rank.end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<Remote_entry> remote;
    std::vector<Candidate> candidates;
    for(const std::uint32_t i : points) {
      candidates.clear();
      const std::size_t row = std::size_t(i) * k_;
      for(std::size_t j = 0; j < k_ && neighbor_[row + j] != no_index; ++j)
        candidates.push_back({squared_distance(box_of(point_[i]), box_of(point_[neighbor_[row + j]])),
                              {std::uint32_t(communicator_.rank()), neighbor_[row + j]}});
      for(std::uint32_t r = 0; r < sizes.size(); ++r) {
        if(ball[r] == queries_[r].size() || queries_[r][ball[r]] != i)
          continue;
        for(std::uint32_t a = 0; a < sizes[r][ball[r]]; ++a, ++place[r])
          candidates.push_back({found[r][place[r]].squared, {r, std::uint32_t(found[r][place[r]].index)}});
        ++ball[r];
      }
      std::sort(candidates.begin(), candidates.end());
      for(std::size_t j = 0; j < k_; ++j) {
        neighbor_[row + j] = j < candidates.size() ? candidates[j].point.index : no_index;
        if(j < candidates.size() && candidates[j].point.rank != std::uint32_t(communicator_.rank()))
          remote.push_back({row + j, candidates[j].point});
      }
    }
    return remote;
  }

  Host backend_;
  Communicator& communicator_;
  const Grid_point* point_;
  std::uint32_t n_;
  std::size_t k_;
  std::uint32_t* neighbor_;
  std::vector<std::vector<Ball>> balls_;            // by rank
  std::vector<std::vector<std::uint32_t>> queries_; // the same: their surfels, ascending
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BORDER_SEARCH_H
