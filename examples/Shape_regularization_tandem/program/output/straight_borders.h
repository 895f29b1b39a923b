// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where shapes end at the planes of others.

#ifndef DETECT_PLANES_STRAIGHT_BORDERS_H
#define DETECT_PLANES_STRAIGHT_BORDERS_H

#include "output/Straight_border.h"
#include "output/intervals.h"

#include <CGAL/Bbox_3.h>

#include <cstdint>
#include <vector>

namespace program {

// The points of a shape, in an order in which points that are close follow each other.
struct Shape_points {
  Plane_frame frame;
  std::vector<Kernel::Point_3> points;
  std::vector<Kernel::Point_2> flat;
  std::vector<float> spacing;
};

struct Straight_borders {
  std::vector<Straight_border> borders;
  std::vector<std::uint32_t> cut; // positions of the points beyond them
};

class Border_finder {
public:
  Border_finder(const Shapes& shapes, const std::vector<Shape_points>& all);

  Straight_borders borders_of(std::size_t s) const;

private:
  struct Block { // of consecutive points
    CGAL::Bbox_3 box;
    float spacing;
  };
  struct Line {
    int plane; // the other one, as coplanar group
    Kernel::Point_3 origin;
    Kernel::Vector_3 direction;
    double sine; // of the angle between the planes
  };
  struct Near_point {
    double along, across;
    float spacing;
    std::uint32_t position;
  };
  struct Piece { // of a line
    Line line;
    Interval interval;
    bool is_left; // side of the shape
    float spacing;
    int third[2] = {-1, -1};  // planes at corners, at both ends
    double shift[2] = {0, 0}; // by which the ends were moved there
    std::vector<Border_vertex_position> crossings;
  };

  double overhang(float spacing, const Line& line) const { return spacing + maximum_distance / line.sine; }
  double reach(float spacing, const Line& line) const { return 2 * spacing + maximum_distance / line.sine; }
  std::vector<int> planes_near(std::size_t s) const;
  Line line_of(std::size_t s, int plane) const;
  std::vector<Near_point> points_near(std::size_t s, const Line& line) const;
  void find_pieces(std::size_t s, const Line& line, std::vector<Piece>& pieces, std::vector<std::uint32_t>& cut) const;
  void drop_outer(std::size_t s, std::vector<Piece>& pieces) const;
  void join_at_corner(std::size_t s, Piece& a, Piece& b) const;
  Kernel::Point_3 on_line(std::size_t s, const Line& line, double along) const;
  Kernel::Point_3 corner_of(std::size_t s, int plane, int other) const;
  Straight_border border_of(std::size_t s, const Piece& piece) const;

  const Shapes& shapes;
  const std::vector<Shape_points>& all;
  double maximum_distance;
  std::vector<std::vector<Block>> blocks;
  std::vector<CGAL::Bbox_3> boxes;               // with the reach of the points
  std::vector<std::vector<std::size_t>> members; // shapes of each plane
};

} // namespace program

#endif // DETECT_PLANES_STRAIGHT_BORDERS_H
