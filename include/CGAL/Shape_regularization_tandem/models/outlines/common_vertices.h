// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_VERTICES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_VERTICES_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/outline_types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// --- Shapes that meet at a line end at the same vertices of it

// An end of a piece: of its two ends, the one that `which` says.
struct Piece_end {
  Border_piece* piece;
  std::size_t shape;
  int which;

  Border_piece::End& end() const { return piece->ends[which]; }
};

inline void move(const Piece_end& e, double along, int third)
{
  const Border_piece::End before = e.end();
  e.end().along = along;
  e.end().third = third;
  if(!(e.piece->length() > e.piece->spacing))
    e.end() = before;
}

// The third plane of an end is neither of its own two: it can be that of another shape's end.
inline void move_to_corner(const Piece_end& e, const std::vector<Piece_end>& ends)
{
  const Piece_end* nearest = nullptr;
  const auto distance = [&](const Piece_end& other) { return std::fabs(other.end().along - e.end().along); };
  for(const Piece_end& other : ends)
    if(other.end().third >= 0 && other.shape != e.shape && (nearest == nullptr || distance(other) < distance(*nearest)))
      nearest = &other;
  if(nearest != nullptr && distance(*nearest) <= e.piece->reach)
    move(e, nearest->end().along, nearest->end().third);
}

inline bool belongs(const Piece_end& e, const std::vector<Piece_end>& cluster)
{
  const auto is_own = [&](const Piece_end& other) { return other.shape == e.shape; };
  const double span = e.end().along - cluster.front().end().along;
  return span <= (std::min)(e.piece->reach, cluster.front().piece->reach) &&
         std::none_of(cluster.begin(), cluster.end(), is_own);
}

inline void move_to_mean(std::vector<Piece_end>& cluster)
{
  double sum = 0;
  for(const Piece_end& e : cluster)
    sum += e.end().along;
  const double mean = sum / double(cluster.size());
  if(cluster.size() > 1)
    for(const Piece_end& e : cluster)
      move(e, mean, -1);
  cluster.clear();
}

// The first ends of the pieces of a line, or the second ones, in its direction. Ends at corners stay. Others that are
// close to one move there, and the rest become the mean of those that are close to each other. An end moves by at most
// the reach of its piece.
inline void join_ends(std::vector<Piece_end>& ends)
{
  std::stable_sort(ends.begin(), ends.end(),
                   [](const Piece_end& a, const Piece_end& b) { return a.end().along < b.end().along; });
  for(const Piece_end& e : ends)
    if(e.end().third < 0)
      move_to_corner(e, ends);
  std::vector<Piece_end> cluster;
  for(const Piece_end& e : ends) {
    if(e.end().third >= 0)
      continue;
    if(!cluster.empty() && !belongs(e, cluster))
      move_to_mean(cluster);
    cluster.push_back(e);
  }
  move_to_mean(cluster);
}

// `all` has the pieces of each shape.
inline void join_common_ends(std::vector<Border_pieces>& all)
{
  std::map<std::array<int, 2>, std::vector<Piece_end>> of_line[2];
  for(std::size_t s = 0; s < all.size(); ++s)
    for(Border_piece& piece : all[s])
      for(int which : {0, 1})
        of_line[which][piece.line.planes].push_back({&piece, s, which});
  for(auto& lines : of_line)
    for(auto& [line, ends] : lines)
      join_ends(ends);
}

// --- The ends of straight borders that are no corners move to where the regular edges behind them begin: to the mean of what
// the shapes that have them want.

// A vertex on a line, and where it is to be.
struct Wanted_end {
  Position position;
  Border_line line;
  Kernel::Point_3 wanted;
};

class Moved_ends {
public:
  // All edges on lines that the shapes have.
  void add_edges(const Outline_draft& draft)
  {
    for(const Outline_loop& loop : draft.loops())
      for(std::size_t i = 0; i < loop.size(); ++i) {
        const Outline_vertex &u = loop[i], &v = loop[(i + 1) % loop.size()];
        if(u.border < 0)
          continue;
        const double length = std::sqrt(CGAL::squared_distance(u.point, v.point));
        for(const Outline_vertex* w : {&u, &v}) {
          End& end = ends[w->position];
          end.shortest_edge = (std::min)(end.shortest_edge, length);
        }
        if(v.border >= 0 && v.border != u.border)
          ends[v.position].is_corner = true;
        for(const Outline_vertex* w : {&u, &v})
          ends[w->position].is_corner |= w->is_corner;
      }
  }

