// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes that nearly meet in a point make corners that are closer than rounding allows. They become one, where the
// surface stays a two-manifold.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SHORT_EDGES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SHORT_EDGES_H

#include <CGAL/Shape_regularization_tandem/models/surface/Boundary_faces.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace surface {

class Short_edges {
public:
  // Of faces with these points.
  Short_edges(const std::vector<Point>& points, std::vector<Face> faces, double shortest)
    : points_(points), faces_(std::move(faces)), shortest_(shortest)
  {
    for(std::size_t f = 0; f < faces_.size(); ++f)
      for(int v : faces_[f].vertices)
        faces_at_[v].insert(f);
    bool has_changed = true;
    while(has_changed) {
      has_changed = false;
      for(std::size_t f = 0; f < faces_.size(); ++f)
        has_changed = contract_one(f) || has_changed;
    }
    faces_.erase(std::remove_if(faces_.begin(), faces_.end(), [](const Face& face) { return face.vertices.empty(); }),
                 faces_.end());
    drop_straight_corners(faces_);
  }

  const std::vector<Face>& faces() const { return faces_; }

private:
  bool contract_one(std::size_t f)
  {
    const std::vector<int> loop = faces_[f].vertices;
    for(std::size_t i = 0; i < loop.size(); ++i) {
      const int u = loop[i], v = loop[(i + 1) % loop.size()];
      if(CGAL::squared_distance(points_[std::size_t(u)], points_[std::size_t(v)]) < shortest_ * shortest_ &&
         contract(u, v))
        return true;
    }
    return false;
  }

  // v becomes u, if each edge then has two faces, and the faces there are one fan.
  bool contract(int u, int v)
  {
    std::map<std::size_t, std::vector<int>> changed;
    for(int w : {u, v})
      for(std::size_t f : faces_at_[w])
        changed[f] = contracted(faces_[f].vertices, u, v);
    std::map<int, int> next; // of the vertices around u, those before and after it in a face
    for(const auto& [f, loop] : changed) {
      if(loop.size() < 3)
        continue;
      const auto at = std::find(loop.begin(), loop.end(), u);
      if(std::count(loop.begin(), loop.end(), u) != 1)
        return false;
      const int before = at == loop.begin() ? loop.back() : *(at - 1);
      const int after = at + 1 == loop.end() ? loop.front() : *(at + 1);
      if(!next.emplace(after, before).second)
        return false;
    }
    if(next.size() < 3)
      return false;
    std::size_t length = 1;
    for(auto at = next.find(next.begin()->second); at != next.begin(); at = next.find(at->second), ++length)
      if(at == next.end() || length > next.size())
        return false;
    if(length != next.size())
      return false;
    for(const auto& [f, loop] : changed)
      if(loop.size() < 3 && !keeps_corners(f, u, v))
        return false;
    for(auto& [f, loop] : changed) {
      if(loop.size() < 3)
        for(int w : faces_[f].vertices)
          faces_at_[w].erase(f);
      else
        faces_at_[u].insert(f);
      faces_[f].vertices = loop.size() < 3 ? std::vector<int>() : loop;
    }
    faces_at_.erase(v);
    return true;
  }

  // Whether the other corners of a face that vanishes have three faces then, or two that do without it, as it is on a
  // straight edge of both.
  bool keeps_corners(std::size_t f, int u, int v) const
  {
    return std::all_of(faces_[f].vertices.begin(), faces_[f].vertices.end(), [&](int w) {
      const std::set<std::size_t>& faces = faces_at_.at(w);
      return w == u || w == v || faces.size() > 3 || std::all_of(faces.begin(), faces.end(), [&](std::size_t g) {
               return g == f || faces_[g].vertices.size() > 3;
             });
    });
  }

  static std::vector<int> contracted(std::vector<int> loop, int u, int v)
  {
    std::replace(loop.begin(), loop.end(), v, u);
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    if(loop.size() > 1 && loop.front() == loop.back())
      loop.pop_back();
    return loop;
  }

  const std::vector<Point>& points_;
  std::vector<Face> faces_; // those that have vanished have no vertices
  double shortest_;
  std::map<int, std::set<std::size_t>> faces_at_;
};

} // namespace surface
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_SHORT_EDGES_H
