// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edges of an outline become parallel to given directions where the points permit it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_REGULAR_LOOP_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_REGULAR_LOOP_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Edge_runs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// A run of edges becomes an edge on its line, which is at the median of its points, or goes through the end of a straight
// border where the points permit that, too. Edges in no run stay.
class Regular_loop {
public:
  Regular_loop(const Border_points& border, const std::vector<Kernel::Vector_2>& directions)
    : border(border), directions(directions), size(border.size()), found(border, directions), runs(found.all())
  {}

  Outline_loop loop() const
  {
    const std::vector<Element> elements = without_bevels(all_elements());
    Outline_loop result;
    for(std::size_t i = 0; i < elements.size() && elements.size() > 1; ++i)
      join(elements[i], elements[(i + 1) % elements.size()], result);
    const double fraction = result.size() < 3 ? 0 : twice_area(result) / twice_area(border.loop());
    return fraction > smallest_fraction && fraction * smallest_fraction < 1 ? result : border.loop();
  }

  // f(an end of a straight border, as its number in the loop, and where the line of the run behind it crosses the border)
  template <class Function>
  void for_each_wanted_end(Function f) const
  {
    for(const Run& run : runs)
      for(const bool is_first : {true, false}) {
        const std::size_t i = is_first ? run.first : (run.first + run.count) % size;
        const std::size_t along = is_first ? (i + size - 1) % size : i; // the other edge
        const Outline_vertex& v = border.vertex(i);
        if(!v.is_fixed || border.is_free(along))
          continue;
        const Kernel::Vector_2 w = border.vertex(is_first ? along : i + 1).point - v.point;
        const Kernel::Vector_2& d = directions[run.direction];
        const double rise = d.x() * w.y() - d.y() * w.x(), length = std::sqrt(w.squared_length());
        const double step = (run.median - Border_points::offset(v.point, d)) / rise;
        if(std::fabs(rise) >= smallest_sine * length && std::fabs(step) * length <= farthest * v.spacing)
          f(i, v.point + step * w);
      }
  }

private:
  static constexpr std::size_t none = Edge_runs::none;
  static constexpr double smallest_fraction = .5; // of the area that remains: a narrow piece could become a line
  static constexpr double farthest = 3;           // of an intersection from the vertex that it replaces, in spacings

  using Run = Edge_runs::Run;
  // Of the new loop: a run, or an edge that stays.
  struct Element {
    std::size_t first, count, run;
  };

  // --- The loop

  // From the first edge that begins an element.
  std::vector<Element> all_elements() const
  {
    const auto begins = [&](std::size_t i) {
      return found.of_edge(i) == none || found.of_edge(i) != found.of_edge((i + size - 1) % size) ||
             runs[found.of_edge(i)].first == i;
    };
    std::size_t start = 0;
    while(start < size && !begins(start))
      ++start;
    std::vector<Element> result;
    for(std::size_t i = 0; i < size && start < size; ++i) {
      const std::size_t edge = (start + i) % size;
      if(begins(edge))
        result.push_back({edge, 0, found.of_edge(edge)});
      ++result.back().count;
    }
    return result;
  }

  // Edges between two runs that intersect vanish if their points are close to the lines of the runs.
  std::vector<Element> without_bevels(const std::vector<Element>& elements) const
  {
    const std::size_t n = elements.size();
    std::vector<char> is_bevel(n, 0);
    for(std::size_t a = 0; a < n; ++a) {
      if(elements[a].run == none)
        continue;
      std::size_t b = a + 1;
      while(b < a + n && elements[b % n].run == none)
        ++b;
      if(b < a + n && b > a + 1 && is_bevel_between(elements, a, b))
        for(std::size_t i = a + 1; i < b; ++i)
          is_bevel[i % n] = 1;
    }
    std::vector<Element> result;
    for(std::size_t i = 0; i < n; ++i)
      if(!is_bevel[i])
        result.push_back(elements[i]);
    return result;
  }

