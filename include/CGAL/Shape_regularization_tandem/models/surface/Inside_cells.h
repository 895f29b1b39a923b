// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells are inside: by a minimum cut, the cheapest ones. Then cells change sides, those first for which it costs
// least, until no surface between inside and outside touches itself.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H

#include <CGAL/Shape_regularization_tandem/models/surface/Inside_cost.h>

#if defined(__GNUC__) && !defined(__clang__) // warns of Boost's maximum flow
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <CGAL/boost/graph/alpha_expansion_graphcut.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <set>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Inside_cells {
public:
  Inside_cells(const Cells& cells, const Inside_cost& cost)
    : cells_(cells), cost_(cost), has_changed_(cells.cells.size())
  {
    cut();
    for(std::size_t f = 0; f < cells.facets.size(); ++f)
      for_each_edge(cells.facets[f].vertices, [&](int u, int v) {
        facets_of_edge_[edge_of(u, v)].push_back(int(f));
        facets_of_vertex_[u].push_back(int(f));
      });
    make_manifold();
  }

  bool is_inside(int cell) const { return cell != none && is_inside_[std::size_t(cell)]; }
  bool is_boundary(int facet) const
  {
    const Facet& f = cells_.facet(facet);
    return is_inside(f.behind) != is_inside(f.front);
  }

private:
  void cut()
  {
    enum Label : std::size_t { inside, outside };
    const std::size_t n = cells_.cells.size();                                // beyond the box is one cell more
    std::vector<std::vector<double>> costs(2, std::vector<double>(n + 1, 0)); // of each label
    std::vector<std::pair<std::size_t, std::size_t>> sides;
    std::vector<double> side_costs;
    double sum = 1;
    for(std::size_t c = 0; c < n; ++c) {
      costs[inside][c] = cost_.inside(int(c));
      costs[outside][c] = cost_.outside(int(c));
      sum += costs[inside][c] + costs[outside][c];
    }
    for(std::size_t f = 0; f < cells_.facets.size(); ++f) {
      const Facet& facet = cells_.facets[f];
      sides.emplace_back(std::size_t(facet.behind), facet.front == none ? n : std::size_t(facet.front));
      side_costs.push_back(cost_.boundary(int(f)));
      sum += side_costs.back();
    }
    costs[inside][n] = sum;
    std::vector<std::size_t> labels(n + 1, outside);
    CGAL::alpha_expansion_graphcut(sides, side_costs, costs, labels);
    for(std::size_t c = 0; c < n; ++c)
      is_inside_.push_back(labels[c] == inside);
  }

  // Two facets at each edge, and one fan of them at each vertex.
  void make_manifold()
  {
    bool has_changed = true;
    while(has_changed) {
      has_changed = false;
      for(const auto& [edge, facets] : facets_of_edge_)
        for(; number_on_boundary(facets) > 2; has_changed = true)
          change_cheapest(facets);
      for(const auto& [vertex, facets] : facets_of_vertex_)
        for(; !is_fan(vertex, facets); has_changed = true)
          change_cheapest(facets);
    }
  }

  std::size_t number_on_boundary(const std::vector<int>& facets) const
  {
    return std::size_t(std::count_if(facets.begin(), facets.end(), [&](int f) { return is_boundary(f); }));
  }

  // Whether the facets of the boundary at a vertex are connected by edges at it.
  bool is_fan(int vertex, const std::vector<int>& facets) const
  {
    const auto first = std::find_if(facets.begin(), facets.end(), [&](int f) { return is_boundary(f); });
    if(first == facets.end())
      return true;
    std::set<int> met = {*first};
    std::vector<int> open = {*first};
    while(!open.empty()) {
      const std::vector<int>& loop = cells_.facet(open.back()).vertices;
      open.pop_back();
      for_each_edge(loop, [&](int u, int v) {
        if(u == vertex || v == vertex)
          for(int f : facets_of_edge_.at(edge_of(u, v)))
            if(is_boundary(f) && met.insert(f).second)
              open.push_back(f);
      });
    }
    return met.size() == number_on_boundary(facets);
  }

  // Of the cells at these facets one that has not changed; where all have, one outside. So this comes to an end.
  void change_cheapest(const std::vector<int>& facets)
  {
    int best = none;
    double least = 0;
    const auto look_at = [&](bool has_changed) {
      for(int f : facets)
        for(int c : {cells_.facet(f).behind, cells_.facet(f).front}) {
          if(c == none || has_changed_[std::size_t(c)] != has_changed || (has_changed && is_inside(c)))
            continue;
          const double cost = cost_of_change(c);
          if(best == none || cost < least) {
            best = c;
            least = cost;
          }
        }
    };
    look_at(false);
    if(best == none)
      look_at(true);
    is_inside_[std::size_t(best)] = !is_inside_[std::size_t(best)];
    has_changed_[std::size_t(best)] = true;
  }

  double cost_of_change(int cell) const
  {
    double cost = (is_inside(cell) ? 1 : -1) * (cost_.outside(cell) - cost_.inside(cell));
    for(int f : cells_.facets_of(cell))
      cost += is_boundary(f) ? -cost_.boundary(f) : cost_.boundary(f);
    return cost;
  }

  const Cells& cells_;
  const Inside_cost& cost_;
  std::vector<bool> is_inside_, has_changed_; // of each cell
  std::map<Edge, std::vector<int>> facets_of_edge_;
  std::map<int, std::vector<int>> facets_of_vertex_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H
