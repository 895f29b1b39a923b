// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Components of surfels that lie on several ranks. A ghost and its owner's surfel are one surfel, so they join a
// component here with one there: these pairs are few, and each rank joins all of them. One process has none of them.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_BORDER_COMPONENTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_BORDER_COMPONENTS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Tandem/internal/backend/Union_find.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// A union-find of surfels of any rank, by their numbers. The smallest one of a set is its root.
class Surfel_sets {
public:
  struct Edge {
    std::uint64_t a, b;

    bool operator<(const Edge& e) const { return std::tie(a, b) < std::tie(e.a, e.b); }
    bool operator==(const Edge& e) const { return a == e.a && b == e.b; }
  };

  explicit Surfel_sets(const std::vector<Edge>& edges)
  {
    for(const Edge& e : edges) {
      surfel_.push_back(e.a);
      surfel_.push_back(e.b);
    }
    std::sort(surfel_.begin(), surfel_.end());
    surfel_.erase(std::unique(surfel_.begin(), surfel_.end()), surfel_.end());
    for(std::size_t i = 0; i < surfel_.size(); ++i)
      parent_.push_back(std::uint32_t(i));
    for(const Edge& e : edges)
      sets().unite(place(e.a), place(e.b));
  }

  std::size_t size() const { return surfel_.size(); }
  std::uint64_t surfel(std::size_t i) const { return surfel_[i]; }
  std::uint64_t root_surfel(std::size_t i) { return surfel_[sets().root(std::uint32_t(i))]; }

private:
  std::uint32_t place(std::uint64_t surfel) const
  {
    return std::uint32_t(std::lower_bound(surfel_.begin(), surfel_.end(), surfel) - surfel_.begin());
  }

  Union_find<Shared_parents<Sequential_backend>> sets() { return {{parent_.data()}}; }

  std::vector<std::uint64_t> surfel_; // ascending
  std::vector<std::uint32_t> parent_;
};

// A component of the surfels of one label: the position of its root, no_index if it has no surfel on this rank; the
// label, in which its number may follow; its number of points.
struct Component {
  std::uint32_t root, entry;
  std::uint64_t size;
};

// The components of this rank that go on beyond it.
template <class Backend>
class Border_components {
public:
  Border_components(Backend& backend, const Ranks<Backend>& ranks) : backend_(backend), ranks_(ranks) {}

  // component: by surfel, its root on this rank, where roots are the smallest places; inner ghosts have entries.
  // Afterwards parts of one component on this rank have one root. label: with marks for free surfels.
  void find(const Cloud_view& cloud, const std::uint32_t* label, std::uint32_t* component)
  {
    if constexpr(Ranks<Backend>::are_many) {
      const std::size_t n = cloud.size + ranks_.ghosts(Rings::inner);
      const Host_view<Backend, const std::uint32_t> labels(backend_, label, n);
      Host_view<Backend, std::uint32_t> roots(backend_, component, n);
      const std::vector<Surfel_sets::Edge> edges = joined_components(cloud.size, n, labels.data(), roots.data());
      take_sets(Surfel_sets(ranks_.gather(edges)), n, roots.data());
      roots.write_back();
    }
  }

  // size: by root, of the n surfels of this rank; becomes that of the whole component. Larger ones than 32 bits can
  // hold become the largest number.
  void sum_sizes(std::size_t n, std::uint32_t* size)
  {
    if constexpr(Ranks<Backend>::are_many) {
      Host_view<Backend, std::uint32_t> sizes(backend_, size, n);
      std::vector<Part> parts;
      for(const Border_component& s : borders_)
        parts.push_back({s.global_root, sizes.data()[s.root]});
      parts = ranks_.gather(parts);
      std::sort(parts.begin(), parts.end());
      for(Border_component& s : borders_) {
        s.size = 0;
        for(auto part = std::lower_bound(parts.begin(), parts.end(), Part{s.global_root, 0});
            part != parts.end() && part->global_root == s.global_root; ++part)
          s.size += part->size;
        sizes.data()[s.root] = std::uint32_t((std::min)(s.size, std::uint64_t(0xffffffffu)));
      }
      sizes.write_back();
    }
  }

