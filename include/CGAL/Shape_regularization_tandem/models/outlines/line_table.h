// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the lines of two planes that are in the outlines of both, and where three planes meet in such parts.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_LINE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_LINE_TABLE_H

#include <CGAL/Shape_regularization_tandem/models/Line_table.h>
#include <CGAL/Shape_regularization_tandem/models/Polygon_table.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Border_finder.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Point_blocks.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/outline_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// Of intervals in any order, whose gaps up to a length are closed.
inline Intervals united(Intervals all, double longest_gap)
{
  std::sort(all.begin(), all.end(), [](const Interval& a, const Interval& b) { return a.first < b.first; });
  Intervals result;
  for(const Interval& i : all)
    if(!result.empty() && i.first <= result.back().last + longest_gap)
      result.back().last = (std::max)(result.back().last, i.last);
    else
      result.push_back(i);
  return result;
}

// Points that differ by the rounding of coordinates are one: that which was there first.
class Joined_points {
public:
  Kernel::Point_3 operator()(const Kernel::Point_3& p)
  {
    for(int corner = 0; corner < 8; ++corner) { // of a cube around the point
      const auto shift = [&](int k) { return (corner >> k & 1) != 0 ? rounding : -rounding; };
      const auto [first, last] = of_cell.equal_range(cell(p + Kernel::Vector_3(shift(0), shift(1), shift(2))));
      for(auto i = first; i != last; ++i)
        if(CGAL::squared_distance(i->second, p) <= rounding * rounding)
          return i->second;
    }
    return of_cell.emplace(cell(p), p)->second;
  }

private:
  static constexpr double rounding = 0x1p-45;

  static std::array<double, 3> cell(const Kernel::Point_3& p)
  {
    constexpr double width = 2 * rounding;
    return {std::floor(p.x() / width), std::floor(p.y() / width), std::floor(p.z() / width)};
  }

  std::multimap<std::array<double, 3>, Kernel::Point_3> of_cell;
};

class Line_finder {
public:
  Line_finder(const Polygon_table& table, const Shapes_data& data) : table(table), data(data), unit(table.points)
  {
    maximum_distance = unit.in(data.parameters.maximum_distance);
    for(const Coefficients& c : data.coefficients)
      planes.push_back(unit.in(c));
    for(const Position& p : table.points)
      points.push_back(unit.in(p));
    for(const std::vector<Polygon>& polygons : table.polygons) {
      boxes.emplace_back();
      for(const Polygon& polygon : polygons)
        for(std::uint32_t corner : polygon.outer)
          boxes.back() += points[corner].bbox();
      if(!polygons.empty())
        boxes.back() = grown(boxes.back(), tolerance(smallest_sine));
    }
  }

  Line_table lines()
  {
    const std::vector<std::vector<std::size_t>> near = near_boxes(boxes);
    std::vector<std::vector<Piece>> of_shape(near.size());
    for_each_in_parallel(near.size(), [&](std::size_t s) {
      for(std::size_t t : near[s])
        if(t > s && data.parallel_group[s] != data.parallel_group[t])
          find_pieces(s, t, of_shape[s]);
    });
    for(const std::vector<Piece>& found : of_shape)
      pieces.insert(pieces.end(), found.begin(), found.end());
    find_corners();
    return joined_lines();
  }

private:
  struct Corner {
    Kernel::Point_3 point;
    std::set<std::uint32_t> shapes;
  };

  // A part of a line that both shapes have.
  struct Piece {
    struct End {
      double along;
      const Corner* corner = nullptr;                         // that is there
      double shift = std::numeric_limits<double>::infinity(); // by which it was moved to the corner
    };

    Border_line line;
    std::array<std::size_t, 2> shapes;
    std::array<int, 2> sides;
    End ends[2]; // in the order of the direction of the line
    double tolerance;
  };

  // How far from the line of two planes an outline may end: where the points are as far from their plane as they may be.
  double tolerance(double sine) const { return maximum_distance / (std::max)(sine, smallest_sine); }

  Kernel::Vector_3 normal_of(std::size_t s) const { return Kernel::Vector_3(planes[s][0], planes[s][1], planes[s][2]); }

  // The same for all shapes of both planes.
  Border_line line_of(std::size_t s, std::size_t t) const
  {
    if(data.coplanar_group[s] > data.coplanar_group[t])
      std::swap(s, t);
    const Kernel::Vector_3 direction = CGAL::cross_product(normal_of(s), normal_of(t));
    const double sine = std::sqrt(direction.squared_length());
    return {{data.coplanar_group[s], data.coplanar_group[t]},
            point_at(point_on_planes({planes[s], planes[t]}, CGAL::ORIGIN)),
            direction / sine,
            sine};
  }

