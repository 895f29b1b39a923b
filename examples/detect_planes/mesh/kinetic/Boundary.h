// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The boundary of the inside volumes as a surface.

#ifndef DETECT_PLANES_BOUNDARY_H
#define DETECT_PLANES_BOUNDARY_H

#include "mesh/kinetic/Volumes.h"
#include "mesh/mesh_methods.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace program {

// Where more than two of its facets meet at an edge, those are neighbors that are so through the inside. So each edge
// has two facets, vertices that only touch are several, and the surface is a manifold.
class Boundary {
public:
  Boundary(const Volumes& volumes, const std::vector<bool>& is_inside) : volumes(volumes), is_inside(is_inside)
  {
    for(Dart d : volumes.edges())
      if(is_on_boundary(d))
        edges.emplace(d, Edge());
    number_vertices();
    number_patches();
  }

  Surface surface() const
  {
    Surface result = {{}, polygons()};
    result.points.resize(number_of_vertices);
    for(const auto& [dart, edge] : edges) {
      const Kernel::Point_3& start = volumes.start(dart);
      result.points[edge.vertex] = start;
      result.points[edge.middle] = CGAL::midpoint(start, volumes.start(volumes.next_edge(dart)));
    }
    drop_straight_corners(result.faces);
    drop_unused_points(result);
    if(signed_volume(result, result.faces) < 0)
      reverse(result.faces);
    return result;
  }

private:
  using Dart = Volumes::Dart;
  using Face = Surface::Face;
  static constexpr std::size_t none = std::size_t(-1);
  struct Edge {
    std::size_t vertex = none; // where it starts
    std::size_t middle = none; // a vertex of the edge and of its twin
    std::size_t patch = none;  // connected facets of a plane
  };

  bool is_on_boundary(Dart d) const { return is_inside[volumes.volume(d)] && !is_inside[volumes.volume_beyond(d)]; }

  // The edge of the neighbor.
  Dart twin(Dart d) const
  {
    Dart e = volumes.next_facet(d);
    while(!is_on_boundary(e))
      e = volumes.next_facet(volumes.beyond(e));
    return e;
  }

  void number_vertices()
  {
    for(auto& [dart, edge] : edges) {
      if(edge.vertex != none)
        continue;
      for(Dart d = dart; edges[d].vertex == none; d = volumes.next_edge(twin(d)))
        edges[d].vertex = number_of_vertices;
      ++number_of_vertices;
    }
    for(auto& [dart, edge] : edges)
      if(edge.middle == none)
        edge.middle = edges[twin(dart)].middle = number_of_vertices++;
  }

  // Sides of the bounding box are left in their facets.
  bool is_same_plane(Dart d, Dart e) const { return volumes.plane(d) >= 0 && volumes.plane(d) == volumes.plane(e); }

  void number_patches()
  {
    for(auto& [dart, edge] : edges) {
      if(edge.patch != none)
        continue;
      std::vector<Dart> open(1, dart);
      while(!open.empty()) {
        const Dart facet = open.back();
        open.pop_back();
        if(edges[facet].patch != none)
          continue;
        for(Dart d : volumes.edges_of_facet(facet))
          edges[d].patch = number_of_patches;
        for(Dart d : volumes.edges_of_facet(facet))
          if(is_same_plane(d, twin(d)))
            open.push_back(twin(d));
      }
      ++number_of_patches;
    }
  }

  std::size_t patch(Dart d) const { return edges.at(d).patch; }
  bool is_border(Dart d) const { return patch(d) != patch(twin(d)); }

  // Along the border of the patch.
  Dart next_on_border(Dart d) const
  {
    Dart e = volumes.next_edge(d);
    while(!is_border(e))
      e = volumes.next_edge(twin(e));
    return e;
  }

  // Of all edges that `is_start` accepts, the loops that `next` makes, with their patches.
  template <class Is_start, class Next>
  std::vector<std::pair<std::size_t, Face>> loops(Is_start is_start, Next next) const
  {
    std::vector<std::pair<std::size_t, Face>> result;
    std::map<Dart, bool> is_done;
    for(const auto& [dart, edge] : edges) {
      if(!is_start(dart) || is_done[dart])
        continue;
      result.emplace_back(edge.patch, Face());
      for(Dart d = dart; !is_done[d]; d = next(d)) {
        is_done[d] = true;
        result.back().second.push_back(edges.at(d).vertex);
        result.back().second.push_back(edges.at(d).middle);
      }
    }
    return result;
  }

  // One for each patch; the facets of a patch with holes.
  std::vector<Face> polygons() const
  {
    std::vector<std::size_t> number_of_loops(number_of_patches, 0);
    const auto borders = loops([this](Dart d) { return is_border(d); }, [this](Dart d) { return next_on_border(d); });
    for(const auto& border : borders)
      ++number_of_loops[border.first];
    std::vector<Face> result;
    for(const auto& [patch, face] : borders)
      if(number_of_loops[patch] == 1)
        result.push_back(face);
    for(const auto& [patch, face] : loops([&](Dart d) { return number_of_loops[this->patch(d)] != 1; },
                                          [this](Dart d) { return volumes.next_edge(d); }))
      result.push_back(face);
    return result;
  }

  // Where only two faces meet, both go straight on.
  void drop_straight_corners(std::vector<Face>& faces) const
  {
    std::vector<int> corners(number_of_vertices, 0);
    for(const Face& face : faces)
      for(std::size_t v : face)
        ++corners[v];
    std::vector<bool> is_dropped(number_of_vertices);
    for(std::size_t v = 0; v < number_of_vertices; ++v)
      is_dropped[v] = corners[v] == 2;
    keep_on_double_edges(faces, is_dropped);
    for(Face& face : faces)
      face.erase(std::remove_if(face.begin(), face.end(), [&](std::size_t v) { return is_dropped[v]; }), face.end());
  }

  // Where the inside touches itself along an edge, there may be two with the same ends: each of them keeps a vertex.
  static void keep_on_double_edges(const std::vector<Face>& faces, std::vector<bool>& is_dropped)
  {
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> first_dropped; // between these corners
    for(const Face& face : faces) {
      const auto first = std::find_if(face.begin(), face.end(), [&](std::size_t v) { return !is_dropped[v]; });
      Face turned(first, face.end());
      turned.insert(turned.end(), face.begin(), first);
      turned.push_back(turned.front());
      for(std::size_t i = 0, j = 1; j < turned.size(); ++j) {
        if(is_dropped[turned[j]])
          continue;
        if(turned[i] < turned[j])
          first_dropped[{turned[i], turned[j]}].push_back(turned[i + 1]);
        i = j;
      }
    }
    for(const auto& [corners, vertices] : first_dropped)
      if(vertices.size() > 1)
        for(std::size_t v : vertices)
          is_dropped[v] = false;
  }

  static void drop_unused_points(Surface& surface)
  {
    std::vector<std::size_t> number(surface.points.size(), none);
    std::vector<Kernel::Point_3> used;
    for(Face& face : surface.faces)
      for(std::size_t& v : face) {
        if(number[v] == none) {
          number[v] = used.size();
          used.push_back(surface.points[v]);
        }
        v = number[v];
      }
    surface.points = std::move(used);
  }

  const Volumes& volumes;
  const std::vector<bool>& is_inside;
  std::map<Dart, Edge> edges;
  std::size_t number_of_vertices = 0, number_of_patches = 0;
};

} // namespace program

#endif // DETECT_PLANES_BOUNDARY_H
