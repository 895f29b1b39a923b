// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Components of surfels that lie on several ranks. A ghost and its owner's surfel are one surfel, so they join a
// component here with one there: these pairs are few, and each rank joins all of them. One process has none of them.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_BORDER_COMPONENTS_H
#define CGAL_TANDEM_INTERNAL_FINISH_BORDER_COMPONENTS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace CGAL::Tandem::internal {

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
      join(ranks_.gather(joined_components(cloud.size, n, labels.data(), roots.data())), n, roots.data());
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
      for(const auto& [root, border] : borders_)
        parts.push_back({border.global_root, sizes.data()[root]});
      std::map<std::uint64_t, std::uint64_t> total; // by global root
      for(const Part& part : ranks_.gather(parts))
        total[part.global_root] += part.size;
      for(auto& [root, border] : borders_) {
        border.size = total[border.global_root];
        sizes.data()[root] = std::uint32_t((std::min)(border.size, std::uint64_t(0xffffffffu)));
      }
      sizes.write_back();
    }
  }

  // The number of the smallest surfel of the component with this root on this rank.
  std::uint64_t global_root(std::uint32_t root) const
  {
    const auto border = borders_.find(root);
    return border != borders_.end() ? border->second.global_root : ranks_.number(root);
  }

  // own: large components with surfels on this rank, by root. Returns those of all ranks, in the order of their global
  // roots. The root is no_index where they have no surfel on this rank.
  std::vector<Component> join_large(std::vector<Component> own) const
  {
    if constexpr(!Ranks<Backend>::are_many)
      return own;
    std::map<std::uint64_t, std::uint32_t> root_of; // by global root
    std::vector<Large> reported;                    // by the rank of the global root
    for(const Component& c : own) {
      const auto border = borders_.find(c.root);
      const std::uint64_t global = global_root(c.root);
      root_of.emplace(global, c.root);
      if(is_own(global))
        reported.push_back({global, border != borders_.end() ? border->second.size : c.size, c.entry});
    }
    std::vector<Component> all;
    for(const Large& l : ranks_.gather(reported)) {
      const auto here = root_of.find(l.global_root);
      all.push_back({here != root_of.end() ? here->second : no_index, std::uint32_t(l.entry), l.size});
    }
    return all;
  }

private:
  using Edge = std::array<std::uint64_t, 2>; // numbers of surfels

  struct Border_component {
    std::uint64_t global_root; // the number of the smallest surfel of all ranks
    std::uint64_t size;        // of the whole component, after sum_sizes()
  };

  // The surfels of a component on one rank.
  struct Part {
    std::uint64_t global_root, size;
  };

  struct Large {
    std::uint64_t global_root, size, entry;
  };

  // The component that a ghost is in here, which its owner gets to know.
  struct Joined {
    std::uint64_t component, index;
  };

  bool is_own(std::uint64_t number) const { return number >> 32 == ranks_.own_items().rank; }

  // The pairs of components that share a ghost. The first ghost is at `first`.
  std::vector<Edge> joined_components(std::size_t first, std::size_t n, const std::uint32_t* label,
                                      const std::uint32_t* component) const
  {
    std::vector<Joined> joined;
    for(std::size_t g = first; g < n; ++g)
      if(label[g] < first_mark)
        joined.push_back({ranks_.number(component[g]), g});
    std::vector<Edge> edges;
    for(const Joined& j : ranks_.to_owners(joined))
      edges.push_back({j.component, ranks_.number(component[j.index])});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

  // A union-find of the surfels of the edges, of all ranks, where the smallest one of a set is its root.
  void join(const std::vector<Edge>& edges, std::size_t n, std::uint32_t* component)
  {
    std::map<std::uint64_t, std::uint64_t> parent;
    const auto root_of = [&](std::uint64_t surfel) {
      std::uint64_t root = parent.emplace(surfel, surfel).first->second;
      while(parent[root] != root)
        root = parent[root];
      return parent[surfel] = root;
    };
    for(const auto& [a, b] : edges) {
      const auto [first, second] = std::minmax({root_of(a), root_of(b)});
      parent[second] = first;
    }
    borders_.clear();
    std::map<std::uint64_t, std::uint32_t> first_of; // by global root, the smallest root of this rank
    bool has_joined = false;
    for(const auto& entry : parent) {
      const std::uint64_t surfel = entry.first;
      const std::uint32_t index = std::uint32_t(surfel);
      if(!is_own(surfel) || component[index] != index)
        continue;
      const std::uint64_t global = root_of(surfel);
      component[index] = first_of.emplace(global, index).first->second;
      borders_.emplace(component[index], Border_component{global, 0});
      has_joined = has_joined || component[index] != index;
    }
    for(std::size_t i = 0; has_joined && i < n; ++i)
      component[i] = component[component[i]];
  }

  Backend& backend_;
  const Ranks<Backend>& ranks_;
  std::map<std::uint32_t, Border_component> borders_; // by root: its smallest position on this rank
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_BORDER_COMPONENTS_H