  bool is_bevel_between(const std::vector<Element>& elements, std::size_t a, std::size_t b) const
  {
    const std::size_t n = elements.size();
    const Run &before = runs[elements[a].run], &after = runs[elements[b % n].run];
    if(std::fabs(sine_between(before, after)) < smallest_sine)
      return false;
    bool result = true;
    for(std::size_t i = a + 1; i <= b && result; ++i) {
      const Element& e = elements[i % n];
      result = !border.vertex(e.first).stays();
      if(i == b || !result)
        break;
      result = border.is_free(e.first);
      border.for_each_point(e.first, [&](const Kernel::Point_2& p) {
        const double distance = (std::min)(distance_to(before, p), distance_to(after, p));
        result = result && distance <= border.tolerance * border.spacing(e.first);
      });
    }
    return result;
  }

  double distance_to(const Run& run, const Kernel::Point_2& p) const
  {
    return std::fabs(Border_points::offset(p, directions[run.direction]) - run.offset);
  }

  double sine_between(const Run& a, const Run& b) const
  {
    const Kernel::Vector_2 &u = directions[a.direction], &v = directions[b.direction];
    return u.x() * v.y() - u.y() * v.x();
  }

  Kernel::Point_2 foot(const Run& run, const Kernel::Point_2& p) const
  {
    const Kernel::Vector_2 left = directions[run.direction].perpendicular(CGAL::COUNTERCLOCKWISE);
    return p + (run.offset - (p - CGAL::ORIGIN) * left) * left;
  }

  Kernel::Point_2 intersection(const Run& a, const Run& b) const
  {
    const Kernel::Vector_2 &u = directions[a.direction], &v = directions[b.direction];
    const double sine = sine_between(a, b);
    return CGAL::ORIGIN + (a.offset / sine) * v - (b.offset / sine) * u;
  }

  void add(const Outline_vertex& like, const Kernel::Point_2& point, Outline_loop& result) const
  {
    if(!result.empty() && CGAL::squared_distance(result.back().point, point) < 1e-12 * like.spacing * like.spacing)
      return;
    result.push_back({point, like.spacing, false, {}, point});
  }

  // What is between the two elements; the border of a vertex is that of the edge behind it.
  void join(const Element& a, const Element& b, Outline_loop& result) const
  {
    const Outline_vertex &end = border.vertex(a.first + a.count), &begin = border.vertex(b.first);
    const bool is_run_before = a.run != none, is_run_after = b.run != none;
    if(is_run_before && is_run_after && !begin.stays()) {
      const Run &before = runs[a.run], &after = runs[b.run];
      if(std::fabs(sine_between(before, after)) >= smallest_sine) {
        const Kernel::Point_2 x = intersection(before, after);
        const double largest = farthest * begin.spacing;
        if((std::min)(CGAL::squared_distance(x, end.point), CGAL::squared_distance(x, begin.point)) <=
           largest * largest) {
          add(begin, x, result);
          return;
        }
      }
    }
    if(is_run_before && !is_spike(runs[a.run], end, border.vertex(b.first + 1), b.run))
      add(end, foot(runs[a.run], end.point), result);
    if(begin.stays() || (!is_run_before && !is_run_after)) {
      if(begin.stays() && !result.empty() && !result.back().stays() &&
         CGAL::squared_distance(result.back().point, begin.point) < 1e-12 * begin.spacing * begin.spacing)
        result.pop_back();
      result.push_back(begin);
    }
    if(is_run_after && !is_spike(runs[b.run], begin, border.vertex(a.first), a.run))
      add(begin, foot(runs[b.run], begin.point), result);
  }

  // Whether the foot of an end of a straight border is above the border, which goes to the other vertex.
  bool is_spike(const Run& run, const Outline_vertex& end, const Outline_vertex& other, std::size_t run_of_border) const
  {
    if(!end.stays() || run_of_border != none)
      return false;
    const Kernel::Vector_2 f = foot(run, end.point) - end.point, w = other.point - end.point;
    const double sine = f.x() * w.y() - f.y() * w.x();
    return f * w > 0 && sine * sine < smallest_sine * smallest_sine * f.squared_length() * w.squared_length();
  }

