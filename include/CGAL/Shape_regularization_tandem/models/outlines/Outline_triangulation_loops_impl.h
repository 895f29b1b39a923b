// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_LOOPS_IMPL_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_LOOPS_IMPL_H

#include <CGAL/Shape_regularization_tandem/models/outlines/boundary_loops.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

inline bool Outline_triangulation::share_border(Vertex_handle u, Vertex_handle v, int* border) const
{
  if(u->info().border < 0 || v->info().border < 0)
    return false;
  const auto& of_u = border_vertices[std::size_t(u->info().border)].borders;
  const auto& of_v = border_vertices[std::size_t(v->info().border)].borders;
  const auto common = std::find_first_of(of_u.begin(), of_u.end(), of_v.begin(), of_v.end());
  if(common == of_u.end())
    return false;
  *border = *common;
  return true;
}

// Of a straight border, only the ends remain.
inline Outline_loop Outline_triangulation::straight_loop(const std::vector<Vertex_handle>& loop) const
{
  Outline_loop result;
  const std::size_t n = loop.size();
  for(std::size_t i = 0; i < n; ++i) {
    const Vertex_handle v = loop[i];
    int before = -1, after = -1;
    const bool is_after = share_border(loop[(i + n - 1) % n], v, &before);
    const bool is_before = share_border(v, loop[(i + 1) % n], &after);
    if(is_after && is_before && before == after)
      continue;
    const bool is_fixed = is_after || is_before;
    result.push_back({v->point(), v->info().spacing, is_fixed, {}, v->point()});
    result.back().border = is_before ? after : -1;
    if(is_fixed) {
      const Border_vertex& vertex = border_vertices[std::size_t(v->info().border)];
      result.back().position = vertex.position;
      result.back().is_corner = vertex.is_corner;
    }
  }
  return result;
}

inline std::vector<Outline_loop> Outline_triangulation::outline(const Outline_limits& limits)
{
  if(!has_area)
    return {};
  mark_inside(limits);
  drop_crumbs(limits);
  separate_pieces();
  drop_crumbs(limits);
  const auto is_inside = [](Face_handle f) { return f->info().is_inside; };
  std::vector<Outline_loop> result;
  using Walk = Boundary_walk<Triangulation, decltype(is_inside)>;
  for(const auto& edges : Walk(triangulation, is_inside).loops()) {
    std::vector<Vertex_handle> loop;
    for(const auto& e : edges)
      loop.push_back(Walk::source(e));
    result.push_back(straight_loop(loop));
  }
  return result;
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_LOOPS_IMPL_H
