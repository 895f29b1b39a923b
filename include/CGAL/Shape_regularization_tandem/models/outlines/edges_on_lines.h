// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Free edges that lie on the line of two planes are edges of that line like straight borders.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_EDGES_ON_LINES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_EDGES_ON_LINES_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

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

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_EDGES_ON_LINES_H
