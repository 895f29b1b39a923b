// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A straightened loop of an outline, and the points along each of its edges.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_POINTS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_POINTS_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_vertex.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

class Border_points {
public:
  struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
    void add(double x)
    {
      low = (std::min)(low, x);
      high = (std::max)(high, x);
    }
    void add(const Range& other)
    {
      add(other.low);
      add(other.high);
    }
    double length() const { return high - low; }
  };

  static constexpr double tolerance = 1; // of regular edges, in spacings

  // `dense` has the vertices from before the loop was straightened.
  Border_points(const Outline_loop& straight, const Outline_loop& dense) : straight(straight), dense(dense) {}

  const Outline_loop& loop() const { return straight; }
  const Outline_loop& all_points() const { return dense; }
  std::size_t size() const { return straight.size(); }
  const Outline_vertex& vertex(std::size_t i) const { return straight[i % straight.size()]; }

  // Edge i begins at vertex i.
  bool is_free(std::size_t edge) const { return straight[edge].border < 0; }
  double spacing(std::size_t edge) const { return (double(vertex(edge).spacing) + vertex(edge + 1).spacing) / 2; }

  // f(a point of the edge), its ends included, but for those of straight borders, if there are others.
  template <class Function>
  void for_each_point(std::size_t edge, Function f) const
  {
    const std::size_t n = dense.size(), first = vertex(edge).rank - dense[0].rank;
    const std::size_t last = vertex(edge + 1).rank - dense[0].rank;
    for(std::size_t i = (first + 1) % n; i != last; i = (i + 1) % n)
      f(dense[i].point);
    const bool has_none = (first + 1) % n == last && vertex(edge).stays() && vertex(edge + 1).stays();
    for(std::size_t i : {edge, edge + 1})
      if(has_none || !vertex(i).stays())
        f(vertex(i).point);
  }

  // How far to the left of the line through the origin.
  static double offset(const Kernel::Point_2& p, const Kernel::Vector_2& direction)
  {
    return direction.x() * p.y() - direction.y() * p.x();
  }

  Range offsets(std::size_t edge, const Kernel::Vector_2& direction) const
  {
    Range result;
    for_each_point(edge, [&](const Kernel::Point_2& p) { result.add(offset(p, direction)); });
    return result;
  }

private:
  const Outline_loop &straight, &dense;
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_POINTS_H
