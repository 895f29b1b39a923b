// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outlines of a shape while they are made. What is done to them is taken back where lines would touch or cross.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_DRAFT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_DRAFT_H

#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/outline_types.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Polyline_simplification_2/Stop_above_cost_threshold.h>
#include <CGAL/Polyline_simplification_2/simplify.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

namespace simplification = CGAL::Polyline_simplification_2;

using Vertex_base = simplification::Vertex_base_2<Kernel>;
using Face_base =
  CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Base =
  CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>,
                                             CGAL::Exact_predicates_tag>;
using Triangulation = CGAL::Constrained_triangulation_plus_2<Base>;
using Face_handle = Triangulation::Face_handle;
using Vertex_handle = Triangulation::Vertex_handle;
using Vertex_map = std::map<Kernel::Point_2, const Outline_vertex*>;

constexpr int outside = 0, unknown = -1; // others are components of the inside, from 1

// The largest squared distance between the line and the straightened one, in squares of the spacing, so that it follows
// dense points more closely. It is that in the plane, while the triangulation is that of the written vertices. No
// two costs are equal: of these, CGAL would first take the one of the line that has the lower address.
struct Relative_cost {
  const Vertex_map& vertex_at;

  template <class Constraints, class Iterator>
  double operator()(const Constraints&, Iterator q) const
  {
    const auto point = [&](const Kernel::Point_2& written) { return vertex_at.at(written)->point; };
    Iterator before = q, after = q;
    --before;
    ++after;
    const Kernel::Segment_2 straight(point((*before)->point()), point((*after)->point()));
    double cost = 0;
    typename Constraints::Points_in_constraint_iterator p(before), end(after);
    for(++p; p != end; ++p)
      cost = (std::max)(cost, CGAL::squared_distance(straight, point(*p)));
    const Outline_vertex& at_q = *vertex_at.at((*q)->point());
    const double spacing = at_q.spacing;
    return cost / (spacing * spacing) + 1e-9 * double(at_q.rank) / double(vertex_at.size());
  }
};

inline bool insert_loops(const std::vector<Outline_loop>& loops, Triangulation& triangulation, Vertex_map& vertex_at)
{
  for(const Outline_loop& loop : loops) {
    std::vector<Kernel::Point_2> points;
    for(const Outline_vertex& v : loop) {
      if(!std::isfinite(v.written.x()) || !std::isfinite(v.written.y()) || !vertex_at.emplace(v.written, &v).second)
        return false;
      points.push_back(v.written);
    }
    if(points.size() < 3)
      return false;
    triangulation.insert_constraint(points.begin(), points.end(), true);
  }
  for(Vertex_handle v : triangulation.finite_vertex_handles()) {
    const auto found = vertex_at.find(v->point());
    if(found == vertex_at.end())
      return false; // two lines cross
    if(found->second->stays())
      v->set_removable(false);
  }
  return true;
}

// From infinity inwards; each crossing of a line changes the side.
inline void mark_inside(const Triangulation& triangulation)
{
  for(Face_handle f : triangulation.all_face_handles())
    f->info() = unknown;
  int number_of_components = 0;
  std::vector<Face_handle> border = {triangulation.infinite_face()}, stack;
  std::vector<int> sides = {outside};
  for(std::size_t next = 0; next < border.size(); ++next) {
    if(border[next]->info() != unknown)
      continue;
    const int side = sides[next] == outside ? outside : ++number_of_components;
    border[next]->info() = side;
    for(stack.assign(1, border[next]); !stack.empty();) {
      const Face_handle f = stack.back();
      stack.pop_back();
      for(int i = 0; i < 3; ++i) {
        const Face_handle g = f->neighbor(i);
        if(g->info() != unknown)
          continue;
        if(triangulation.is_constrained({f, i})) {
          border.push_back(g);
          sides.push_back(side == outside ? 1 : outside);
          continue;
        }
        g->info() = side;
        stack.push_back(g);
      }
    }
  }
}

