// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact neighbors across ranks. Each rank has searched its own points. A point whose ball, up to its last neighbor,
// meets a box of another rank is sent there; the nearest points within the ball come back, and the k smallest keys of
// all are its neighbors. A key is (squared distance, rank, position): the order of one process, as ranks have
// consecutive points.

#ifndef CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BORDER_SEARCH_H
#define CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BORDER_SEARCH_H

#include <CGAL/Tandem/internal/mpi/neighbors/Ball_search.h>
#include <CGAL/Tandem/internal/mpi/neighbors/Rank_boxes.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A point of any rank: its position there.
struct Rank_point {
  std::uint32_t rank, index;

  bool operator<(const Rank_point& p) const { return rank < p.rank || (rank == p.rank && index < p.index); }
  bool operator==(const Rank_point& p) const { return rank == p.rank && index == p.index; }
};

// Where an entry of the rows of this rank is a point of another one.
struct Remote_entry {
  std::size_t entry;
  Rank_point point;
};

// Host: the back end that searches.
template <class Host>
class Border_search {
public:
  // The points of this rank, and their rows from a search among them.
  Border_search(Communicator& communicator, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* neighbor)
    : communicator_(communicator), point_(point), n_(n), k_(std::size_t(k)), neighbor_(neighbor)
  {}

  // Completes the rows. Entries that are points of other ranks are returned; their places in the table are undefined.
  std::vector<Remote_entry> operator()()
  {
    find_balls();
    std::vector<std::vector<std::uint32_t>> sizes(balls_.size());
    std::vector<std::vector<Point_in_ball>> found(balls_.size());
    search(communicator_.exchange(balls_), sizes, found);
    return merge(communicator_.exchange(sizes), communicator_.exchange(found));
  }

private:
  // A point that may have neighbors on a rank.
  struct Query {
    std::uint32_t rank, point;
  };

  static constexpr std::size_t boxes_of_rank = 256;
  static constexpr std::uint32_t chunk = 256; // points that are tested together first

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

  // Most points have a small ball: of these only the boxes near the chunk are looked at. Stray points have large ones,
  // and look at all.
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

  // For the balls of each rank: the number of points in each, and the points.
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

  // One after the other: the points with queries are few.
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
  std::vector<std::vector<std::uint32_t>> queries_; // the same: their points, ascending
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_BORDER_SEARCH_H