  Kernel::Vector_3 left_of(std::size_t s, const Border_line& line) const
  {
    return CGAL::cross_product(normal_of(s), line.direction);
  }

  // Of a line, those in an outline: as seen from the left of the line and from its right, and all.
  struct Parts {
    Intervals left, right, all;
  };

  // Corners within the tolerance count as on the line. The boundary crosses the line where it goes on to the other side: as
  // seen from each side of the line, the outline has the places with an odd number of crossings before them. Edges on the
  // line are added, as a narrow outline may have no other corners.
  Parts parts_in(std::size_t s, const Border_line& line) const
  {
    const Kernel::Vector_3 left = left_of(s, line);
    Parts result;
    std::vector<double> crossings[2]; // seen from the left and from the right
    const auto add_loop = [&](const Polygon::Loop& loop) {
      std::vector<std::pair<double, double>> places; // along and across
      for(std::uint32_t corner : loop) {
        const Kernel::Vector_3 v = points[corner] - line.origin;
        const double across = v * left;
        places.emplace_back(v * line.direction, std::fabs(across) <= tolerance(line.sine) ? 0 : across);
      }
      for(std::size_t i = 0; i < places.size(); ++i) {
        const auto [x, height] = places[i];
        const auto [y, other_height] = places[(i + 1) % places.size()];
        if(height == 0 && other_height == 0)
          result.all.push_back({(std::min)(x, y), (std::max)(x, y)});
        const double crossing = height == other_height ? x : x + height / (height - other_height) * (y - x);
        if((height > 0) != (other_height > 0))
          crossings[0].push_back(crossing);
        if((height < 0) != (other_height < 0))
          crossings[1].push_back(crossing);
      }
    };
    for(const Polygon& polygon : table.polygons[s]) {
      add_loop(polygon.outer);
      for(const Polygon::Loop& hole : polygon.holes)
        add_loop(hole);
    }
    for(bool is_left : {true, false}) {
      std::vector<double>& all = crossings[is_left ? 0 : 1];
      Intervals& inside = is_left ? result.left : result.right;
      std::sort(all.begin(), all.end());
      for(std::size_t i = 0; i + 1 < all.size(); i += 2)
        inside.push_back({all[i], all[i + 1]});
      result.all.insert(result.all.end(), inside.begin(), inside.end());
    }
    result.all = united(result.all, 0);
    return result;
  }

  // Along most of an interval: 1, if the outline is on the left only and that is positive, or on the right only and that
  // is; -1 if it is on the other side only; otherwise 0.
  static int side(const Parts& parts, const Interval& interval, bool is_left_positive)
  {
    const auto is_along = [&](const Intervals& part) {
      double length = 0;
      for(const Interval& i : intersection(part, {interval}))
        length += i.length();
      return 2 * length > interval.length();
    };
    const bool is_left = is_along(parts.left);
    if(is_left == is_along(parts.right))
      return 0;
    return is_left == is_left_positive ? 1 : -1;
  }

  void find_pieces(std::size_t s, std::size_t t, std::vector<Piece>& result) const
  {
    constexpr double rounding =
      0x1p-20; // of the angle of planes that are parallel, but for the digits they were given with
    const Border_line line = line_of(s, t);
    if(!(line.sine > rounding))
      return;
    const double most = tolerance(line.sine);
    const Parts own = parts_in(s, line);
    if(own.all.empty())
      return;
    const Parts other = parts_in(t, line);
    const bool is_own_left = left_of(s, line) * normal_of(t) > 0, is_other_left = left_of(t, line) * normal_of(s) > 0;
    for(const Interval& i : united(intersection(own.all, other.all), most))
      if(i.length() > 2 * most) // both ends may move by that
        result.push_back(
          {line, {s, t}, {side(own, i, is_own_left), side(other, i, is_other_left)}, {{i.first}, {i.last}}, most});
  }

  // For each piece those that may meet it.
  std::vector<std::vector<std::size_t>> near_pieces() const
  {
    std::vector<CGAL::Bbox_3> all;
    for(const Piece& p : pieces) {
      const auto at = [&](const Piece::End& end) { return (p.line.origin + end.along * p.line.direction).bbox(); };
      all.push_back(grown(at(p.ends[0]) + at(p.ends[1]), 1.01 * p.tolerance));
    }
    return near_boxes(all);
  }

