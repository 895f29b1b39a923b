// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes have points close to each other.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SHAPE_CELLS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SHAPE_CELLS_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::facts {

inline double coordinate(const Vector& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// The points of a shape, ascending along the axis on which they are longest, and their least-squares plane.
struct Shape_patch {
  std::vector<Vector> points;
  int axis = 0;
  Vector centroid = {0, 0, 0}, normal = {0, 0, 0};
  double length = 0, spacing = 0; // of the smallest rectangle around them, and of points that fill it evenly
};

using Shape_pairs = std::vector<std::pair<std::size_t, std::size_t>>; // first < second, sorted

// Cubic cells that have points, for the shapes of one size of cells, and those of smaller ones.
class Shape_cells {
public:
  void add(const std::vector<Vector>& points, std::size_t shape, int exponent)
  {
    const auto index = [exponent](double x) { return std::int64_t(std::floor(std::ldexp(x, -exponent))); };
    std::vector<Cell> own;
    for(const Vector& p : points)
      own.push_back({{index(p.x), index(p.y), index(p.z)}, shape});
    sort(own);
    cells.insert(cells.end(), own.begin(), own.end());
  }

  void sort() { sort(cells); }

  // Twice as large; to be sorted.
  void coarsen()
  {
    for(Cell& cell : cells)
      for(std::int64_t& index : cell.first)
        index = index / 2 - (index % 2 < 0 ? 1 : 0); // rounded down
  }

  // Adds the pairs, of which is_asked(shape) is true for one or both, in equal or adjacent cells.
  template <class Is_asked>
  void add_pairs(Shape_pairs& pairs, Is_asked is_asked) const
  {
    for(const Cell& cell : cells)
      if(is_asked(cell.second))
        for(std::int64_t x = -1; x <= 1; ++x)
          for(std::int64_t y = -1; y <= 1; ++y) {
            const auto& [i, j, k] = cell.first;
            const Cell last = {{i + x, j + y, k + 1}, std::size_t(-1)};
            for(auto near = std::lower_bound(cells.begin(), cells.end(), Cell{{i + x, j + y, k - 1}, 0});
                near != cells.end() && *near < last; ++near)
              if(near->second != cell.second)
                pairs.emplace_back(std::minmax(near->second, cell.second));
          }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

private:
  using Cell = std::pair<std::array<std::int64_t, 3>, std::size_t>;

  static void sort(std::vector<Cell>& cells)
  {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }

  std::vector<Cell> cells;
};

// The shapes with points in equal or adjacent cells, whose size is a power of two between two and four times the larger of
// the spacings of their points.
inline Shape_pairs adjacent_shapes(const std::vector<Shape_patch>& patches)
{
  constexpr int least = -50; // coordinates are below 1, and have not many more bits
  const auto exponent = [&](std::size_t s) { return (std::max)(std::ilogb(patches[s].spacing) + 2, least); };
  std::map<int, std::vector<std::size_t>> shapes_of_size;
  for(std::size_t s = 0; s < patches.size(); ++s)
    if(patches[s].spacing > 0)
      shapes_of_size[exponent(s)].push_back(s);
  Shape_pairs pairs;
  Shape_cells cells;
  int size = shapes_of_size.empty() ? 0 : shapes_of_size.begin()->first;
  for(const auto& entry : shapes_of_size) {
    for(; size < entry.first; ++size)
      cells.coarsen();
    for(std::size_t s : entry.second)
      cells.add(patches[s].points, s, size);
    cells.sort();
    cells.add_pairs(pairs, [&](std::size_t s) { return exponent(s) == size; });
  }
  return pairs;
}

} // namespace CGAL::Tandem::internal::facts

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SHAPE_CELLS_H
