// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds directions by a region of the sphere, such as those nearly orthogonal to an axis, along a great circle. Each
// face of the cube has a quadtree: see Great_circle. A line meets few of its cells, about the square root of their
// number. The index only leaves out what is impossible. Callers test what they get, so rounding cannot change a result.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_GREAT_CIRCLE_INDEX_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_GREAT_CIRCLE_INDEX_H

#include <CGAL/Tandem/internal/base/linear_algebra.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- Great circles and cells on the sphere of directions; opposite directions are the same. Directions are projected
// from the origin onto three faces of a cube, where a great circle is a straight line. Bounds are on the safe side of
// all rounding.

// A square on a face of the cube [-1, 1]^3, the one where coordinate `face` is 1. u and v are the next coordinates, in
// turn.
struct Direction_cell {
  int face;
  double u, v, half_width; // center, and half of the width
};

// The great circle of the directions orthogonal to a unit axis. As a region, those that may be exactly orthogonal to it.
class Great_circle {
public:
  explicit Great_circle(const Vector& axis) : n{axis.x, axis.y, axis.z, axis.x, axis.y}
  {
    for(int face = 0; face < 3; ++face)
      slope[face] = std::fabs(n[face + 1]) + std::fabs(n[face + 2]);
  }

  // Whether it may pass through the cell.
  bool meets(const Direction_cell& cell, double) const { return !(distance(cell) > 0); }

  // Whether the squared dot product of the axis and some unit direction of the cell may be below a bound.
  bool may_be_below(double bound, const Direction_cell& cell) const
  {
    const double least = distance(cell);
    if(!(least > 0))
      return bound > 0;
    const double u = std::fabs(cell.u) + cell.half_width, v = std::fabs(cell.v) + cell.half_width;
    return least * least < bound * (1 + u * u + v * v);
  }

private:
  // The dot product of the axis and the center of the cell, on the face.
  double height(const Direction_cell& cell) const
  {
    return n[cell.face] + n[cell.face + 1] * cell.u + n[cell.face + 2] * cell.v;
  }

  // The least |dot product| of the cell, on the face.
  double distance(const Direction_cell& cell) const
  {
    return std::fabs(height(cell)) - cell.half_width * slope[cell.face] - tuning::exactness::dot_margin;
  }

  std::array<double, 5> n; // so that the coordinates can be taken in turn
  double slope[3];         // by face: how much the dot product changes within a cell
};

// Directions are numbered in the order in which they were added. Each has a value of at least 0. A cell knows the
// largest value of its directions, or a larger one. A region decides what is visited:
//   region.meets(cell, largest)     whether a direction of the cell may matter; a direction is a cell of no width
// Memory: about 200 bytes a direction.
class Great_circle_index {
public:
  Great_circle_index() : nodes(3) {}

  // The null vector is no direction.
  void add(const Vector& direction, double value)
  {
    const double c[5] = {direction.x, direction.y, direction.z, direction.x, direction.y};
    const double x = std::fabs(direction.x), y = std::fabs(direction.y), z = std::fabs(direction.z);
    int n = x >= y && x >= z ? 0 : y >= z ? 1 : 2; // the face of the largest coordinate
    const Item item = {c[n + 1] / c[n], c[n + 2] / c[n], value, size++};
    Direction_cell cell = {n, 0, 0, 1};
    while(nodes[n].children >= 0) {
      nodes[n].largest = (std::max)(nodes[n].largest, value);
      const int child = child_of(cell, item);
      n = nodes[n].children + child;
      cell = child_cell(cell, child);
    }
    append(nodes[n], item);
    split(n, cell);
  }

  // Calls f(i) for the directions that meet the region.
  template <class Region, class Function>
  void search(const Region& region, Function f) const
  {
    for(int face = 0; face < 3; ++face)
      search_below(face, {face, 0, 0, 1}, region, f);
  }

private:
  // More directions a leaf: fewer cells, more tests. Cells of 2^-48 are as narrow as the rounding of a direction.
  static constexpr std::size_t leaf_size = 32;
  static constexpr double smallest_half_width = 0x1p-48;

