// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Components of points that lie on several ranks. Each rank has found those of its own points and ghosts. A ghost and
// its owner's point are one point, so they join a component here with one there: these pairs are few, and each rank
// joins all of them.

#ifndef CGAL_TANDEM_INTERNAL_MPI_SEAMS_H
#define CGAL_TANDEM_INTERNAL_MPI_SEAMS_H

#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/mpi/Ghosts.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

// The components of this rank that go on beyond it.
class Seams {
public:
  struct Seam {
    std::uint32_t root;        // the smallest position on this rank
    std::uint64_t global_root; // the smallest one of all: rank << 32 | position
    std::uint64_t size;        // of the whole component, after sum_sizes()
  };

  Seams() = default;
  // Roots are unique.
  explicit Seams(std::vector<Seam> seams) : seams_(std::move(seams))
  {
    std::sort(seams_.begin(), seams_.end(), [](const Seam& a, const Seam& b) { return a.root < b.root; });
  }

  // size: by root, of the points of this rank; larger ones than 32 bits can hold become the largest number.
  void sum_sizes(Communicator& communicator, std::uint32_t* size)
  {
    std::vector<Part> parts;
    for(const Seam& s : seams_)
      parts.push_back({s.global_root, size[s.root]});
    parts = communicator.gather(parts);
    const auto is_before = [](const Part& a, const Part& b) { return a.global_root < b.global_root; };
    std::sort(parts.begin(), parts.end(), is_before);
    for(Seam& s : seams_) {
      s.size = 0;
      for(auto part = std::lower_bound(parts.begin(), parts.end(), Part{s.global_root, 0}, is_before);
          part != parts.end() && part->global_root == s.global_root; ++part)
        s.size += part->size;
      size[s.root] = std::uint32_t((std::min)(s.size, std::uint64_t(0xffffffffu)));
    }
  }

  // rank: of the component with this root.
  std::uint64_t global_root(std::uint64_t rank, std::uint32_t root) const
  {
    const Seam* const seam = find(root);
    return seam != nullptr ? seam->global_root : rank << 32 | root;
  }

  // own: large components with points on this rank, by root. Returns those of all ranks, in the order of their global
  // roots.
  template <class Component>
  std::vector<Component> join_large(Communicator& communicator, const std::vector<Component>& own) const
  {
    struct Large {
      std::uint64_t global_root, size, entry;
    };
    const std::uint64_t rank = std::uint64_t(communicator.rank());
    std::vector<std::pair<std::uint64_t, std::uint32_t>> root_of; // by global root
    std::vector<Large> reported;                                  // by the rank of the global root
    for(const Component& c : own) {
      const Seam* const seam = find(c.root);
      const std::uint64_t global = global_root(rank, c.root);
      root_of.emplace_back(global, c.root);
      if(global >> 32 == rank)
        reported.push_back({global, seam != nullptr ? seam->size : c.size, c.entry});
    }
    std::sort(root_of.begin(), root_of.end());
    std::vector<Component> all;
    for(const Large& l : communicator.gather(reported)) {
      const auto it = std::lower_bound(root_of.begin(), root_of.end(), std::make_pair(l.global_root, std::uint32_t(0)));
      const bool is_here = it != root_of.end() && it->first == l.global_root;
      all.push_back({is_here ? it->second : no_index, std::uint32_t(l.entry), l.size});
    }
    return all;
  }

private:
  const Seam* find(std::uint32_t root) const
  {
    const auto it =
      std::lower_bound(seams_.begin(), seams_.end(), root, [](const Seam& s, std::uint32_t r) { return s.root < r; });
    return it != seams_.end() && it->root == root ? &*it : nullptr;
  }

  // The points of a component on one rank.
  struct Part {
    std::uint64_t global_root, size;
  };

  std::vector<Seam> seams_;
};

// A union-find of points of any rank, by rank << 32 | position. The smallest one of a set is its root.
class Point_sets {
public:
  struct Edge {
    std::uint64_t a, b;
  };