  // The number of the smallest surfel of the component with this root on this rank.
  std::uint64_t global_root(std::uint32_t root) const
  {
    const Border_component* const border = at(root);
    return border != nullptr ? border->global_root : ranks_.number(root);
  }

  // own: large components with surfels on this rank, by root. Returns those of all ranks, in the order of their global
  // roots. The root is no_index where they have no surfel on this rank.
  std::vector<Component> join_large(std::vector<Component> own) const
  {
    if constexpr(!Ranks<Backend>::are_many)
      return own;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> root_of; // by global root
    std::vector<Large> reported;                                  // by the rank of the global root
    for(const Component& c : own) {
      const Border_component* const border = at(c.root);
      const std::uint64_t global = global_root(c.root);
      root_of.emplace_back(global, c.root);
      if(is_own(global))
        reported.push_back({global, border != nullptr ? border->size : c.size, c.entry});
    }
    std::sort(root_of.begin(), root_of.end());
    std::vector<Component> all;
    for(const Large& l : ranks_.gather(reported)) {
      const auto it = std::lower_bound(root_of.begin(), root_of.end(), std::make_pair(l.global_root, std::uint32_t(0)));
      const bool is_here = it != root_of.end() && it->first == l.global_root;
      all.push_back({is_here ? it->second : no_index, std::uint32_t(l.entry), l.size});
    }
    return all;
  }

private:
  struct Border_component {
    std::uint32_t root;        // the smallest position on this rank
    std::uint64_t global_root; // the number of the smallest surfel of all ranks
    std::uint64_t size;        // of the whole component, after sum_sizes()
  };

  // The surfels of a component on one rank.
  struct Part {
    std::uint64_t global_root, size;

    bool operator<(const Part& p) const { return global_root < p.global_root; }
  };

  struct Large {
    std::uint64_t global_root, size, entry;
  };

  // The component that a ghost is in here, which its owner gets to know.
  struct Joined {
    std::uint64_t component, index;
  };

  bool is_own(std::uint64_t number) const { return number >> 32 == ranks_.own_items().rank; }

  const Border_component* at(std::uint32_t root) const
  {
    const auto it = std::lower_bound(borders_.begin(), borders_.end(), root,
                                     [](const Border_component& s, std::uint32_t r) { return s.root < r; });
    return it != borders_.end() && it->root == root ? &*it : nullptr;
  }

  // The pairs of components that share a ghost. The first ghost is at `first`.
  std::vector<Surfel_sets::Edge> joined_components(std::size_t first, std::size_t n, const std::uint32_t* label,
                                                   const std::uint32_t* component) const
  {
    std::vector<Joined> joined;
    for(std::size_t g = first; g < n; ++g)
      if(label[g] < first_mark)
        joined.push_back({ranks_.number(component[g]), g});
    std::vector<Surfel_sets::Edge> edges;
    for(const Joined& j : ranks_.to_owners(joined))
      edges.push_back({j.component, ranks_.number(component[j.index])});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

  void take_sets(Surfel_sets sets, std::size_t n, std::uint32_t* component)
  {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> roots; // global root, and a root of this rank
    for(std::size_t i = 0; i < sets.size(); ++i) {
      const std::uint32_t index = std::uint32_t(sets.surfel(i));
      if(is_own(sets.surfel(i)) && component[index] == index)
        roots.emplace_back(sets.root_surfel(i), index);
    }
    std::sort(roots.begin(), roots.end());
    borders_.clear();
    bool has_joined = false;
    for(std::size_t i = 0; i < roots.size(); ++i) {
      if(i == 0 || roots[i].first != roots[i - 1].first)
        borders_.push_back({roots[i].second, roots[i].first, 0});
      else {
        component[roots[i].second] = borders_.back().root;
        has_joined = true;
      }
    }
    for(std::size_t i = 0; has_joined && i < n; ++i)
      component[i] = component[component[i]];
    std::sort(borders_.begin(), borders_.end(),
              [](const Border_component& a, const Border_component& b) { return a.root < b.root; });
  }

  Backend& backend_;
  const Ranks<Backend>& ranks_;
  std::vector<Border_component> borders_; // by root
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_BORDER_COMPONENTS_H
