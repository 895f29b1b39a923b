// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edges of an outline that one line of a given direction can replace.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_EDGE_RUNS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_EDGE_RUNS_H

#include <CGAL/Shape_regularization_tandem/models/outlines/outline_types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// --- A straightened loop of an outline, and the points along each of its edges

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

// A *run* is a sequence of edges whose border points are within the tolerance of one line of a given direction. The
// longest run comes first.
class Edge_runs {
public:
  struct Run {
    std::size_t first = 0, count = 0, direction = 0;
    double length = 0, offset = 0;
    double median = 0; // of the offsets of its points
  };

  static constexpr std::size_t none = std::size_t(-1);

  Edge_runs(const Border_points& border, const std::vector<Kernel::Vector_2>& directions)
    : border(border), directions(directions), size(border.size()), run_of(size, none)
  {
    for(std::size_t edge = 0; edge < size; ++edge)
      for(const Kernel::Vector_2& direction : directions)
        ranges.push_back(border.offsets(edge, direction));
    find_runs();
  }

  const std::vector<Run>& all() const { return runs; }
  // The run of an edge, or none.
  std::size_t of_edge(std::size_t edge) const { return run_of[edge]; }

private:
  static constexpr double shortest_run = 3;     // in spacings
  static constexpr double advantage = 1.2;      // by which a run of a direction of less points has to be longer
  static constexpr double tolerance_at_end = 2; // of the points of a run through the end of a straight border

  bool may_continue(std::size_t edge) const { return border.is_free(edge) && run_of[edge] == none; }

  Run longest_run(std::size_t first) const
  {
    Run best;
    if(!may_continue(first))
      return best;
    for(std::size_t d = 0; d < directions.size(); ++d) {
      Border_points::Range range;
      double spacing = 0;
      for(std::size_t count = 1; count < size; ++count) {
        const std::size_t edge = (first + count - 1) % size;
        if(!may_continue(edge) || (count > 1 && border.vertex(edge).stays()))
          break;
        range.add(ranges[edge * directions.size() + d]);
        spacing += border.spacing(edge);
        if(range.length() > 2 * border.tolerance * spacing / double(count))
          break;
        const double length =
          std::fabs((border.vertex(first + count).point - border.vertex(first).point) * directions[d]);
        if(length >= shortest_run * spacing / double(count) &&
           length > (best.direction == d ? 1 : advantage) * best.length)
          best = {first, count, d, length};
      }
    }
    return best;
  }

  void find_runs()
  {
    std::priority_queue<std::pair<double, std::size_t>> queue;
    for(std::size_t i = 0; i < size; ++i)
      queue.emplace(longest_run(i).length, i);
    while(!queue.empty()) {
      const auto [length, first] = queue.top();
      queue.pop();
      Run run = longest_run(first);
      if(run.count == 0)
        continue;
      if(run.length < length) { // others have taken a part of it
        queue.emplace(run.length, first);
        continue;
      }
      std::vector<double> offsets = sorted_offsets(run);
      if(trim(run, offsets[offsets.size() / 2]))
        offsets = sorted_offsets(run);
      find_offset(run, offsets);
      for(std::size_t i = 0; i < run.count; ++i)
        run_of[(run.first + i) % size] = runs.size();
      runs.push_back(run);
      if(run.first != first)
        queue.emplace(longest_run(first).length, first);
    }
  }

  std::vector<double> sorted_offsets(const Run& run) const
  {
    std::vector<double> result;
    for(std::size_t i = 0; i < run.count; ++i)
      border.for_each_point((run.first + i) % size, [&](const Kernel::Point_2& p) {
        result.push_back(Border_points::offset(p, directions[run.direction]));
      });
    std::sort(result.begin(), result.end());
    return result;
  }

  // Leaves out an edge at an end of the run whose points are farther than the tolerance from the median, if it is the
  // only one there: as at a cut corner, and not along a border that is rough. Returns whether there is one.
  bool trim(Run& run, double median) const
  {
    const auto is_far = [&](std::size_t i) {
      const std::size_t edge = (run.first + i) % size;
      const Border_points::Range& range = ranges[edge * directions.size() + run.direction];
      const double most = border.tolerance * border.spacing(edge);
      return range.low < median - most || range.high > median + most;
    };
    std::size_t number = 0;
    for(std::size_t i = 0; i < run.count; ++i)
      number += is_far(i);
    const bool is_first = is_far(0);
    if(run.count == 1 || number != 1 || !(is_first || is_far(run.count - 1)))
      return false;
    if(is_first)
      run.first = (run.first + 1) % size;
    --run.count;
    return true;
  }

  void find_offset(Run& run, const std::vector<double>& offsets) const
  {
    double spacing = 0;
    for(std::size_t i = 0; i < run.count; ++i)
      spacing += border.spacing((run.first + i) % size) / double(run.count);
    const auto low = [&](double tolerance) { return offsets.back() - tolerance * spacing; };
    const auto high = [&](double tolerance) { return offsets.front() + tolerance * spacing; };
    run.median = (std::max)(low(border.tolerance), (std::min)(high(border.tolerance), offsets[offsets.size() / 2]));
    for(std::size_t end : {run.first, run.first + run.count}) {
      const Outline_vertex& v = border.vertex(end);
      const double offset = Border_points::offset(v.point, directions[run.direction]);
      if(v.stays() && offset >= low(tolerance_at_end) && offset <= high(tolerance_at_end)) {
        run.offset = offset;
        return;
      }
    }
    run.offset = run.median;
  }

  const Border_points& border;
  const std::vector<Kernel::Vector_2>& directions;
  std::size_t size;                         // of the loop
  std::vector<Border_points::Range> ranges; // of the offsets of each edge, for all directions
  std::vector<std::size_t> run_of;
  std::vector<Run> runs;
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_EDGE_RUNS_H
