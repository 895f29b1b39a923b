// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outlines of a shape while they are made. What is done to them is taken back where lines would touch or cross.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_DRAFT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_DRAFT_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Straight_border.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/make_polygons.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

class Outline_draft {
public:
  // False if their lines touch or cross, straightened or not: then the draft is as before.
  bool make(std::vector<Outline_loop> loops, double tolerance)
  {
    std::size_t rank = 0;
    for(Outline_loop& loop : loops)
      for(Outline_vertex& v : loop)
        v.rank = rank++;
    if(!remake(loops, tolerance))
      return false;
    dense_ = std::move(loops);
    return true;
  }

  // Straightened.
  std::vector<Outline_loop> loops() const
  {
    std::vector<Outline_loop> result;
    const auto add = [&](const Polygon::Loop& loop) {
      result.emplace_back();
      for(std::uint32_t v : loop)
        result.back().push_back(vertices_[v]);
    };
    for(const Polygon& polygon : polygons_) {
      add(polygon.outer);
      for(const Polygon::Loop& hole : polygon.holes)
        add(hole);
    }
    return result;
  }

  // The loop that a straightened one comes from.
  const Outline_loop& dense_loop(const Outline_loop& loop) const
  {
    std::size_t i = 0;
    while(i + 1 < dense_.size() && dense_[i + 1][0].rank <= loop[0].rank)
      ++i;
    return dense_[i];
  }

  // Replaces loops by those of `other` that are not empty, and leaves those out that would not be simple or apart.
  void replace(std::vector<Outline_loop> loops, const std::vector<Outline_loop>& other)
  {
    std::vector<std::size_t> changed;
    for(std::size_t i = 0; i < other.size(); ++i)
      if(!other[i].empty())
        changed.push_back(i);
    replace(loops, other, changed.begin(), changed.end());
  }

  const std::vector<Outline_vertex>& vertices() const { return vertices_; }
  std::vector<Polygon>& polygons() { return polygons_; }

  std::vector<Border_line> lines; // of the straight borders, and then others of the plane

private:
  using Position_in_loops = std::vector<std::size_t>::const_iterator;

  bool remake(const std::vector<Outline_loop>& loops, double tolerance)
  {
    std::vector<Outline_vertex> vertices;
    std::vector<Polygon> polygons;
    if(!make_polygons(loops, tolerance, vertices, polygons))
      return false;
    vertices_ = std::move(vertices);
    polygons_ = std::move(polygons);
    return true;
  }

  // All at once, or else one half after the other.
  void replace(std::vector<Outline_loop>& loops, const std::vector<Outline_loop>& other, Position_in_loops first,
               Position_in_loops last)
  {
    if(first == last)
      return;
    std::vector<Outline_loop> trial = loops;
    for(auto i = first; i != last; ++i)
      trial[*i] = other[*i];
    if(remake(trial, 0)) {
      loops = std::move(trial);
      return;
    }
    if(last - first == 1)
      return;
    const auto middle = first + (last - first) / 2;
    replace(loops, other, first, middle);
    replace(loops, other, middle, last);
  }

  std::vector<Outline_loop> dense_;
  std::vector<Outline_vertex> vertices_;
  std::vector<Polygon> polygons_;
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_DRAFT_H
