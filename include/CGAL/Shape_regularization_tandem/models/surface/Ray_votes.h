// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which side of an area is inside. A ray that leaves the area upwards crosses what points cover an odd number of times if it
// leaves to the inside, an even number of times if to the outside. So normals need no orientation, and neither floors nor
// the ground below a building need points. A ray that crosses a wall without points says nothing.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_RAY_VOTES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_RAY_VOTES_H

#include <CGAL/Shape_regularization_tandem/models/surface/Plane_coverage.h>

#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // since CGAL 6.0
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::Tandem::internal::surface {

class Ray_votes {
public:
  // Of rays into the half of the sphere around a direction. A ray that leaves plane p does not cross what is in it.
  Ray_votes(const std::vector<Plane_coverage>& planes, const Vector& up)
  {
    for(std::size_t p = 0; p < planes.size(); ++p) {
      for(const auto& part : planes[p].covered())
        add(part, {p, false});
      for(const auto& part : planes[p].assumed())
        add(part, {p, true});
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
    if(!tree_.empty())
      start_ = resolution_of(tree_.bbox());
    const Vector axis = Kernel::Plane_3(CGAL::ORIGIN, up).base1();
    const Vector first = axis / std::sqrt(axis.squared_length()), second = CGAL::cross_product(up, first);
    constexpr double golden_angle = 2.399963; // neighbors on the spiral are far apart
    for(int i = 0; i < number_of_rays; ++i) { // evenly over the upper half of the sphere, on a spiral, along no axis
      const double z = 1 - (i + .5) / number_of_rays, radius = std::sqrt(1 - z * z), angle = golden_angle * i;
      directions_.push_back(radius * std::cos(angle) * first + radius * std::sin(angle) * second + z * up);
    }
  }

  // Of an assumed wall: less says nothing, as of a border within a room or below a roof, or of a wall above a roof.
  static constexpr double least_of_wall = .25;

  Ray_votes(const Ray_votes&) = delete; // the tree has positions in the triangles
  Ray_votes& operator=(const Ray_votes&) = delete;

  // Of rays from these places of plane p, the ratio that says that the front is outside and what is behind inside, less
  // the ratio that says the opposite.
  double balance(const std::vector<Point>& places, const Vector& to_front, std::size_t p) const
  {
    constexpr std::size_t step = 25; // odd, so that all directions occur, and in no order
    if(places.empty())
      return 0;
    int sum = 0;
    for(std::size_t r = 0; r < directions_.size(); ++r) {
      const Vector& direction = directions_[r * step % directions_.size()];
      const int inside = vote(places[r * places.size() / directions_.size()], direction, p);
      sum += direction * to_front > 0 ? -inside : inside;
    }
    return sum / double(directions_.size());
  }

private:
  using Triangles = std::vector<Kernel::Triangle_3>;
#if __has_include(<CGAL/AABB_traits_3.h>)
  using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif
  struct Owner {
    std::size_t plane;
    bool is_assumed;
  };
  static constexpr int number_of_rays = 64;

  void add(const Plane_coverage::Corners& part, const Owner& owner)
  {
    for(std::size_t i = 2; i < part.size(); ++i)
      if(!CGAL::collinear(part[0], part[i - 1], part[i])) {
        triangles_.emplace_back(part[0], part[i - 1], part[i]);
        owners_.push_back(owner);
      }
  }

  // Where a ray leaves to: 1 is inside, -1 outside, 0 unknown. It crosses a plane once, even where triangles touch.
  int vote(const Point& start, const Vector& direction, std::size_t own) const
  {
    std::vector<Triangles::const_iterator> met;
    tree_.all_intersected_primitives(Kernel::Ray_3(start + start_ * direction, direction), std::back_inserter(met));
    std::vector<std::size_t> crossed;
    for(const Triangles::const_iterator& t : met) {
      const Owner& owner = owners_[std::size_t(t - triangles_.begin())];
      if(owner.plane == own)
        continue;
      if(owner.is_assumed)
        return 0;
      crossed.push_back(owner.plane);
    }
    std::sort(crossed.begin(), crossed.end());
    return std::distance(crossed.begin(), std::unique(crossed.begin(), crossed.end())) % 2 == 1 ? 1 : -1;
  }

  Triangles triangles_;
  std::vector<Owner> owners_; // of the triangles
  Tree tree_;
  std::vector<Vector> directions_;
  double start_ = 0; // of a ray, beside its place: predicates are fast where it is on no plane
};

} // namespace CGAL::Tandem::internal::surface

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_SURFACE_RAY_VOTES_H
