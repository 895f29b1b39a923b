// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane of a point: the nearest one of those that take it, by distance and by the angle of its normal.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLANE_CHOICE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLANE_CHOICE_H

#include <CGAL/Shape_regularization_tandem/internal/Places_in_reach.h>
#include <CGAL/Tandem/Coefficients.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// What decides on the planes of a point.
struct Point_to_label {
  Vector position, normal; // a null normal fits each plane
  double tolerance;
};

// A shape that takes a point by its plane.
struct Label_candidate {
  double distance;
  const Places_in_reach::Group* group;
};

class Plane_choice {
public:
  // Coordinates of points are at most `largest`, in absolute value.
  Plane_choice(const std::vector<Coefficients>& planes, double maximum_angle_deg, double largest)
    : planes_(planes), cosine_(std::cos(maximum_angle_deg * (3.14159265358979323846 / 180))),
      blocks_((planes.size() + width - 1) / width)
  {
    for(Block& block : blocks_)
      block.d.fill(HUGE_VAL);
    for(std::size_t s = 0; s < planes.size(); ++s) {
      Block& block = blocks_[s / width];
      const std::size_t i = s % width;
      std::tie(block.a[i], block.b[i], block.c[i], block.d[i]) =
        std::tie(planes[s][0], planes[s][1], planes[s][2], planes[s][3]);
      margin_ = (std::max)(margin_, 1e-15 * (3 * largest + std::fabs(planes[s][3])));
    }
  }

  // The shape of the nearest plane that takes the point, -1 if none does. Of several, the first.
  int nearest(const Point_to_label& p) const
  {
    double least = HUGE_VAL;
    int shape = -1;
    for(std::size_t b = 0; b < blocks_.size(); ++b)
      if(blocks_[b].least_distance(p.position) <= p.tolerance + margin_)
        for(std::size_t s = b * width; s < (std::min)((b + 1) * width, planes_.size()); ++s)
          if(const double d = distance(p, s); d < least) {
            least = d;
            shape = int(s);
          }
    return shape;
  }

  // The same of the shapes that have a place within reach. Of several, the one with the nearest place, then the first.
  // candidates: memory of this thread.
  int nearest(const Point_to_label& p, const Places_in_reach& all, const Places_in_reach::Nearby& nearby,
              std::vector<Label_candidate>& candidates) const
  {
    candidates.clear();
    for(const Places_in_reach::Group& group : nearby.groups)
      if(const double d = distance(p, std::size_t(group.shape)); d < HUGE_VAL)
        candidates.push_back({d, &group});
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Label_candidate& a, const Label_candidate& b) { return a.distance < b.distance; });
    for(std::size_t first = 0, last = 0; first < candidates.size(); first = last) {
      double least = HUGE_VAL;
      int shape = -1;
      for(; last < candidates.size() && candidates[last].distance == candidates[first].distance; ++last)
        if(const double d = squared_distance(p.position, all, *candidates[last].group, nearby); d < least) {
          least = d;
          shape = candidates[last].group->shape;
        }
      if(all.is_within(least))
        return shape;
    }
    return -1;
  }

private:
  static constexpr std::size_t width = 8; // a compiler makes vectors of that

  struct Block {
    std::array<double, width> a = {}, b = {}, c = {}, d = {};

    // Of plain products, which are fast on each processor.
    double least_distance(const Vector& p) const
    {
      std::array<double, width> distance;
      for(std::size_t i = 0; i < width; ++i)
        distance[i] = std::fabs(a[i] * p.x + b[i] * p.y + c[i] * p.z + d[i]);
      double least = HUGE_VAL;
      for(std::size_t i = 0; i < width; ++i)
        least = distance[i] < least ? distance[i] : least;
      return least;
    }
  };

  // From the nearest place of the group.
  static double squared_distance(const Vector& p, const Places_in_reach& all, const Places_in_reach::Group& group,
                                 const Places_in_reach::Nearby& nearby)
  {
    double least = HUGE_VAL;
    for(std::size_t i = group.first; i < group.last; ++i)
      least = (std::min)(least, all.squared_distance(nearby.places[i].position, p));
    return least;
  }

  // Of the point from plane s, infinite where that does not take it.
  double distance(const Point_to_label& p, std::size_t s) const
  {
    const Coefficients& c = planes_[s];
    const double d =
      std::fabs(std::fma(c[0], p.position.x, std::fma(c[1], p.position.y, std::fma(c[2], p.position.z, c[3]))));
    const Vector& n = p.normal;
    const double aligned = std::fabs(dot({c[0], c[1], c[2]}, n));
    const bool has_normal = dot(n, n) > 0;
    return d <= p.tolerance && (!has_normal || (aligned >= cosine_ && aligned > 0)) ? d : HUGE_VAL;
  }

  const std::vector<Coefficients>& planes_;
  double cosine_;
  double margin_ = 0; // of the rounding of distances
  std::vector<Block> blocks_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLANE_CHOICE_H
