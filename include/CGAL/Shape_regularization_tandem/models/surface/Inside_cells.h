// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells are inside: by a minimum cut, the cheapest ones. Then cells change sides, those first for which it costs
// least, until no surface between inside and outside touches itself.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_INSIDE_CELLS_H

#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Cell_cutter.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Ray_votes.h>
#include <CGAL/Shape_regularization_tandem/models/surface/Site.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/boost/graph/alpha_expansion_graphcut.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

// --- How much of each facet points cover, or walls without points are assumed to

struct Covered_part {
  double area = 0;
  std::vector<Point> places; // spread evenly over it
};

struct Covered_facet {
  double area; // of all of the facet
  Covered_part scanned, assumed;
};

// The part of a facet in these polygons of its plane.
inline Covered_part covered_part(const Plane_coverage& plane, const Flat_polygon& facet,
                                 const std::vector<const Flat_polygon*>& polygons)
{
  constexpr double number_of_places = 64; // about so many
  Covered_part result;
  std::vector<std::array<Kernel::Point_2, 3>> triangles;
  std::vector<double> areas;
  for(const Flat_polygon* polygon : polygons) {
    const Flat_polygon part = common_part(*polygon, facet);
    for(std::size_t i = 2; i < part.size(); ++i) {
      triangles.push_back({part[0], part[i - 1], part[i]});
      areas.push_back((std::max)(0., CGAL::area(part[0], part[i - 1], part[i]))); // by rounding, it may be negative
      result.area += areas.back();
    }
  }
  if(!(result.area > 0))
    return Covered_part();
  double left = .5; // of a place, from the triangles before
  std::size_t count = 0;
  for(std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    for(left += areas[i] / result.area * number_of_places; left >= 1; --left, ++count) {
      double a = double(count) * .7548776662466927, b = double(count) * .5698402909980532; // a sequence of no pattern
      a -= std::floor(a);
      b -= std::floor(b);
      if(a + b > 1) {
        a = 1 - a;
        b = 1 - b;
      }
      result.places.push_back(plane.lifted(t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0])));
    }
  }
  return result;
}

// `of_plane` are the facets in the plane.
inline void cover(const Cells& cells, const Plane_coverage& plane, const std::vector<std::size_t>& of_plane,
                  std::vector<Covered_facet>& facets)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, std::size_t>;
  const auto box_of = [](const Flat_polygon& p, std::size_t i) { return Box(CGAL::bbox_2(p.begin(), p.end()), i); };
  std::vector<Flat_polygon> flat;
  std::vector<Box> boxes;
  for(std::size_t f : of_plane) {
    flat.push_back(plane.flat(cells.corners(cells.facets[f])));
    boxes.push_back(box_of(flat.back(), boxes.size()));
  }
  const auto add = [&](const std::vector<Plane_coverage::Corners>& parts, Covered_part Covered_facet::*part) {
    std::vector<Flat_polygon> flat_parts;
    std::vector<Box> part_boxes;
    for(const auto& corners : parts) {
      flat_parts.push_back(plane.flat(corners));
      part_boxes.push_back(box_of(flat_parts.back(), part_boxes.size()));
    }
    std::vector<std::vector<std::size_t>> near(of_plane.size());
    CGAL::box_intersection_d(boxes.begin(), boxes.end(), part_boxes.begin(), part_boxes.end(),
                             [&](const Box& a, const Box& b) { near[a.info()].push_back(b.info()); });
    for(std::size_t i = 0; i < of_plane.size(); ++i) {
      std::sort(near[i].begin(), near[i].end());
      std::vector<const Flat_polygon*> polygons;
      for(std::size_t j : near[i])
        polygons.push_back(&flat_parts[j]);
      facets[of_plane[i]].*part = covered_part(plane, flat[i], polygons);
    }
  };
  add(plane.covered(), &Covered_facet::scanned);
  add(plane.assumed(), &Covered_facet::assumed);
  for(std::size_t f : of_plane) {
    Covered_facet& facet = facets[f];
    facet.scanned.area = (std::min)(facet.scanned.area, facet.area);
    facet.assumed.area = (std::min)(facet.assumed.area, facet.area - facet.scanned.area);
  }
}

