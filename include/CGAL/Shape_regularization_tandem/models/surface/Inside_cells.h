// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells are inside: by a minimum cut, the cheapest ones. Then cells change sides, those first for which it costs
// least, until no surface between inside and outside touches itself.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H

#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>

#include <CGAL/boost/graph/alpha_expansion_graphcut.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// --- How much of each facet points cover, or walls without points are assumed to, with places there

struct Covered_part {
  double area = 0;
  std::vector<Point> places;
};

struct Covered_facet {
  double area; // of all of the facet
  Covered_part scanned, assumed;
};

// Of places that are spread evenly over the facet.
inline void add_assumed(const Plane_coverage& plane, const std::vector<Point>& corners, Covered_facet& facet)
{
  constexpr std::size_t places_to_try = 256; // about so many
  std::vector<double> areas(2, 0.);          // of the triangles that end at each corner
  for(std::size_t i = 2; i < corners.size(); ++i)
    areas.push_back(area_of({corners[0], corners[i - 1], corners[i]}));
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.);
  if(!(sum > 0))
    return;
  std::size_t tried = 0;
  double left = 0; // of a place, from the triangles before
  for(std::size_t i = 2; i < corners.size(); ++i) {
    const Vector u = corners[i - 1] - corners[0], v = corners[i] - corners[0];
    for(left += areas[i] / sum * double(places_to_try); left >= 1; --left, ++tried) {
      double a = double(tried) * .7548776662466927, b = double(tried) * .5698402909980532; // a sequence of no pattern
      a -= std::floor(a);
      b -= std::floor(b);
      const Point p = a + b > 1 ? corners[0] + (1 - a) * u + (1 - b) * v : corners[0] + a * u + b * v;
      if(plane.is_assumed(p))
        facet.assumed.places.push_back(p);
    }
  }
  if(tried > 0)
    facet.assumed.area =
      (std::min)(facet.area - facet.scanned.area, double(facet.assumed.places.size()) / double(tried) * facet.area);
}

// `of_plane` are the facets in the plane.
inline void cover(const Cells& cells, const Plane_coverage& plane, const std::vector<std::size_t>& of_plane,
                  std::vector<Covered_facet>& facets)
{
  std::vector<std::vector<Kernel::Point_2>> flat;
  std::vector<CGAL::Bbox_2> boxes;
  for(std::size_t f : of_plane) {
    flat.emplace_back();
    for(const Point& corner : cells.corners(cells.facets[f]))
      flat.back().push_back(plane.flat(corner));
    boxes.push_back(CGAL::bbox_2(flat.back().begin(), flat.back().end()));
  }
  for(std::size_t n = 0; n < plane.points().size(); ++n) {
    const Point& point = plane.points()[n];
    const Kernel::Point_2 p = plane.flat(point);
    for(std::size_t i = 0; i < of_plane.size(); ++i)
      if(CGAL::do_overlap(boxes[i], p.bbox()) &&
         CGAL::bounded_side_2(flat[i].begin(), flat[i].end(), p) != CGAL::ON_UNBOUNDED_SIDE) {
        Covered_part& scanned = facets[of_plane[i]].scanned;
        scanned.area += plane.area_of_point(n);
        scanned.places.push_back(point);
        break;
      }
  }
  for(std::size_t f : of_plane) {
    facets[f].scanned.area = (std::min)(facets[f].scanned.area, facets[f].area);
    if(plane.has_assumed_part())
      add_assumed(plane, cells.corners(cells.facets[f]), facets[f]);
  }
}

inline std::vector<Covered_facet> cover_facets(const Cells& cells, const std::vector<Plane_coverage>& planes)
{
  std::vector<Covered_facet> facets;
  std::vector<std::vector<std::size_t>> of_plane(planes.size());
  for(std::size_t f = 0; f < cells.facets.size(); ++f) {
    facets.push_back({area_of(cells.corners(cells.facets[f])), {}, {}});
    if(cells.facets[f].plane != none)
      of_plane[std::size_t(cells.facets[f].plane)].push_back(f);
  }
  for_each_in_parallel(planes.size(), [&](std::size_t p) { cover(cells, planes[p], of_plane[p], facets); });
  return facets;
}

