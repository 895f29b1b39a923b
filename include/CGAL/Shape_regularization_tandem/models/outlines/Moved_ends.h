// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ends of straight borders that are no corners move to where the regular edges behind them begin: to the mean of what
// the shapes that have them want.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_MOVED_ENDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_MOVED_ENDS_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

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
    end.is_corner |= end.count > 0 && (end.line.planes[0] != line.planes[0] || end.line.planes[1] != line.planes[1]);
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
      const double before = end.line.along(Kernel::Point_3(position[0], position[1], position[2]));
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

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_MOVED_ENDS_H