// There is an area, every vertex is one of the given ones, and two lines end there.
inline bool is_valid(const Triangulation& triangulation, const Vertex_map& vertex_at)
{
  if(triangulation.dimension() < 2)
    return false;
  for(Vertex_handle v : triangulation.finite_vertex_handles()) {
    if(vertex_at.count(v->point()) == 0)
      return false;
    int count = 0;
    auto e = triangulation.incident_edges(v);
    const auto end = e;
    do
      count += !triangulation.is_infinite(*e) && triangulation.is_constrained(*e);
    while(++e != end);
    if(count != 2)
      return false;
  }
  return true;
}

inline bool is_counterclockwise(const Polygon::Loop& loop, const std::vector<Outline_vertex>& vertices)
{
  std::vector<Kernel::Point_2> points;
  for(std::uint32_t i : loop)
    points.push_back(vertices[i].written);
  return CGAL::orientation_2(points.begin(), points.end(), Kernel()) == CGAL::COUNTERCLOCKWISE;
}

inline void extract_polygons(const Triangulation& triangulation, const Vertex_map& vertex_at,
                             std::vector<Outline_vertex>& vertices, std::vector<Polygon>& polygons)
{
  std::map<Vertex_handle, std::uint32_t> number;
  const auto number_of = [&](Vertex_handle v) {
    const auto added = number.emplace(v, std::uint32_t(vertices.size()));
    if(added.second)
      vertices.push_back(*vertex_at.at(v->point()));
    return added.first->second;
  };
  const auto polygon_of = [&](Face_handle f) -> Polygon& {
    if(polygons.size() < std::size_t(f->info()))
      polygons.resize(std::size_t(f->info()));
    return polygons[std::size_t(f->info()) - 1];
  };
  const auto is_inside = [](Face_handle f) { return f->info() > outside; };
  using Walk = Boundary_walk<Triangulation, decltype(is_inside)>;
  for(const auto& edges : Walk(triangulation, is_inside).loops()) {
    Polygon::Loop loop;
    for(const auto& e : edges)
      loop.push_back(number_of(Walk::source(e)));
    Polygon& polygon = polygon_of(edges[0].first);
    if(is_counterclockwise(loop, vertices))
      polygon.outer = loop;
    else
      polygon.holes.push_back(loop);
  }
  for(Face_handle f : triangulation.finite_face_handles())
    if(is_inside(f))
      polygon_of(f).triangles.push_back({number_of(f->vertex(0)), number_of(f->vertex(1)), number_of(f->vertex(2))});
}

// Straightens lines. What they become are polygons whose lines are simple and have no common points, as they are
// written. False if the lines, written or straightened, are not like that: then nothing is changed.
inline bool make_polygons(const std::vector<Outline_loop>& loops, double tolerance,
                          std::vector<Outline_vertex>& vertices, std::vector<Polygon>& polygons)
{
  if(loops.empty())
    return true;
  Triangulation triangulation;
  Vertex_map vertex_at;
  if(!insert_loops(loops, triangulation, vertex_at))
    return false;
  simplification::simplify(triangulation, Relative_cost{vertex_at},
                           simplification::Stop_above_cost_threshold(tolerance * tolerance));
  if(!is_valid(triangulation, vertex_at))
    return false;
  mark_inside(triangulation);
  extract_polygons(triangulation, vertex_at, vertices, polygons);
  return true;
}

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

  // Each loop becomes changed(loop) where that is not empty, but for those that would not be simple or apart then.
  template <class Changed>
  void change(Changed changed)
  {
    std::vector<Outline_loop> all = loops(), other;
    std::vector<std::size_t> positions;
    for(const Outline_loop& loop : all) {
      other.push_back(changed(loop));
      if(!other.back().empty())
        positions.push_back(other.size() - 1);
    }
    replace(all, other, positions.begin(), positions.end());
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

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_DRAFT_H