  struct Item {
    double u, v, value;
    int number; // of the direction
  };

  // Inner nodes have four consecutive children, leaves have items. Nodes 0, 1, 2 are the faces.
  struct Node {
    double largest = -1; // -1: empty
    int children = -1;
    std::vector<Item> items;
  };

  static Direction_cell child_cell(const Direction_cell& cell, int child)
  {
    const double h = cell.half_width / 2;
    return {cell.face, child & 1 ? cell.u + h : cell.u - h, child & 2 ? cell.v + h : cell.v - h, h};
  }

  static int child_of(const Direction_cell& cell, const Item& p)
  {
    return (p.u >= cell.u ? 1 : 0) + (p.v >= cell.v ? 2 : 0);
  }

  void append(Node& leaf, const Item& item)
  {
    leaf.items.reserve(leaf_size + 1);
    leaf.items.push_back(item);
    leaf.largest = (std::max)(leaf.largest, item.value);
  }

  // Splits a leaf with too many directions, until they are apart. They keep their order.
  void split(int n, Direction_cell cell)
  {
    while(nodes[n].items.size() > leaf_size && cell.half_width > smallest_half_width) {
      const int children = int(nodes.size());
      nodes.resize(nodes.size() + 4);
      for(const Item& item : nodes[n].items)
        append(nodes[children + child_of(cell, item)], item);
      nodes[n].children = children;
      std::vector<Item>().swap(nodes[n].items);
      int full = 0; // at most one child has them all
      while(full < 3 && nodes[children + full].items.size() <= leaf_size)
        ++full;
      n = children + full;
      cell = child_cell(cell, full);
    }
  }

  template <class Region, class Function>
  void search_below(int n, const Direction_cell& cell, const Region& region, Function& f) const
  {
    const Node& node = nodes[n];
    if(node.largest < 0 || !region.meets(cell, node.largest))
      return;
    if(node.children >= 0)
      for(int k = 0; k < 4; ++k)
        search_below(node.children + k, child_cell(cell, k), region, f);
    else
      for(const Item& item : node.items)
        if(region.meets({cell.face, item.u, item.v, 0}, item.value))
          f(item.number);
  }

  std::vector<Node> nodes;
  int size = 0; // directions
};

// --- Which of many directions are exactly orthogonal, without a look at all pairs.

// The same as are_orthogonal(). Plain products decide nearly all pairs: without FMA in the processor, fma() is slow.
inline bool are_exactly_orthogonal(const Vector& a, const Vector& b)
{
  return std::fabs(a.x * b.x + a.y * b.y + a.z * b.z) <= tuning::exactness::dot_margin && are_orthogonal(a, b);
}

// All pairs (i, j), i < j, of exactly orthogonal unit directions, sorted; null vectors have none. A direction is
// compared with those near its great circle: for n directions in general position, about the square root of n. The list
// is not complete if there are more than `most`.
inline std::vector<std::pair<int, int>> orthogonal_pairs(const std::vector<Vector>& directions,
                                                         std::size_t most = (std::numeric_limits<std::size_t>::max)())
{
  std::vector<std::pair<int, int>> pairs;
  Great_circle_index index;
  std::vector<int> added; // by number in the index
  for(std::size_t j = 0; j < directions.size() && pairs.size() <= most; ++j) {
    if(!(dot(directions[j], directions[j]) > 0))
      continue;
    index.search(Great_circle(directions[j]), [&](int k) {
      if(are_exactly_orthogonal(directions[added[k]], directions[j]))
        pairs.push_back({added[k], int(j)});
    });
    index.add(directions[j], 0);
    added.push_back(int(j));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_GREAT_CIRCLE_INDEX_H
