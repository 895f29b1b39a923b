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

// --- Great circles and cells on the sphere of directions; opposite directions are the same. Directions are projected from
// the origin onto three faces of a cube, where a great circle is a straight line. Bounds are on the safe side of all
// rounding.

// A square on a face of the cube [-1, 1]^3, the one where coordinate `face` is 1. u and v are the next coordinates, in
// turn.
struct Direction_cell {
  int face;
  double u, v, half_width; // center, and half of the width
};

// The great circle of the directions orthogonal to the unit axis (x, y, z).
class Great_circle {
public:
  Great_circle(double x, double y, double z) : n{x, y, z, x, y}
  {
    for(int face = 0; face < 3; ++face)
      slope[face] = std::fabs(n[face + 1]) + std::fabs(n[face + 2]);
  }

  // Whether it may pass through the cell.
  bool meets(const Direction_cell& cell) const { return !(distance(cell) > 0); }

  // At most the squared dot product of the axis and any unit direction of the cell.
  double least_squared_dot(const Direction_cell& cell) const
  {
    const double least = distance(cell);
    if(!(least > 0))
      return 0;
    const double u = std::fabs(cell.u) + cell.half_width, v = std::fabs(cell.v) + cell.half_width;
    return least * least / (1 + u * u + v * v);
  }

  // The quarter of the cell of which the center is nearest to the circle.
  int nearest_quarter(const Direction_cell& cell) const
  {
    const double h = height(cell), w = cell.half_width / 2, u = w * n[cell.face + 1], v = w * n[cell.face + 2];
    const double distances[4] = {std::fabs(h - u - v), std::fabs(h + u - v), std::fabs(h - u + v),
                                 std::fabs(h + u + v)};
    return int(std::min_element(distances, distances + 4) - distances);
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

inline Great_circle great_circle(const Vector& axis) { return {axis.x, axis.y, axis.z}; }

// Directions are numbered in the order in which they were added. Each has a value of at least 0. A cell knows the
// largest value of its directions, or a larger one. A region decides what is visited:
//   region.meets(cell, largest)     whether a direction of the cell may matter; a direction is a cell of no width
//   region.nearest_quarter(cell)    the quarter of the cell to begin with, 0 to 3
// Memory: about 200 bytes a direction.
class Great_circle_index {
public:
  Great_circle_index() : nodes(3) {}

  // The null vector is no direction.
  void add(const Vector& direction, double value)
  {
    const int i = int(places.size());
    places.push_back(place_of(direction));
    const Item item = {places[i].u, places[i].v, value, i};
    Direction_cell cell = root_of(i);
    int n = cell.face;
    for(; nodes[n].children >= 0; n = enter_child(n, cell, item))
      nodes[n].largest = (std::max)(nodes[n].largest, value);
    append(n, item);
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
  static constexpr int leaf_size = 8;
  static constexpr double smallest_half_width = 0x1p-48;

  struct Place {
    double u, v;
    int face;
  };

  struct Item {
    double u, v, value;
    int number; // of the direction
  };

  // Directions of a leaf, in consecutive memory. Only the smallest cells have more than one block.
  struct Block {
    Item items[leaf_size];
    int size, next; // -1: the last block
  };

  // Inner nodes have four consecutive children, leaves a list of blocks. Nodes 0, 1, 2 are the faces.
  struct Node {
    double largest = -1; // -1: empty
    int children = -1;
    int first = -1, last = -1; // blocks
  };

  // On the face of the largest coordinate.
  static Place place_of(const Vector& d)
  {
    const double c[5] = {d.x, d.y, d.z, d.x, d.y};
    const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
    const int face = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    return {c[face + 1] / c[face], c[face + 2] / c[face], face};
  }

  Direction_cell root_of(int i) const { return {places[i].face, 0, 0, 1}; }

  static Direction_cell child_cell(const Direction_cell& cell, int child)
  {
    const double h = cell.half_width / 2;
    return {cell.face, child & 1 ? cell.u + h : cell.u - h, child & 2 ? cell.v + h : cell.v - h, h};
  }

  template <class Position>
  static int child_of(const Direction_cell& cell, const Position& p)
  {
    return (p.u >= cell.u ? 1 : 0) + (p.v >= cell.v ? 2 : 0);
  }

  // The child of node n in which the position lies; `cell` becomes that of the child.
  template <class Position>
  int enter_child(int n, Direction_cell& cell, const Position& p) const
  {
    const int child = child_of(cell, p);
    cell = child_cell(cell, child);
    return nodes[n].children + child;
  }

  int new_block()
  {
    int b = free_block;
    if(b >= 0) {
      free_block = blocks[b].next;
    } else {
      b = int(blocks.size());
      blocks.emplace_back();
    }
    blocks[b].size = 0;
    blocks[b].next = -1;
    return b;
  }

  void free(int b)
  {
    blocks[b].next = free_block;
    free_block = b;
  }

  void append(int leaf, const Item& item)
  {
    Node& node = nodes[leaf];
    if(node.first < 0) {
      node.first = node.last = new_block();
    } else if(blocks[node.last].size == leaf_size) {
      const int b = new_block();
      blocks[node.last].next = b;
      node.last = b;
    }
    Block& block = blocks[node.last];
    block.items[block.size++] = item;
    node.largest = (std::max)(node.largest, item.value);
  }

  // Splits a leaf that has more than one block, until its directions are apart. They keep their order.
  void split(int n, Direction_cell cell)
  {
    while(nodes[n].first != nodes[n].last && cell.half_width > smallest_half_width) {
      const int children = int(nodes.size());
      nodes.resize(nodes.size() + 4);
      for(int b = nodes[n].first, next; b >= 0; b = next) {
        const Block block = blocks[b];
        next = block.next;
        free(b);
        for(int k = 0; k < block.size; ++k)
          append(children + child_of(cell, block.items[k]), block.items[k]);
      }
      nodes[n].children = children;
      nodes[n].first = nodes[n].last = -1;
      int full = 0; // at most one child has them all
      while(full < 3 && nodes[children + full].first == nodes[children + full].last)
        ++full;
      n = children + full;
      cell = child_cell(cell, full);
    }
  }

  template <class Region>
  static bool meets(const Region& region, int face, const Item& item)
  {
    return region.meets({face, item.u, item.v, 0}, item.value);
  }

  template <class Region, class Function>
  void search_below(int n, const Direction_cell& cell, const Region& region, Function& f) const
  {
    const Node& node = nodes[n];
    if(node.largest < 0 || !region.meets(cell, node.largest))
      return;
    if(node.children >= 0)
      for(int k = 0, nearest = region.nearest_quarter(cell); k < 4; ++k)
        search_below(node.children + (nearest ^ k), child_cell(cell, nearest ^ k), region, f);
    else
      for(int b = node.first; b >= 0; b = blocks[b].next)
        for(int k = 0; k < blocks[b].size; ++k)
          if(meets(region, cell.face, blocks[b].items[k]))
            f(blocks[b].items[k].number);
  }

  std::vector<Node> nodes;
  std::vector<Place> places;
  std::vector<Block> blocks;
  int free_block = -1; // the first of a list
};

// --- Which of many directions are exactly orthogonal, without a look at all pairs.

// The directions that may be exactly orthogonal to one.
class Right_angle_region {
public:
  explicit Right_angle_region(const Vector& direction) : circle(great_circle(direction)) {}

  bool meets(const Direction_cell& cell, double) const { return circle.meets(cell); }
  int nearest_quarter(const Direction_cell&) const { return 0; }

private:
  Great_circle circle;
};

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
    index.search(Right_angle_region(directions[j]), [&](int k) {
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
