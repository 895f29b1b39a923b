// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which planes share a direction or a plane, which are orthogonal, and how many
// degrees of freedom are left: found from the planes alone, whoever made them.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLANE_RELATIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLANE_RELATIONS_H

#include "scenes/scene_model.h"

#include <numeric>

namespace CGAL::Tandem::benchmark {

using scenes::Vec;

struct Plane {
  Vec normal;
  double offset; // normal . p + offset = 0
};

// Of the sine of the angle of parallel planes, the cosine of that of orthogonal ones, and of the offset at the center of a
// cloud as a fraction of its diagonal.
constexpr double relaxed = 1e-6;

class Plane_relations {
public:
  Plane_relations(const std::vector<Plane>& planes, double diagonal, const Vec& center)
    : diagonal_(diagonal), center_(center)
  {
    for(const Plane& plane : planes)
      add(oriented(plane));
    count_degrees_of_freedom();
  }

  std::size_t shapes() const { return direction_.size(); }
  std::size_t directions() const { return directions_.size(); }
  std::size_t planes() const { return planes_.size(); }
  bool are_parallel(std::size_t s, std::size_t t) const { return direction_[s] == direction_[t]; }
  bool are_coplanar(std::size_t s, std::size_t t) const { return plane_[s] == plane_[t]; }
  bool are_orthogonal(std::size_t s, std::size_t t) const
  {
    return std::abs(dot(directions_[direction_[s]], directions_[direction_[t]])) <= relaxed;
  }

  // A free direction has two, one that is orthogonal to another one, one that is
  // orthogonal to two others none: so a frame has three, as in the paper.
  std::size_t degrees_of_freedom() const { return degrees_of_freedom_; }

  // The paper's complexity.
  double complexity() const
  {
    return shapes() == 0 ? 0 : double(degrees_of_freedom_ + planes()) / double(3 * shapes());
  }

private:
  // The sign of a plane carries no meaning: the first non-zero coordinate is made positive.
  static Plane oriented(const Plane& plane)
  {
    const Vec& n = plane.normal;
    double first = n.x != 0 ? n.x : n.y != 0 ? n.y : n.z;
    return first < 0 ? Plane{-1.0 * n, -plane.offset} : plane;
  }

  bool have_same_direction(const Vec& a, const Vec& b) const { return length(cross(a, b)) <= relaxed; }

  bool are_same(const Plane& a, const Plane& b) const
  {
    if(!have_same_direction(a.normal, b.normal))
      return false;
    double sign = dot(a.normal, b.normal) < 0 ? -1 : 1;
    double at_center = dot(a.normal, center_) + a.offset;
    return std::abs(at_center - sign * (dot(b.normal, center_) + b.offset)) <= relaxed * diagonal_;
  }

  void add(const Plane& plane)
  {
    auto d = std::find_if(directions_.begin(), directions_.end(),
                          [&](const Vec& n) { return have_same_direction(n, plane.normal); });
    direction_.push_back(std::size_t(d - directions_.begin()));
    if(d == directions_.end())
      directions_.push_back(plane.normal);
    auto p = std::find_if(planes_.begin(), planes_.end(), [&](const Plane& q) { return are_same(q, plane); });
    plane_.push_back(std::size_t(p - planes_.begin()));
    if(p == planes_.end())
      planes_.push_back(plane);
  }

  // Directions are placed by the number of their right angles: a master comes before its followers.
  void count_degrees_of_freedom()
  {
    std::size_t n = directions_.size();
    auto is_right = [&](std::size_t a, std::size_t b) {
      return a != b && std::abs(dot(directions_[a], directions_[b])) <= relaxed;
    };
    std::vector<std::size_t> order(n), degree(n, 0);
    std::iota(order.begin(), order.end(), std::size_t(0));
    for(std::size_t a = 0; a < n; ++a)
      for(std::size_t b = 0; b < n; ++b)
        degree[a] += is_right(a, b);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return degree[a] > degree[b]; });
    for(std::size_t i = 0; i < n; ++i) {
      std::size_t constraints = 0;
      for(std::size_t j = 0; j < i && constraints < 2; ++j)
        constraints += is_right(order[i], order[j]);
      degrees_of_freedom_ += 2 - constraints;
    }
  }

  double diagonal_;
  Vec center_;
  std::vector<Vec> directions_;
  std::vector<Plane> planes_;
  std::vector<std::size_t> direction_, plane_; // per shape
  std::size_t degrees_of_freedom_ = 0;
};

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLANE_RELATIONS_H
