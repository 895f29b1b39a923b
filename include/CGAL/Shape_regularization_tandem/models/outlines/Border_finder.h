// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where shapes end at the planes of others.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_FINDER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_FINDER_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Point_blocks.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Straight_border.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Unit.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/intervals.h>

#include <CGAL/Bbox_3.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

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
  std::size_t comparisons = 0;    // of shapes, blocks, points and pieces: what it took to find them
};

// Lengths are in the unit.
class Border_finder {
public:
  Border_finder(const Shapes& shapes, const Unit& unit, const std::vector<Shape_points>& all);

  // The ends of those that meet at a corner are there.
  Border_pieces pieces_of(std::size_t s, Straight_borders& borders) const;

  // With the planes of the shapes that may have points close to those of the shape.
  std::vector<Border_line> lines_near(std::size_t s) const
  {
    std::vector<Border_line> result;
    for(const Near_plane& other : planes_near(s))
      result.push_back(line_of(s, other.plane));
    return result;
  }

  Straight_border border_of(std::size_t s, const Border_piece& piece) const;
  Kernel::Point_3 on_line(const Border_line& line, double along) const;

private:
  struct Near_plane {
    int plane;                       // as coplanar group
    std::vector<std::size_t> shapes; // those of the plane that may have points close to those of a shape
    CGAL::Bbox_3 box;                // of these, with their reach
  };
  struct Near_point {
    double along, across;
    float spacing;
    std::uint32_t position;
  };
  using Line = Border_line;
  using Piece = Border_piece;

  double overhang(float spacing, const Line& line) const { return spacing + maximum_distance / line.sine; }
  double reach(float spacing, const Line& line) const { return 2 * spacing + maximum_distance / line.sine; }
  const Shapes::Coefficients& plane_of(std::size_t s) const { return planes[shapes.coplanar_group(s)]; }
  Kernel::Vector_3 normal_of(std::size_t s) const { return shapes.plane(s).orthogonal_vector(); }
  std::vector<Near_plane> planes_near(std::size_t s) const;
  Line line_of(std::size_t s, int plane) const;
  std::vector<Near_point> points_near(std::size_t s, const Line& line, const CGAL::Bbox_3& box,
                                      std::size_t& comparisons) const;
  void find_pieces(std::size_t s, const Near_plane& other, std::vector<Piece>& pieces, Straight_borders& result) const;
  std::vector<std::vector<std::size_t>> near_pieces(const std::vector<Piece>& pieces) const;
  void drop_outer(std::size_t s, std::vector<Piece>& pieces, std::size_t& comparisons) const;
  void join_at_corners(std::size_t s, std::vector<Piece>& pieces, std::size_t& comparisons) const;
  void join_at_corner(std::size_t s, Piece& a, Piece& b) const;
  int other_plane(std::size_t s, const Line& line) const { return line.other_than(int(shapes.coplanar_group(s))); }
  Kernel::Point_3 corner_of(std::size_t s, int plane, int other) const;

  const Shapes& shapes;
  const std::vector<Shape_points>& all;
  double maximum_distance;
  std::vector<Shapes::Coefficients> planes;   // of the coplanar groups
  std::vector<std::size_t> shape_of_plane;    // the first of each coplanar group
  std::vector<Point_blocks> blocks;           // of each shape
  std::vector<CGAL::Bbox_3> boxes;            // of each shape, with the reach of its points
  std::vector<std::vector<std::size_t>> near; // shapes that may have points close to those of each shape
};

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#include <CGAL/Shape_regularization_tandem/models/outlines/Border_finder_impl.h>

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_FINDER_H
