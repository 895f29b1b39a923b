// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane of a point: the nearest one of those that take it, by distance and by the angle of its normal.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLANE_CHOICE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLANE_CHOICE_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/internal/base/angles.h>
#include <CGAL/Tandem/internal/cloud/Import.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The points of shapes on a grid, to find those within a distance of a place.

// A point of a shape.
struct Shape_place {
  Vector position;
  int shape;
};

class Places_in_reach {
public:
  Places_in_reach(const std::vector<Shape_place>& places, double reach) : reach_(reach)
  {
    for(const Shape_place& place : places)
      box_.add(place.position);
    constexpr double rounding = 1e-9; // places within reach must not be two cells apart
    edge_ = (std::max)(reach, box_.extent() / largest_index) * (1 + rounding);
    const double size = box_.extent() > smallest_length ? (std::min)(edge_, box_.extent()) : edge_;
    scale_ = std::ldexp(1, -std::ilogb(size));
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for(std::size_t i = 0; i < places.size(); ++i)
      order.emplace_back(cell_of(places[i].position), i);
    std::sort(order.begin(), order.end());
    for(const auto& [cell, i] : order) {
      if(cells_.empty() || cells_.back() != cell) {
        cells_.push_back(cell);
        first_.push_back(places_.size());
      }
      places_.push_back(places[i]);
    }
    first_.push_back(places_.size());
  }

  // A number of the cell of a point, or no_cell where no place is within reach of it.
  std::uint64_t cell_of(const Vector& p) const
  {
    const double v[3] = {p.x, p.y, p.z};
    std::uint64_t cell = 0;
    for(int c = 0; c < 3; ++c) {
      const double index = std::floor((v[c] - box_.low[c]) / edge_) + 1; // that of a place is 1 at least
      if(!(index >= 0 && index <= largest_index + 2))
        return no_cell;
      cell |= std::uint64_t(index) << (index_bits * c);
    }
    return cell;
  }

  static constexpr std::uint64_t no_cell = (std::uint64_t(1) << 63) - 1; // more than that of any cell

  // The places of one shape near the points of a cell.
  struct Group {
    int shape;
    std::size_t first, last; // in Nearby::places
  };

  // All places that may be within reach of the points of a cell, by shape.
  struct Nearby {
    std::vector<Shape_place> places;
    std::vector<Group> groups;
  };

  void collect(std::uint64_t cell, Nearby& nearby) const
  {
    nearby.places.clear();
    nearby.groups.clear();
    for(int row = 0; row < 9 && cell != no_cell; ++row)
      add_row(cell, row % 3 - 1, row / 3 - 1, nearby.places);
    std::vector<Shape_place>& places = nearby.places;
    std::sort(places.begin(), places.end(),
              [](const Shape_place& a, const Shape_place& b) { return a.shape < b.shape; });
    for(std::size_t i = 0; i < places.size(); ++i) {
      if(nearby.groups.empty() || nearby.groups.back().shape != places[i].shape)
        nearby.groups.push_back({places[i].shape, i, i});
      nearby.groups.back().last = i + 1;
    }
  }

  // In a unit of about the distances to compare, so that squares neither overflow nor vanish. It is a power of two, which
  // rounds nothing.
  double squared_distance(const Vector& p, const Vector& q) const
  {
    const double x = (p.x - q.x) * scale_, y = (p.y - q.y) * scale_, z = (p.z - q.z) * scale_;
    return x * x + y * y + z * z;
  }

  // The argument is a result of squared_distance().
  bool is_within(double squared_distance) const
  {
    const double reach = reach_ * scale_;
    return squared_distance <= reach * reach;
  }

private:
  static constexpr int index_bits = 21;
  static constexpr double largest_index = 1 << (index_bits - 1);

  // The cells of three numbers that follow each other: those beside a cell, moved along y and z.
  void add_row(std::uint64_t cell, int y, int z, std::vector<Shape_place>& nearby) const
  {
    const auto index = [&](int c) { return std::int64_t(cell >> (index_bits * c) & ((1u << index_bits) - 1)); };
    if(index(1) + y < 0 || index(2) + z < 0)
      return;
    const std::uint64_t middle = cell + (std::uint64_t(z) << (2 * index_bits)) + (std::uint64_t(y) << index_bits);
    const auto first = std::lower_bound(cells_.begin(), cells_.end(), middle - (index(0) > 0));
    const auto last = std::upper_bound(first, cells_.end(), middle + 1);
    nearby.insert(nearby.end(), places_.begin() + std::ptrdiff_t(first_[std::size_t(first - cells_.begin())]),
                  places_.begin() + std::ptrdiff_t(first_[std::size_t(last - cells_.begin())]));
  }

  double reach_, edge_, scale_;
  Coordinate_box box_;
  std::vector<std::uint64_t> cells_; // that have places, ascending
  std::vector<std::size_t> first_;   // place of each of them
  std::vector<Shape_place> places_;  // by cell
};

// What decides on the planes of a point.
struct Point_to_label {
  Vector position, normal; // a null normal fits each plane
  double tolerance;
};

class Plane_choice {
public:
  // Coordinates of points are at most `largest`, in absolute value.
  Plane_choice(const std::vector<Coefficients>& planes, double maximum_angle_deg, double largest)
    : planes_(planes), cosine_(cosine_deg(maximum_angle_deg)), blocks_((planes.size() + width - 1) / width)
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
  int nearest(const Point_to_label& p, const Places_in_reach& all, const Places_in_reach::Nearby& nearby) const
  {
    std::pair<double, double> least(HUGE_VAL, HUGE_VAL); // from the plane, and from the nearest place
    int shape = -1;
    for(const Places_in_reach::Group& group : nearby.groups) {
      const double d = distance(p, std::size_t(group.shape));
      if(d == HUGE_VAL || d > least.first)
        continue;
      const std::pair<double, double> both(d, squared_distance(p.position, all, group, nearby));
      if(both < least && all.is_within(both.second)) {
        least = both;
        shape = group.shape;
      }
    }
    return shape;
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

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLANE_CHOICE_H