  void add_wish(const Wanted_end& wish)
  {
    const Border_line& line = wish.line;
    End& end = ends[wish.position];
    end.is_corner |= end.count > 0 && end.line.planes != line.planes;
    end.line = line;
    end.sum += line.along(wish.wanted);
    ++end.count;
  }

  // position_on(a line, a place along it) is the vertex there.
  template <class Position_on>
  void decide(Position_on position_on)
  {
    for(auto& [position, end] : ends) {
      if(end.count == 0 || end.is_corner)
        continue;
      const double mean = end.sum / end.count;
      const double before = end.line.along(point_at(position));
      if(std::fabs(mean - before) < end.shortest_edge / 3)
        moved[position] = position_on(end.line, mean);
    }
  }

  // Null, if the vertex stays.
  const Position* moved_from(const Position& position) const
  {
    const auto found = moved.find(position);
    return found == moved.end() ? nullptr : &found->second;
  }

private:
  struct End {
    double shortest_edge = std::numeric_limits<double>::infinity();
    bool is_corner = false;
    Border_line line = {};
    double sum = 0; // of the wanted places
    int count = 0;
  };

  std::map<Position, End> ends;
  std::map<Position, Position> moved;
};

// --- Free edges that lie on the line of two planes are edges of that line like straight borders

// Up to the rounding of coordinates.
inline bool is_on_line(const Outline_vertex& v, const Border_line& line)
{
  constexpr double rounding = 0x1p-45;
  const Kernel::Vector_3 d = point_at(v.position) - line.origin;
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

// --- Where the outline of a shape follows a line and another outline along that line begins or ends, it has that vertex, too

// The vertices of all outlines on each line of two planes.
class Common_vertices {
public:
  explicit Common_vertices(const std::vector<Outline_draft>& drafts)
  {
    for(const Outline_draft& draft : drafts)
      for(const Outline_loop& loop : draft.loops())
        for(std::size_t i = 0; i < loop.size(); ++i)
          if(loop[i].border >= 0)
            for(const Outline_vertex* v : {&loop[i], &loop[(i + 1) % loop.size()]}) {
              const Border_line& line = draft.lines[std::size_t(loop[i].border)];
              on_line[line.planes].emplace_back(along(line, *v), v->position);
            }
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

  // The loop of a draft with further vertices, make_vertex(the one before, position). Empty if there are none.
  template <class Make_vertex>
  Outline_loop longer(const Outline_draft& draft, const Outline_loop& loop, Make_vertex make_vertex) const
  {
    Outline_loop result;
    for(std::size_t i = 0; i < loop.size(); ++i) {
      const Outline_vertex& v = loop[i];
      result.push_back(v);
      if(v.border >= 0)
        for(const Position& p : between(draft, v, loop[(i + 1) % loop.size()])) {
          result.push_back(make_vertex(v, p));
          result.back().border = v.border;
        }
    }
    return result.size() > loop.size() ? result : Outline_loop();
  }

private:
  using Vertex = std::pair<double, Position>; // position along the line, and in space

  // Vertices that are as close as the rounding of coordinates are one.
  static constexpr double rounding = 0x1p-48;

  static double along(const Border_line& line, const Outline_vertex& v) { return line.along(point_at(v.position)); }

  // In the order of the edge.
  std::vector<Position> between(const Outline_draft& draft, const Outline_vertex& u, const Outline_vertex& v) const
  {
    const Border_line& line = draft.lines[std::size_t(u.border)];
    const double a = along(line, u), b = along(line, v), low = (std::min)(a, b), high = (std::max)(a, b);
    std::vector<Position> result;
    const auto& all = on_line.at(line.planes);
    for(auto i = std::upper_bound(all.begin(), all.end(), Vertex(low + rounding, Position{})); i != all.end(); ++i) {
      if(i->first >= high - rounding)
        break;
      result.push_back(i->second);
    }
    if(a > b)
      std::reverse(result.begin(), result.end());
    return result;
  }

  std::map<std::array<int, 2>, std::vector<Vertex>> on_line; // by the planes of the line
  std::map<Position, Position> joined_with;                  // the smaller one
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_COMMON_VERTICES_H
