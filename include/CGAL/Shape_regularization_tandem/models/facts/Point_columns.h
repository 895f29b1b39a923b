// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is above, below and beside a shape: the classes of shapes.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_POINT_COLUMNS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_POINT_COLUMNS_H

#include <CGAL/Shape_regularization_tandem/models/Shape_facts.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::facts {

// The points of shapes in vertical columns, which are squares as seen from above.
class Point_columns {
public:
  // x, y: horizontal; width: of a column
  Point_columns(const Vector& x, const Vector& y, const Vector& up, double width)
    : x(x), y(y), up(up), width(width), clearance(2 * width)
  {}

  static bool is_upright(double dip_deg) { return dip_deg >= 90 - level_deg; }

  // The points of a shape, before the first question. Those that are too far away are left out.
  void add(const std::vector<Vector>& points, std::size_t shape, bool is_upright)
  {
    constexpr double largest = 1 << 30;
    std::map<Column, Span> own;
    for(const Vector& p : points) {
      const double i = std::floor(dot(x, p) / width), j = std::floor(dot(y, p) / width), height = dot(up, p);
      if(!(std::fabs(i) <= largest && std::fabs(j) <= largest))
        continue;
      const Column column = {int(i), int(j)};
      Span& span = own.emplace(column, Span{column, shape, is_upright, height, height}).first->second;
      span.lowest = (std::min)(span.lowest, height);
      span.highest = (std::max)(span.highest, height);
    }
    for(const auto& entry : own)
      spans.push_back(entry.second);
  }

  void sort(std::size_t number_of_shapes)
  {
    std::sort(spans.begin(), spans.end(),
              [](const Span& s, const Span& t) { return std::tie(s.column, s.shape) < std::tie(t.column, t.shape); });
    of_shape.resize(number_of_shapes);
    for(std::size_t i = 0; i < spans.size(); ++i)
      of_shape[spans[i].shape].push_back(i);
  }

  // Of a shape whose plane has this angle with the level.
  Shape_class class_of(std::size_t shape, double dip_deg) const
  {
    constexpr double steepest_ground_deg = 25;
    if(is_upright(dip_deg))
      return Shape_class::wall;
    if(of_shape[shape].empty())
      return Shape_class::none;
    const Surroundings s = surroundings(shape);
    const bool is_level = dip_deg <= level_deg;
    const bool is_covered = 2 * s.covered > s.columns, has_floor = 2 * s.raised > s.columns;
    const bool is_top = s.lower > s.higher && 4 * s.lower >= s.ends;
    if(is_covered)
      return !is_level                           ? Shape_class::slanted
             : has_floor && s.headroom < s.depth ? Shape_class::ceiling
                                                 : Shape_class::floor;
    if(has_floor)
      return is_level && !is_top ? Shape_class::ceiling : Shape_class::roof;
    if(is_top)
      return Shape_class::roof;
    if(is_level && 4 * s.walled >= 3 * s.ends)
      return Shape_class::floor;
    return dip_deg <= steepest_ground_deg ? Shape_class::ground : Shape_class::slanted;
  }

private:
  using Column = std::array<int, 2>;

  struct Span {
    Column column;
    std::size_t shape;
    bool is_upright;
    double lowest, highest;
  };

  // Numbers of columns, and sums of heights.
  struct Surroundings {
    std::size_t columns = 0;             // of the shape
    std::size_t covered = 0, raised = 0; // with other points above, and below
    double headroom = 0, depth = 0;      // to the closest points, where there are some above and below
    std::size_t ends = 0;                // of rows of columns along both axes
    std::size_t higher = 0, walled = 0;  // with higher points there, and with those of an upright shape
    std::size_t lower = 0;               // without higher points, and with lower points only beyond
  };

  template <class Function>
  void for_each_span(const Column& column, Function f) const
  {
    auto span =
      std::lower_bound(spans.begin(), spans.end(), column, [](const Span& s, const Column& c) { return s.column < c; });
    for(; span != spans.end() && span->column == column; ++span)
      f(*span);
  }

  // The highest span of a column, or nothing.
  const Span* highest_in(const Column& column) const
  {
    const Span* result = nullptr;
    for_each_span(column,
                  [&](const Span& s) { result = result == nullptr || s.highest > result->highest ? &s : result; });
    return result;
  }

  Surroundings surroundings(std::size_t shape) const
  {
    Surroundings s;
    using Ends = std::pair<const Span*, const Span*>;
    std::array<std::map<int, Ends>, 2> rows; // at a place of one axis, along the other one
    for(std::size_t i : of_shape[shape]) {
      const Span& own = spans[i];
      add_column(own, s);
      for(std::size_t along : {0, 1}) // along which columns ascend
        rows[along].emplace(own.column[1 - along], Ends(&own, &own)).first->second.second = &own;
    }
    for(std::size_t along : {0, 1})
      for(const auto& row : rows[along]) {
        add_end(*row.second.first, along, -1, s);
        add_end(*row.second.second, along, 1, s);
      }
    return s;
  }

  // What is above and below.
  void add_column(const Span& own, Surroundings& s) const
  {
    double above = HUGE_VAL, below = HUGE_VAL;
    bool is_covered = false, is_raised = false;
    for_each_span(own.column, [&](const Span& other) {
      if(other.shape == own.shape)
        return;
      is_covered = is_covered || other.highest > own.highest + clearance;
      is_raised = is_raised || other.lowest < own.lowest - clearance;
      if(other.lowest > own.highest)
        above = (std::min)(above, other.lowest - own.highest);
      if(other.highest < own.lowest)
        below = (std::min)(below, own.lowest - other.highest);
    });
    ++s.columns;
    s.covered += is_covered ? 1 : 0;
    s.raised += is_raised ? 1 : 0;
    if(above < HUGE_VAL && below < HUGE_VAL) {
      s.headroom += above;
      s.depth += below;
    }
  }

  // What is there, and beyond.
  void add_end(const Span& own, std::size_t along, int step, Surroundings& s) const
  {
    Column column = own.column;
    const Span *highest = &own, *beyond = nullptr;
    for(int i = 0; i <= beside; ++i, column[along] += step) {
      beyond = highest_in(column);
      highest = beyond != nullptr && beyond->highest > highest->highest ? beyond : highest;
    }
    const bool is_higher = highest->highest > own.highest + clearance;
    ++s.ends;
    s.higher += is_higher ? 1 : 0;
    s.walled += is_higher && highest->is_upright ? 1 : 0;
    s.lower += !is_higher && beyond != nullptr && beyond->highest < own.lowest - clearance ? 1 : 0;
  }

  static constexpr double level_deg = 10; // of angles that are level, or upright
  static constexpr int beside = 2;        // columns away: behind a wall at the border

  Vector x, y, up;
  double width;
  double clearance; // what is less above or below a shape is beside it
  std::vector<Span> spans;
  std::vector<std::vector<std::size_t>> of_shape;
};

} // namespace CGAL::Tandem::internal::facts

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_POINT_COLUMNS_H