// --- What it costs that cells are inside. Most rays that leave a covered facet say which of its two cells is inside: it
// costs the covered area if that one is not, or the other one is. A boundary that nothing covers costs a part of its
// area, and all of it where the box of the points ends: the ground of a scan is not a block.

class Inside_cost {
public:
  std::vector<double> inside, outside;       // of each cell that is inside, or is not
  std::vector<double> boundary;              // of each facet between a cell that is inside and one that is not
  std::vector<std::size_t> number_of_points; // on each facet

  Inside_cost(const Cells& cells, const std::vector<Plane_coverage>& planes, const Vector& up)
    : inside(cells.cells.size(), 0), outside(cells.cells.size(), 0)
  {
    const std::vector<Covered_facet> covered = cover_facets(cells, planes);
    Ray_votes rays(up);
    rays.add_obstacles(planes);
    std::vector<double> votes(cells.facets.size());
    for_each_in_parallel(votes.size(), [&](std::size_t f) {
      const Facet& facet = cells.facets[f];
      if(facet.plane != none)
        votes[f] = vote(covered[f], normal_of(cells.corners(facet)), planes[std::size_t(facet.plane)], rays);
    });
    for(std::size_t f = 0; f < cells.facets.size(); ++f) {
      const Facet& facet = cells.facets[f];
      const double free = covered[f].area - covered[f].scanned.area - covered[f].assumed.area;
      boundary.push_back((facet.plane == none ? 1 : worth_of_free) * (std::max)(0., free));
      number_of_points.push_back(covered[f].scanned.places.size());
      if(facet.front == none)
        continue;
      const bool is_behind = votes[f] > 0;
      outside[std::size_t(is_behind ? facet.behind : facet.front)] += std::fabs(votes[f]);
      inside[std::size_t(is_behind ? facet.front : facet.behind)] += std::fabs(votes[f]);
    }
  }

private:
  static constexpr double worth_of_free = .1; // of a unit of area without points

  // The area by which the cell behind a facet is inside and the one in front of it outside; negative if it is the other
  // way round.
  static double vote(const Covered_facet& covered, const Vector& to_front, const Plane_coverage& plane,
                     const Ray_votes& rays)
  {
    const auto of = [&](const Covered_part& part) {
      const double balance = rays.balance(part.places, to_front, plane);
      return balance < 0 ? -part.area : balance > 0 ? part.area : 0;
    };
    return of(covered.scanned) + worth_of_free * of(covered.assumed);
  }
};

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
    const std::size_t n = cells_.cells.size();                              // beyond the box is one cell more
    std::vector<std::vector<double>> costs = {cost_.inside, cost_.outside}; // of each label
    std::vector<std::pair<std::size_t, std::size_t>> sides;
    double sum = 1;
    for(std::size_t c = 0; c < n; ++c)
      sum += costs[inside][c] + costs[outside][c];
    for(std::size_t f = 0; f < cells_.facets.size(); ++f) {
      const Facet& facet = cells_.facets[f];
      sides.emplace_back(std::size_t(facet.behind), facet.front == none ? n : std::size_t(facet.front));
      sum += cost_.boundary[f];
    }
    costs[inside].push_back(sum);
    costs[outside].push_back(0);
    std::vector<std::size_t> labels(n + 1, outside);
    CGAL::alpha_expansion_graphcut(sides, cost_.boundary, costs, labels);
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
    const std::size_t c = std::size_t(cell);
    double cost = (is_inside(cell) ? 1 : -1) * (cost_.outside[c] - cost_.inside[c]);
    for(int f : cells_.facets_of(cell))
      cost += (is_boundary(f) ? -1 : 1) * cost_.boundary[std::size_t(f)];
    return cost;
  }

  const Cells& cells_;
  const Inside_cost& cost_;
  std::vector<bool> is_inside_, has_changed_; // of each cell
  std::map<Edge, std::vector<int>> facets_of_edge_;
  std::map<int, std::vector<int>> facets_of_vertex_;
};

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H