  explicit Point_sets(const std::vector<Edge>& edges)
  {
    for(const Edge& e : edges) {
      point_.push_back(e.a);
      point_.push_back(e.b);
    }
    std::sort(point_.begin(), point_.end());
    point_.erase(std::unique(point_.begin(), point_.end()), point_.end());
    for(std::size_t i = 0; i < point_.size(); ++i)
      parent_.push_back(std::uint32_t(i));
    for(const Edge& e : edges)
      sets().unite(place(e.a), place(e.b));
  }

  std::size_t size() const { return point_.size(); }
  std::uint64_t point(std::size_t i) const { return point_[i]; }
  std::uint64_t root_point(std::size_t i) { return point_[sets().root(std::uint32_t(i))]; }

private:
  std::uint32_t place(std::uint64_t point) const
  {
    return std::uint32_t(std::lower_bound(point_.begin(), point_.end(), point) - point_.begin());
  }

  Union_find<Shared_parents<Sequential_backend>> sets() { return {{parent_.data()}}; }

  std::vector<std::uint64_t> point_; // ascending
  std::vector<std::uint32_t> parent_;
};

// component: by point, its root on this rank, where roots are the smallest places; ghosts of the first ring have entries.
// Afterwards parts of one component on this rank have one root.
template <class Ghosts>
Seams join_components(Communicator& communicator, const Ghosts& ghosts, const std::uint32_t* label,
                      std::uint32_t* component)
{
  const std::uint64_t rank = std::uint64_t(communicator.rank());
  const auto id_of = [](const Rank_point& p) { return std::uint64_t(p.rank) << 32 | p.index; };
  // Ghosts tell their owners the component that they are in here.
  struct Joined {
    std::uint64_t component, index;
  };
  std::vector<std::vector<Joined>> send(std::size_t(communicator.size()));
  for(std::uint32_t g = ghosts.ring_begin(0); g < ghosts.ring_begin(0) + ghosts.ring_size(0); ++g)
    if(label[g] < first_mark) {
      const Rank_point owner = ghosts.point_at(g);
      send[owner.rank].push_back({id_of(ghosts.point_at(component[g])), owner.index});
    }
  std::vector<Point_sets::Edge> edges;
  for(const auto& from : communicator.exchange(send))
    for(const Joined& j : from)
      edges.push_back({j.component, rank << 32 | component[j.index]});
  const auto is_before = [](const Point_sets::Edge& a, const Point_sets::Edge& b) {
    return a.a < b.a || (a.a == b.a && a.b < b.b);
  };
  const auto is_same = [](const Point_sets::Edge& a, const Point_sets::Edge& b) { return a.a == b.a && a.b == b.b; };
  std::sort(edges.begin(), edges.end(), is_before);
  edges.erase(std::unique(edges.begin(), edges.end(), is_same), edges.end());
  Point_sets sets(communicator.gather(edges));

  std::vector<Seams::Seam> seams;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> roots; // global root, and a root of this rank
  for(std::size_t i = 0; i < sets.size(); ++i) {
    const std::uint32_t index = std::uint32_t(sets.point(i));
    if(sets.point(i) >> 32 == rank && component[index] == index)
      roots.emplace_back(sets.root_point(i), index);
  }
  std::sort(roots.begin(), roots.end());
  bool has_joined = false;
  for(std::size_t i = 0; i < roots.size(); ++i) {
    if(i == 0 || roots[i].first != roots[i - 1].first)
      seams.push_back({roots[i].second, roots[i].first, 0});
    else {
      component[roots[i].second] = seams.back().root;
      has_joined = true;
    }
  }
  for(std::uint32_t i = 0; has_joined && i < ghosts.own_size() + ghosts.ring_size(0); ++i)
    component[i] = component[component[i]];
  return Seams(std::move(seams));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_SEAMS_H
