// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface between inside and outside, as faces: connected facets of one plane are one face, if it has no holes and
// does not touch itself.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_BOUNDARY_FACES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_BOUNDARY_FACES_H

#include <CGAL/Shape_regularization_tandem/models/surface/Inside_cells.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::surface {

struct Face {
  std::vector<int> vertices; // counterclockwise, seen from outside
  int plane;                 // none: a face of the box
  std::vector<int> facets;   // that it is made of
};

// Where only two faces meet, both go straight on.
inline void drop_straight_corners(std::vector<Face>& faces)
{
  std::map<int, int> number_of_faces;
  for(const Face& face : faces)
    for(int v : face.vertices)
      ++number_of_faces[v];
  for(Face& face : faces)
    face.vertices.erase(
      std::remove_if(face.vertices.begin(), face.vertices.end(), [&](int v) { return number_of_faces.at(v) == 2; }),
      face.vertices.end());
}

class Boundary_faces {
public:
  Boundary_faces(const Cells& cells, const Inside_cells& inside) : cells_(cells)
  {
    for(std::size_t f = 0; f < cells.facets.size(); ++f)
      if(inside.is_boundary(int(f))) {
        std::vector<int> loop = cells.facets[f].vertices;
        if(!inside.is_inside(cells.facets[f].behind))
          std::reverse(loop.begin(), loop.end());
        for_each_edge(loop, [&](int u, int v) { next_[{u, v}] = {int(f), 0}; });
        for(std::size_t i = 0; i < loop.size(); ++i)
          next_[{loop[i], loop[(i + 1) % loop.size()]}].after = loop[(i + 2) % loop.size()];
        loops_[int(f)] = loop;
      }
    number_patches();
  }

  std::vector<Face> faces() const
  {
    const std::vector<std::vector<std::vector<int>>> borders = borders_of_patches();
    std::vector<Face> result;
    std::map<int, std::size_t> face_of_patch;
    for(const auto& [facet, loop] : loops_) {
      const int patch = patch_.at(facet);
      const std::vector<std::vector<int>>& of_patch = borders[std::size_t(patch)];
      if(of_patch.size() != 1)
        result.push_back({loop, cells_.facet(facet).plane, {facet}});
      else if(const auto [at, is_new] = face_of_patch.emplace(patch, result.size()); is_new)
        result.push_back({of_patch.front(), cells_.facet(facet).plane, {facet}});
      else
        result[at->second].facets.push_back(facet);
    }
    drop_straight_corners(result);
    return result;
  }

private:
  using Directed = std::pair<int, int>; // an edge with the face to its left
  struct Next {
    int facet, after; // the vertex after the edge
  };

  // Faces of the box are not one plane.
  bool are_of_one_plane(int facet, int other) const
  {
    return cells_.facet(facet).plane != none && cells_.facet(facet).plane == cells_.facet(other).plane;
  }

  void number_patches()
  {
    for(const auto& [facet, loop] : loops_) {
      if(patch_.count(facet) > 0)
        continue;
      patch_[facet] = number_of_patches_;
      std::vector<int> open = {facet};
      while(!open.empty()) {
        const int f = open.back();
        open.pop_back();
        for_each_edge(loops_.at(f), [&](int u, int v) {
          const int g = next_.at({v, u}).facet;
          if(are_of_one_plane(f, g) && patch_.emplace(g, number_of_patches_).second)
            open.push_back(g);
        });
      }
      ++number_of_patches_;
    }
  }

  int patch_at(const Directed& e) const { return patch_.at(next_.at(e).facet); }
  bool is_border(const Directed& e) const { return patch_at(e) != patch_at({e.second, e.first}); }

  Directed next_on_border(const Directed& edge) const
  {
    Directed e = {edge.second, next_.at(edge).after};
    while(!is_border(e))
      e = {e.first, next_.at({e.second, e.first}).after};
    return e;
  }

  // Of one that touches itself there is a second, empty one.
  std::vector<std::vector<std::vector<int>>> borders_of_patches() const
  {
    std::vector<std::vector<std::vector<int>>> result;
    result.resize(std::size_t(number_of_patches_));
    std::set<Directed> is_done;
    for(const auto& [edge, next] : next_) {
      if(!is_border(edge) || is_done.count(edge) > 0)
        continue;
      std::vector<std::vector<int>>& borders = result[std::size_t(patch_at(edge))];
      std::vector<int> border;
      for(Directed e = edge; is_done.insert(e).second; e = next_on_border(e))
        border.push_back(e.first);
      borders.push_back(border);
      std::sort(border.begin(), border.end());
      if(std::adjacent_find(border.begin(), border.end()) != border.end())
        borders.emplace_back();
    }
    return result;
  }

  const Cells& cells_;
  std::map<int, std::vector<int>> loops_; // of the facets of the boundary, seen from outside
  std::map<Directed, Next> next_;
  std::map<int, int> patch_; // of each facet
  int number_of_patches_ = 0;
};

// Of faces, which are connected where they have corners in common, those of so many components with the largest areas; 0: of
// all that have at least a hundredth of the area of the largest.
inline std::vector<Face> faces_of_components(std::vector<Face> faces, const std::vector<double>& area_of_facet,
                                             std::size_t most)
{
  constexpr double smallest = .01;
  std::map<int, std::vector<std::size_t>> faces_at;
  for(std::size_t f = 0; f < faces.size(); ++f)
    for(int v : faces[f].vertices)
      faces_at[v].push_back(f);
  struct Component {
    double area = 0;
    std::size_t number;
  };
  std::vector<Component> components;
  std::vector<std::size_t> component_of(faces.size(), faces.size());
  for(std::size_t f = 0; f < faces.size(); ++f) {
    if(component_of[f] != faces.size())
      continue;
    components.push_back({0, components.size()});
    std::vector<std::size_t> open = {f};
    component_of[f] = components.back().number;
    while(!open.empty()) {
      const Face& face = faces[open.back()];
      open.pop_back();
      for(int facet : face.facets)
        components.back().area += area_of_facet[std::size_t(facet)];
      for(int v : face.vertices)
        for(std::size_t g : faces_at[v])
          if(component_of[g] == faces.size()) {
            component_of[g] = components.back().number;
            open.push_back(g);
          }
    }
  }
  std::stable_sort(components.begin(), components.end(),
                   [](const Component& a, const Component& b) { return a.area > b.area; });
  std::set<std::size_t> kept;
  for(const Component& c : components)
    if(most == 0 ? c.area >= smallest * components.front().area : kept.size() < most)
      kept.insert(c.number);
  std::vector<Face> result;
  for(std::size_t f = 0; f < faces.size(); ++f)
    if(kept.count(component_of[f]) > 0)
      result.push_back(std::move(faces[f]));
  return result;
}

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_BOUNDARY_FACES_H