  const Border_points& border;
  const std::vector<Kernel::Vector_2>& directions;
  std::size_t size; // of the loop
  Edge_runs found;
  const std::vector<Run>& runs;
};

// --- Holes of windows and doors as rectangles

// A rectangle with sides of a given direction, at the medians of the points that are closest to each.
class Fitted_rectangle {
public:
  Fitted_rectangle(const Border_points& border, const Kernel::Vector_2& direction)
    : border(border), axes{direction, direction.perpendicular(CGAL::COUNTERCLOCKWISE)}
  {
    for(const Outline_vertex& v : border.all_points())
      for(std::size_t k = 0; k < 2; ++k)
        ranges[k].add((v.point - CGAL::ORIGIN) * axes[k]);
    for(int round = 0; round < rounds; ++round)
      fit();
  }

  // The points are as close to it as to edges of other outlines.
  bool fits() const
  {
    double sum = 0;
    for(const Outline_vertex& v : border.all_points()) {
      const double d = distance(v.point) / v.spacing;
      if(!(d <= largest_distance))
        return false;
      sum += d;
    }
    return sum <= border.tolerance / 2 * double(border.all_points().size()) && ranges[0].low < ranges[0].high &&
           ranges[1].low < ranges[1].high;
  }

  // Clockwise.
  Outline_loop loop() const
  {
    const Range &x = ranges[0], &y = ranges[1];
    Outline_loop result;
    for(const auto& [a, b] :
        {std::array<double, 2>{x.low, y.low}, {x.low, y.high}, {x.high, y.high}, {x.high, y.low}}) {
      const Kernel::Point_2 p = CGAL::ORIGIN + a * axes[0] + b * axes[1];
      result.push_back({p, border.vertex(0).spacing, false, {}, p});
    }
    return result;
  }

private:
  using Range = Border_points::Range;
  static constexpr int rounds = 3;
  static constexpr double largest_distance = 1.5; // of a point, in spacings

  std::array<double, 4> distances_to_sides(const Kernel::Point_2& p) const
  {
    const double x = (p - CGAL::ORIGIN) * axes[0], y = (p - CGAL::ORIGIN) * axes[1];
    return {x - ranges[0].low, ranges[0].high - x, y - ranges[1].low, ranges[1].high - y};
  }

  void fit()
  {
    std::array<std::vector<double>, 4> of_sides;
    for(const Outline_vertex& v : border.all_points()) {
      const std::array<double, 4> d = distances_to_sides(v.point);
      const std::size_t side = std::size_t(
        std::min_element(d.begin(), d.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
        d.begin());
      of_sides[side].push_back((v.point - CGAL::ORIGIN) * axes[side / 2]);
    }
    for(std::size_t side = 0; side < 4; ++side) {
      std::vector<double>& all = of_sides[side];
      if(!all.empty())
        (side % 2 == 0 ? ranges[side / 2].low : ranges[side / 2].high) = median(all);
    }
  }

  double distance(const Kernel::Point_2& p) const
  {
    const std::array<double, 4> d = distances_to_sides(p);
    const double inside = *std::min_element(d.begin(), d.end());
    if(inside >= 0)
      return inside;
    return std::hypot((std::max)({-d[0], -d[1], 0.}), (std::max)({-d[2], -d[3], 0.}));
  }

  const Border_points& border;
  std::array<Kernel::Vector_2, 2> axes;
  Range ranges[2];
};

// Empty if there is none. Directions come in pairs.
inline Outline_loop rectangle_of_hole(const Border_points& border, const std::vector<Kernel::Vector_2>& directions)
{
  const Outline_loop& hole = border.loop();
  if(twice_area(hole) >= 0 || std::any_of(hole.begin(), hole.end(), [](const Outline_vertex& v) { return v.stays(); }))
    return {};
  for(std::size_t d = 0; d < directions.size(); d += 2) {
    const Fitted_rectangle rectangle(border, directions[d]);
    if(rectangle.fits())
      return rectangle.loop();
  }
  return {};
}

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_REGULAR_LOOP_H
