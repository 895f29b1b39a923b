// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of shapes on a grid, to find those within a distance of a place.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLACES_IN_REACH_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLACES_IN_REACH_H

#include <CGAL/Tandem/internal/cloud/Import.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A point of a shape.
struct Shape_place {
  Vector position;
  int shape;
};

class Places_in_reach {
public:
  Places_in_reach(std::vector<Shape_place> places, double reach) : reach_(reach)
  {
    for(const Shape_place& place : places)
      box_.add(place.position);
    constexpr double rounding = 1e-9; // places within reach must not be two cells apart
    edge_ = (std::max)(reach, box_.extent() / largest_index) * (1 + rounding);
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for(std::size_t i = 0; i < places.size(); ++i)
      order.emplace_back(key_of(cell_of(places[i].position)), i);
    std::sort(order.begin(), order.end());
    for(const auto& [key, i] : order) {
      if(keys_.empty() || keys_.back() != key) {
        keys_.push_back(key);
        first_.push_back(places_.size());
      }
      places_.push_back(places[i]);
    }
    first_.push_back(places_.size());
  }

  // Finds places for one thread. Queries close to the one before are faster.
  class Finder {
  public:
    explicit Finder(const Places_in_reach& all) : all_(all) {}

    // f(shape, squared distance) for all places within reach.
    template <class F>
    void for_each(const Vector& p, F f)
    {
      const Cell cell = all_.cell_of(p);
      if(cell != cell_) {
        cell_ = cell;
        all_.find_rows(cell, rows_);
      }
      for(const auto& [first, last] : rows_)
        for(std::size_t i = first; i < last; ++i) {
          const Vector v = all_.places_[i].position - p;
          const double squared = dot(v, v);
          if(squared <= all_.reach_ * all_.reach_)
            f(all_.places_[i].shape, squared);
        }
    }

  private:
    const Places_in_reach& all_;
    std::array<double, 3> cell_ = {-1, -1, -1};
    std::array<std::pair<std::size_t, std::size_t>, 9> rows_ = {};
  };

private:
  using Cell = std::array<double, 3>; // whole numbers; those of places are from 1 on
  static constexpr double largest_index = 1 << 20;

  Cell cell_of(const Vector& p) const
  {
    const double v[3] = {p.x, p.y, p.z};
    Cell cell;
    for(std::size_t c = 0; c < 3; ++c)
      cell[c] = std::floor((v[c] - box_.low[c]) / edge_) + 1;
    return cell;
  }

  static std::uint64_t key_of(const Cell& cell)
  {
    return std::uint64_t(cell[2]) << 42 | std::uint64_t(cell[1]) << 21 | std::uint64_t(cell[0]);
  }

  // The places in the cell and those around it: a range for each row of three cells.
  void find_rows(const Cell& cell, std::array<std::pair<std::size_t, std::size_t>, 9>& rows) const
  {
    rows = {};
    for(double index : cell)
      if(!(index >= 0 && index <= largest_index + 2))
        return;
    for(int row = 0; row < 9; ++row) {
      const Cell middle = {cell[0], cell[1] + row % 3 - 1, cell[2] + row / 3 - 1};
      if(middle[1] < 0 || middle[2] < 0)
        continue;
      const std::uint64_t key = key_of(middle);
      const auto first = std::lower_bound(keys_.begin(), keys_.end(), key - (cell[0] > 0 ? 1 : 0));
      const auto last = std::upper_bound(first, keys_.end(), key + 1);
      rows[std::size_t(row)] = {first_[std::size_t(first - keys_.begin())], first_[std::size_t(last - keys_.begin())]};
    }
  }

  double reach_, edge_;
  Coordinate_box box_;
  std::vector<std::uint64_t> keys_; // of the cells with places, ascending
  std::vector<std::size_t> first_;  // place of each of them
  std::vector<Shape_place> places_; // by cell
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_INTERNAL_PLACES_IN_REACH_H
