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

// Of a shape that takes a point. The least is chosen.
struct Label_candidate {
  double distance;      // to its plane
  double squared_reach; // to the nearest of its points, if they are known
  int shape;

  bool operator<(const Label_candidate& c) const
  {
    return std::tie(distance, squared_reach, shape) < std::tie(c.distance, c.squared_reach, c.shape);
  }
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
    Label_candidate best = {HUGE_VAL, 0, -1};
    for(std::size_t b = 0; b < blocks_.size(); ++b)
      if(blocks_[b].least_distance(p.position) <= p.tolerance + margin_)
        for(std::size_t s = b * width; s < (std::min)((b + 1) * width, planes_.size()); ++s)
          if(const double d = distance(p, s); d < best.distance)
            best = {d, 0, int(s)};
    return best.shape;
  }

  // The same of the shapes that have a point within reach. candidates: of this thread.
  int nearest(const Point_to_label& p, Places_in_reach::Finder& places, std::vector<Label_candidate>& candidates) const
  {
    candidates.clear();
    places.for_each(p.position, [&](int shape, double squared) {
      const auto has_shape = [shape](const Label_candidate& c) { return c.shape == shape; };
      const auto at = std::find_if(candidates.begin(), candidates.end(), has_shape);
      if(at == candidates.end())
        candidates.push_back({distance(p, std::size_t(shape)), squared, shape});
      else
        at->squared_reach = (std::min)(at->squared_reach, squared);
    });
    const auto best = std::min_element(candidates.begin(), candidates.end());
    return best == candidates.end() || best->distance == HUGE_VAL ? -1 : best->shape;
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
