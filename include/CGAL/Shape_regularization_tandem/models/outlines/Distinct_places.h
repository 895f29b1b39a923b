// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of a plane without those that are close to another one.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_DISTINCT_PLACES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_DISTINCT_PLACES_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

// No two places are closer to each other than the distance, and each point is closer than that to its place, the first
// one of these.
class Distinct_places {
public:
  // Coordinates are up to 1, and the distance is at least `shortest`.
  Distinct_places(const std::vector<Kernel::Point_2>& points, double distance) : distance(distance)
  {
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> places_of_square;
    place_of_.reserve(points.size());
    for(const Kernel::Point_2& p : points) {
      std::size_t place = places_.size();
      for(std::int64_t i = -1; i <= 1; ++i)
        for(std::int64_t j = -1; j <= 1; ++j) {
          const auto square = places_of_square.find(key(column(p.x()) + i, column(p.y()) + j));
          if(square == places_of_square.end())
            continue;
          for(std::size_t other : square->second)
            if(other < place && CGAL::squared_distance(places_[other], p) < distance * distance)
              place = other;
        }
      place_of_.push_back(place);
      if(place < places_.size())
        continue;
      places_.push_back(p);
      places_of_square[key(column(p.x()), column(p.y()))].push_back(place);
    }
  }

  static constexpr double shortest = 0x1p-50;

  const std::vector<Kernel::Point_2>& places() const { return places_; }
  std::size_t place_of(std::size_t point) const { return place_of_[point]; }

private:
  std::int64_t column(double x) const { return std::int64_t(std::floor(x / distance)); }

  // Squares that have the same one are looked at together.
  static std::uint64_t key(std::int64_t i, std::int64_t j)
  {
    return std::uint64_t(i) * 0x9e3779b97f4a7c15u ^ std::uint64_t(j) * 0xc2b2ae3d27d4eb4fu;
  }

  double distance;
  std::vector<Kernel::Point_2> places_;
  std::vector<std::size_t> place_of_; // of each point
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_DISTINCT_PLACES_H
