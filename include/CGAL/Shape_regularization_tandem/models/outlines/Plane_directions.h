// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directions in the plane of a shape that the relations of the shapes give: those of the lines with planes of the other
// parallel groups, and the directions orthogonal to these.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_DIRECTIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_DIRECTIONS_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Edge_runs.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_draft.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

class Plane_directions {
public:
  explicit Plane_directions(const Shapes& shapes)
    : shapes(shapes), representative(representatives(shapes.data().parallel_group)), sizes(representative.size())
  {
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      sizes[shapes.parallel_group(s)] += double(shapes.points(s).size());
  }

  // Unit vectors in the frame, each with the one orthogonal to it behind it: of the groups with most points, where those
  // of groups that are orthogonal to the shape count more.
  std::vector<Kernel::Vector_2> of_shape(std::size_t s, const Plane_frame& frame) const
  {
    std::vector<std::pair<double, Kernel::Vector_2>> found;
    for(std::size_t g = 0; g < representative.size(); ++g) {
      if(g == shapes.parallel_group(s))
        continue;
      const std::size_t t = std::size_t(representative[g]);
      const Kernel::Vector_3 cross = CGAL::cross_product(normal_of(s), normal_of(t));
      const double sine = std::sqrt(cross.squared_length());
      if(sine >= smallest_sine)
        found.emplace_back((shapes.are_orthogonal(s, t) ? preference : 1) * sizes[g], frame.flat(cross / sine));
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Kernel::Vector_2> result;
    for(const auto& [weight, d] : found)
      if(result.size() < 2 * largest_number && !has(result, d)) {
        result.push_back(d);
        result.push_back(d.perpendicular(CGAL::COUNTERCLOCKWISE));
      }
    return result;
  }

private:
  static constexpr double preference = 8;          // of orthogonal groups
  static constexpr std::size_t largest_number = 8; // of pairs: of more, one is close to any direction
  static constexpr double same_sine = 1e-9;

  static bool has(const std::vector<Kernel::Vector_2>& all, const Kernel::Vector_2& d)
  {
    return std::any_of(all.begin(), all.end(), [&](const Kernel::Vector_2& other) {
      return std::fabs(other.x() * d.y() - other.y() * d.x()) < same_sine;
    });
  }

  Kernel::Vector_3 normal_of(std::size_t s) const { return shapes.plane(s).orthogonal_vector(); }

  const Shapes& shapes;
  std::vector<int> representative; // a shape of each parallel group
  std::vector<double> sizes;       // points of each parallel group
};

// --- Directions for shapes to which no other plane gives one, as flat roofs and the ground are: those of their own edges

// Of one shape, or of all of a parallel group, whose frames have the same axes.
class Dominant_direction {
public:
  void add(const Outline_draft& draft)
  {
    for(const Outline_loop& loop : draft.loops())
      for(std::size_t i = 0; i < loop.size(); ++i) {
        const Outline_vertex &u = loop[i], &v = loop[(i + 1) % loop.size()];
        const Kernel::Vector_2 w = v.point - u.point;
        const double length = std::sqrt(w.squared_length()), spacing = (double(u.spacing) + v.spacing) / 2;
        if(u.border < 0 && spacing > 0 && length >= shortest_edge * spacing)
          edges.push_back({w / length, length, spacing});
      }
  }

  // Whether most of the edges, by length, can take this direction or the one orthogonal to it.
  bool agrees(const Kernel::Vector_2& d) const
  {
    double length = 0;
    for(const Edge& e : edges)
      length += e.length;
    return length > 0 && length_along(d) > length / 2;
  }

  // That of the edge, among the longest ones, that most others agree with; the mean of these.
  Kernel::Vector_2 best() const
  {
    std::vector<Edge> longest = edges;
    std::stable_sort(longest.begin(), longest.end(), [](const Edge& a, const Edge& b) { return a.length > b.length; });
    Kernel::Vector_2 result(1, 0);
    double largest = 0;
    for(std::size_t i = 0; i < longest.size() && i < largest_number; ++i) {
      const Kernel::Vector_2 d = mean_along(longest[i].direction);
      const double length = length_along(d);
      if(length > largest) {
        largest = length;
        result = d;
      }
    }
    return result;
  }

private:
  static constexpr double shortest_edge = 3; // in spacings, as runs of edges are
  static constexpr std::size_t largest_number = 16;

  struct Edge {
    Kernel::Vector_2 direction;
    double length, spacing;
  };

  // Its sine of the angle to the nearest of the four directions, positive to the left.
  static double sine_to(const Kernel::Vector_2& d, const Edge& e)
  {
    const double along = d * e.direction, across = d.x() * e.direction.y() - d.y() * e.direction.x();
    if(std::fabs(along) > std::fabs(across))
      return along > 0 ? across : -across;
    return across > 0 ? -along : along;
  }

  static bool is_along(const Kernel::Vector_2& d, const Edge& e)
  {
    return std::fabs(sine_to(d, e)) * e.length <= Border_points::tolerance * e.spacing;
  }

  double length_along(const Kernel::Vector_2& d) const
  {
    double result = 0;
    for(const Edge& e : edges)
      result += is_along(d, e) ? e.length : 0;
    return result;
  }

  // Long edges are more precise: their ends are as far from the line as those of others.
  Kernel::Vector_2 mean_along(const Kernel::Vector_2& d) const
  {
    double sum = 0, weight = 0;
    for(const Edge& e : edges)
      if(is_along(d, e)) {
        sum += e.length * e.length * sine_to(d, e);
        weight += e.length * e.length;
      }
    const Kernel::Vector_2 turned = d + sum / weight * d.perpendicular(CGAL::COUNTERCLOCKWISE);
    return turned / std::sqrt(turned.squared_length());
  }

  std::vector<Edge> edges;
};

// Appends directions, in pairs, where a shape has none: that of its parallel group, or its own, if its edges agree.
inline void add_own_directions(const Shapes& shapes, const std::vector<Outline_draft>& drafts,
                               const std::vector<char>& is_framed, std::vector<std::vector<Kernel::Vector_2>>& along)
{
  const auto is_needed = [&](std::size_t s) { return is_framed[s] && along[s].empty(); };
  std::map<std::size_t, Dominant_direction> of_groups;
  for(std::size_t s = 0; s < drafts.size(); ++s)
    if(is_needed(s))
      of_groups[shapes.parallel_group(s)].add(drafts[s]);
  std::map<std::size_t, Kernel::Vector_2> common;
  for(const auto& [group, direction] : of_groups)
    common.emplace(group, direction.best());
  for(std::size_t s = 0; s < drafts.size(); ++s) {
    if(!is_needed(s))
      continue;
    Dominant_direction own;
    own.add(drafts[s]);
    for(const Kernel::Vector_2& d : {common.at(shapes.parallel_group(s)), own.best()})
      if(along[s].empty() && own.agrees(d))
        along[s] = {d, d.perpendicular(CGAL::COUNTERCLOCKWISE)};
  }
}

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_PLANE_DIRECTIONS_H
