// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the points of each rank are: some boxes of each, which all ranks know, with a tree over all of them.

#ifndef CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_RANK_BOXES_H
#define CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_RANK_BOXES_H

#include <CGAL/Tandem/internal/mpi/messages/Communicator.h>
#include <CGAL/Tandem/internal/neighbors/Box_tree.h>

#include <algorithm>
#include <queue>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

inline Node_box box_of(const Grid_point& p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}}; }

// n > 0.
inline Node_box box_around(const Grid_point* point, std::size_t n)
{
  Node_box box = box_of(point[0]);
  for(std::size_t i = 1; i < n; ++i)
    box = joined(box, box_of(point[i]));
  return box;
}

// At most so many boxes around sorted points. The largest box is halved again and again, so that gaps between
// consecutive points are in no box.
inline std::vector<Node_box> cover(const Grid_point* point, std::size_t n, std::size_t maximum)
{
  constexpr std::size_t grain = 32;
  std::vector<Node_box> part; // of so many points each
  for(std::size_t i = 0; i < n; i += grain)
    part.push_back(box_around(point + i, (std::min)(grain, n - i)));
  struct Run {
    std::uint64_t squared_size;
    std::size_t first, last; // points; multiples of the grain, or within one part
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
  while(!runs.empty() && runs.size() < maximum && runs.top().squared_size > 0) { // hence at least two points
    const Run r = runs.top();
    runs.pop();
    std::size_t middle = (r.first + r.last) / 2;
    if(r.last - r.first > grain)
      middle = (std::max)(middle / grain * grain, r.first + grain);
    runs.push(run_of(r.first, middle));
    runs.push(run_of(middle, r.last));
  }
  std::vector<Run> ordered; // as the points, so that boxes beside each other are near each other
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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_NEIGHBORS_RANK_BOXES_H