  void find_corners()
  {
    const auto near = near_pieces();
    for(std::size_t i = 0; i < pieces.size(); ++i)
      for(std::size_t j : near[i])
        if(j < i)
          join_at_corner(pieces[i], pieces[j]);
  }

  // Two lines in one plane meet where three planes do. Their ends within the tolerance are there.
  void join_at_corner(Piece& a, Piece& b)
  {
    std::map<int, std::size_t> shape_of_plane;
    for(const Piece* piece : {&a, &b})
      for(std::size_t s : piece->shapes)
        shape_of_plane.emplace(data.coplanar_group[s], s);
    if(shape_of_plane.size() != 3 ||
       CGAL::cross_product(a.line.direction, b.line.direction).squared_length() < smallest_sine * smallest_sine)
      return;
    std::vector<int> groups;
    std::vector<Coefficients> three;
    for(const auto& [plane, s] : shape_of_plane) {
      groups.push_back(plane);
      three.push_back(planes[s]);
    }
    const Kernel::Point_3 p = point_at(point_on_planes(three, CGAL::ORIGIN));
    const auto touches = [&](const Piece& piece) {
      const double x = piece.line.along(p);
      return x >= piece.ends[0].along - piece.tolerance && x <= piece.ends[1].along + piece.tolerance;
    };
    if(!touches(a) || !touches(b))
      return;
    Corner& corner = corners.emplace(groups, Corner{p, {}}).first->second;
    for(Piece* piece : {&a, &b}) {
      corner.shapes.insert(piece->shapes.begin(), piece->shapes.end());
      const double x = piece->line.along(p);
      Piece::End& end = piece->ends[x - piece->ends[0].along <= piece->ends[1].along - x ? 0 : 1];
      const double shift = std::fabs(x - end.along);
      if(shift <= piece->tolerance && shift < end.shift) {
        end.corner = &corner;
        end.shift = shift;
      }
    }
  }

  // In one table of points, in which those of the outlines are the same bit for bit.
  Line_table joined_lines() const
  {
    Joined_points joined;
    for(const Kernel::Point_3& p : points)
      joined(p);
    Line_table result;
    std::map<Position, std::uint32_t> number_of;
    const auto number = [&](const Kernel::Point_3& p) {
      const Kernel::Point_3 q = joined(p);
      const auto added = number_of.emplace(unit.out({q.x(), q.y(), q.z()}), std::uint32_t(result.points.size()));
      if(added.second)
        result.points.push_back(added.first->first);
      return added.first->second;
    };
    std::map<std::uint32_t, std::set<std::uint32_t>> shapes_of_point;
    for(const auto& [groups, corner] : corners)
      shapes_of_point[number(corner.point)].insert(corner.shapes.begin(), corner.shapes.end());
    for(const auto& [point, shapes] : shapes_of_point)
      result.corners.push_back({point, {shapes.begin(), shapes.end()}});
    for(const Piece& piece : pieces) {
      Indexed_segment segment = {{}, {std::uint32_t(piece.shapes[0]), std::uint32_t(piece.shapes[1])}, piece.sides};
      for(std::size_t i : {0, 1}) {
        const Piece::End& end = piece.ends[i];
        const Kernel::Point_3 near = piece.line.origin + end.along * piece.line.direction;
        segment.ends[i] = number(
          end.corner != nullptr ? end.corner->point
                                : point_at(point_on_planes({planes[piece.shapes[0]], planes[piece.shapes[1]]}, near)));
      }
      // The direction of the line depends on the orientations of the planes.
      if(result.points[segment.ends[1]] < result.points[segment.ends[0]])
        std::swap(segment.ends[0], segment.ends[1]);
      result.segments.push_back(segment);
    }
    return result;
  }

  const Polygon_table& table;
  const Shapes_data& data;
  Unit unit;
  double maximum_distance;
  std::vector<Coefficients> planes;    // of the shapes
  std::vector<Kernel::Point_3> points; // the corners of the outlines
  std::vector<CGAL::Bbox_3> boxes;     // of the shapes, with the tolerance
  std::vector<Piece> pieces;
  std::map<std::vector<int>, Corner> corners; // by their planes
};

// NOLINTNEXTLINE(misc-definitions-in-headers): inline where no library is linked
CGAL_TANDEM_MODELS_INLINE Line_table line_table(const Polygon_table& table, const Shapes_data& data)
{
  return Line_finder(table, data).lines();
}

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_LINE_TABLE_H
