// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Free edges that lie on the line of two planes are edges of that line like straight borders.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_EDGES_ON_LINES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_EDGES_ON_LINES_H

#include <CGAL/Shape_regularization_tandem/internal/outlines/Outline_draft.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// Adds to each draft the lines of its plane that other shapes have; plane_of(s) is a coplanar group.
template <class Plane_of>
void share_lines(std::vector<Outline_draft>& drafts, Plane_of plane_of)
{
  using Key = std::pair<int, int>;
  const auto key_of = [](const Border_line& line) { return Key(line.planes[0], line.planes[1]); };
  std::map<int, std::map<Key, Border_line>> lines_of_plane;
  for(const Outline_draft& draft : drafts)
    for(const Border_line& line : draft.lines)
      for(int plane : line.planes)
        lines_of_plane[plane].emplace(key_of(line), line);
  for(std::size_t s = 0; s < drafts.size(); ++s) {
    std::set<Key> own;
    for(const Border_line& line : drafts[s].lines)
      own.insert(key_of(line));
    for(const auto& [key, line] : lines_of_plane[plane_of(s)])
      if(own.count(key) == 0)
        drafts[s].lines.push_back(line);
  }
}

// Up to the rounding of coordinates.
inline bool is_on_line(const Outline_vertex& v, const Border_line& line)
{
  constexpr double rounding = 0x1p-45;
  const Kernel::Vector_3 d = Kernel::Point_3(v.position[0], v.position[1], v.position[2]) - line.origin;
  return CGAL::cross_product(d, line.direction).squared_length() <= rounding * rounding;
}

// Of the loop, with the vertices of such edges where canonical(vertex, line) puts them. Empty if there is none.
template <class Canonical>
Outline_loop with_edges_on_lines(const Outline_loop& loop, const std::vector<Border_line>& lines, Canonical canonical)
{
  Outline_loop result = loop;
  bool is_changed = false;
  const std::size_t n = loop.size();
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t l = 0; l < lines.size() && result[i].border < 0; ++l) {
      if(!is_on_line(loop[i], lines[l]) || !is_on_line(loop[(i + 1) % n], lines[l]))
        continue;
      result[i].border = int(l);
      is_changed = true;
      for(std::size_t k : {i, (i + 1) % n})
        if(!result[k].is_fixed)
          result[k] = canonical(result[k], lines[l]);
    }
  return is_changed ? result : Outline_loop();
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_OUTLINES_EDGES_ON_LINES_H
