// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the outline of a shape follows a line and another outline along that line begins or ends, it has that vertex, too.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_VERTICES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_VERTICES_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// --- Free edges that lie on the line of two planes are edges of that line like straight borders

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

// The vertices of all outlines on each line of two planes.
class Common_vertices {
public:
  void add(const Outline_draft& draft)
  {
    for(const Outline_loop& loop : draft.loops())
      for(std::size_t i = 0; i < loop.size(); ++i)
        if(loop[i].border >= 0)
          for(const Outline_vertex* v : {&loop[i], &loop[(i + 1) % loop.size()]}) {
            const Border_line& line = draft.lines[std::size_t(loop[i].border)];
            on_line[key_of(line)].emplace_back(along(line, *v), v->position);
          }
  }

  void sort()
  {
    for(auto& [line, vertices] : on_line) {
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
  }

  // Of vertices of a line that differ by the rounding of coordinates, one becomes that of all.
  void join()
  {
    for(const auto& [line, vertices] : on_line)
      for(std::size_t i = 1; i < vertices.size(); ++i)
        if(vertices[i].first - vertices[i - 1].first <= rounding) {
          const Position a = joined(vertices[i - 1].second), b = joined(vertices[i].second);
          if(a != b)
            joined_with[(std::max)(a, b)] = (std::min)(a, b);
        }
  }

  // What the vertex is after that.
  Position joined(Position p) const
  {
    for(auto found = joined_with.find(p); found != joined_with.end(); found = joined_with.find(p))
      p = found->second;
    return p;
  }

  // f(position of the loop, the loop with further vertices), where there are any.
  template <class Make_vertex, class Function>
  void for_each_longer_loop(const Outline_draft& draft, Make_vertex make_vertex, Function f) const
  {
    const std::vector<Outline_loop> loops = draft.loops();
    for(std::size_t l = 0; l < loops.size(); ++l) {
      Outline_loop longer;
      for(std::size_t i = 0; i < loops[l].size(); ++i) {
        const Outline_vertex& v = loops[l][i];
        longer.push_back(v);
        if(v.border >= 0)
          for(const Position& p : between(draft, v, loops[l][(i + 1) % loops[l].size()])) {
            longer.push_back(make_vertex(v, p));
            longer.back().border = v.border;
          }
      }
      if(longer.size() > loops[l].size())
        f(l, longer);
    }
  }

private:
  using Key = std::pair<int, int>;
  using Vertex = std::pair<double, Position>; // position along the line, and in space

  // Vertices that are as close as the rounding of coordinates are one.
  static constexpr double rounding = 0x1p-48;

  static Key key_of(const Border_line& line) { return {line.planes[0], line.planes[1]}; }
  static double along(const Border_line& line, const Outline_vertex& v)
  {
    return line.along(Kernel::Point_3(v.position[0], v.position[1], v.position[2]));
  }

  // In the order of the edge.
  std::vector<Position> between(const Outline_draft& draft, const Outline_vertex& u, const Outline_vertex& v) const
  {
    const Border_line& line = draft.lines[std::size_t(u.border)];
    const double a = along(line, u), b = along(line, v), low = (std::min)(a, b), high = (std::max)(a, b);
    std::vector<Position> result;
    const auto& all = on_line.at(key_of(line));
    for(auto i = std::upper_bound(all.begin(), all.end(), Vertex(low + rounding, Position{})); i != all.end(); ++i) {
      if(i->first >= high - rounding)
        break;
      result.push_back(i->second);
    }
    if(a > b)
      std::reverse(result.begin(), result.end());
    return result;
  }

  std::map<Key, std::vector<Vertex>> on_line;
  std::map<Position, Position> joined_with; // the smaller one
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_VERTICES_H