inline std::vector<Covered_facet> cover_facets(const Cells& cells, const std::vector<Plane_coverage>& planes,
                                               const Model_progress& progress)
{
  std::vector<Covered_facet> facets;
  for(const Facet& facet : cells.facets)
    facets.push_back({area_of(cells.corners(facet)), {}, {}});
  const std::vector<std::vector<std::size_t>> of_plane = cells.facets_of_planes(planes.size());
  for_each_in_parallel(planes.size(), progress, [&](std::size_t p) { cover(cells, planes[p], of_plane[p], facets); });
  return facets;
}

// --- What it costs that cells are inside. Most rays that leave a covered facet say which of its two cells is inside: it
// costs the covered area if that one is not, or the other one is. A boundary that nothing covers costs a part of its
// area, and all of it where the box of the points ends: the ground of a scan is not a block.

class Inside_cost {
public:
  std::vector<double> inside, outside; // of each cell that is inside, or is not
  std::vector<double> boundary;        // of each facet between a cell that is inside and one that is not
  std::vector<double> area, scanned;   // of each facet, and how much of it points cover

  Inside_cost(const Cells& cells, const std::vector<Plane_coverage>& planes, const Site& site,
              const Model_progress& progress)
    : inside(cells.cells.size(), 0), outside(cells.cells.size(), 0)
  {
    const std::vector<Covered_facet> covered = cover_facets(cells, planes, progress);
    const Ray_votes rays(planes, site.up);
    std::vector<double> votes(cells.facets.size());
    for_each_in_parallel(votes.size(), progress, [&](std::size_t f) {
      const Facet& facet = cells.facets[f];
      if(facet.plane != none)
        votes[f] = vote(covered[f], normal_of(cells.corners(facet)), std::size_t(facet.plane), rays);
    });
    for(std::size_t f = 0; f < cells.facets.size(); ++f) {
      const Facet& facet = cells.facets[f];
      const double free = covered[f].area - covered[f].scanned.area - covered[f].assumed.area;
      area.push_back(covered[f].area);
      scanned.push_back(covered[f].scanned.area);
      boundary.push_back((facet.plane == none ? 1 : worth_of_free) * (std::max)(0., free));
      if(facet.front == none)
        continue;
      const bool is_behind = votes[f] > 0;
      outside[std::size_t(is_behind ? facet.behind : facet.front)] += std::fabs(votes[f]);
      inside[std::size_t(is_behind ? facet.front : facet.behind)] += std::fabs(votes[f]);
    }
    const double more_than_all = 1 + 2 * std::accumulate(area.begin(), area.end(), 0.);
    for(std::size_t c = 0; c < inside.size(); ++c)
      if(!site.contains(cells.middle(int(c))))
        inside[c] += more_than_all;
  }

private:
  static constexpr double worth_of_free = .025; // of a unit of area without points

  // The area by which the cell behind a facet is inside and the one in front of it outside; negative if it is the other
  // way round.
  static double vote(const Covered_facet& covered, const Vector& to_front, std::size_t plane, const Ray_votes& rays)
  {
    const auto of = [&](const Covered_part& part, double least) {
      const double balance = rays.balance(part.places, to_front, plane);
      return balance < -least ? -part.area : balance > least ? part.area : 0;
    };
    return of(covered.scanned, 0) + worth_of_free * of(covered.assumed, Ray_votes::least_of_wall);
  }
};

class Inside_cells {
public:
  Inside_cells(const Cells& cells, const Inside_cost& cost, const Model_progress& progress)
    : cells_(cells), cost_(cost), has_changed_(cells.cells.size())
  {
    cut();
    progress.check(.4);
    for(std::size_t f = 0; f < cells.facets.size(); ++f)
      for_each_edge(cells.facets[f].vertices, [&](int u, int v) {
        facets_of_edge_[edge_of(u, v)].push_back(int(f));
        facets_of_vertex_[u].push_back(int(f));
      });
    make_manifold(progress);
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
  void make_manifold(const Model_progress& progress)
  {
    bool has_changed = true;
    while(has_changed) {
      has_changed = false;
      progress.check(.6);
      for(const auto& [edge, facets] : facets_of_edge_)
        for(; number_on_boundary(facets) > 2; has_changed = true)
          change_cheapest(facets);
      for(const auto& [vertex, facets] : facets_of_vertex_) {
        progress.check(.8);
        for(; !is_fan(vertex, facets); has_changed = true)
          change_cheapest(facets);
      }
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
