// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where shapes end at the planes of others.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_FINDER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_FINDER_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Point_blocks.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/outline_types.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// --- Sets of intervals on a line

struct Interval {
  double first, last;
  double length() const { return last - first; }
};

using Intervals = std::vector<Interval>; // ascending, apart

constexpr double shortest = 4; // shortest border, in spacings

inline Intervals intersection(const Intervals& a, const Intervals& b)
{
  Intervals result;
  for(std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const Interval both = {(std::max)(a[i].first, b[j].first), (std::min)(a[i].last, b[j].last)};
    if(both.first < both.last)
      result.push_back(both);
    ++(a[i].last < b[j].last ? i : j);
  }
  return result;
}

inline Intervals difference(const Intervals& a, const Intervals& b)
{
  Intervals result;
  for(Interval rest : a) {
    for(const Interval& hole : b) {
      if(hole.last <= rest.first || hole.first >= rest.last)
        continue;
      if(hole.first > rest.first)
        result.push_back({rest.first, hole.first});
      rest.first = hole.last;
    }
    if(rest.first < rest.last)
      result.push_back(rest);
  }
  return result;
}

// Where the points that are chosen follow each other closely. `points` are sorted along the line.
template <class Near_point, class Is_chosen>
Intervals runs(const std::vector<Near_point>& points, Is_chosen is_chosen)
{
  Intervals result;
  std::size_t count = 0;
  float last_spacing = 0;
  double sum = 0;
  const auto drop_short = [&] {
    if(!result.empty() && result.back().length() < shortest * sum / double(count))
      result.pop_back();
  };
  for(const Near_point& p : points) {
    if(!is_chosen(p))
      continue;
    if(result.empty() || count == 0 || p.along - result.back().last > 2 * (double(p.spacing) + last_spacing)) {
      if(count > 0)
        drop_short();
      result.push_back({p.along, p.along});
      count = 0;
      sum = 0;
    }
    result.back().last = p.along;
    ++count;
    sum += p.spacing;
    last_spacing = p.spacing;
  }
  if(count > 0)
    drop_short();
  return result;
}

// Across gaps up to a length, of half of it where there are obstacles. What is not covered for the most part is left out.
inline Intervals bridged(const Intervals& pieces, const Intervals& obstacles, double longest_gap)
{
  Intervals result;
  std::vector<double> covered;
  for(const Interval& piece : pieces) {
    if(!result.empty()) {
      const Intervals gap = {{result.back().last, piece.first}};
      if(gap[0].length() <= longest_gap / 2 ||
         (gap[0].length() <= longest_gap && intersection(gap, obstacles).empty())) {
        result.back().last = piece.last;
        covered.back() += piece.length();
        continue;
      }
    }
    result.push_back(piece);
    covered.push_back(piece.length());
  }
  Intervals kept;
  for(std::size_t i = 0; i < result.size(); ++i)
    if(covered[i] > .6 * result[i].length())
      kept.push_back(result[i]);
  return kept;
}

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

constexpr double largest_cosine = .97; // of directions that differ

template <class Near_point>
float median_spacing(const std::vector<Near_point>& points)
{
  std::vector<float> all;
  for(const Near_point& p : points)
    all.push_back(p.spacing);
  return median(all);
}

// Lengths are in the unit.
class Border_finder {
public:
  Border_finder(const Shapes& shapes, const Unit& unit, const std::vector<Shape_points>& all)
    : shapes(shapes), all(all), maximum_distance(unit.in(shapes.parameters().maximum_distance))
  {
    for(std::size_t s : shapes.distinct_planes()) {
      planes.push_back(unit.in(shapes.coefficients(s)));
      shape_of_plane.push_back(s);
    }
    for(const Shape_points& shape : all) {
      blocks.emplace_back(shape.points, shape.spacing);
      boxes.emplace_back();
      for(const Point_blocks::Block& block : blocks.back().smallest())
        boxes.back() += grown(block.box, 2. * block.spacing + maximum_distance / smallest_sine);
    }
    near = near_boxes(boxes);
  }

  // The ends of those that meet at a corner are there.
  Border_pieces pieces_of(std::size_t s, Straight_borders& borders) const
  {
    Border_pieces pieces;
    borders.comparisons = near[s].size();
    for(const Near_plane& other : planes_near(s))
      find_pieces(s, other, pieces, borders);
    drop_outer(s, pieces, borders.comparisons);
    join_at_corners(s, pieces, borders.comparisons);
    for(Border_piece& piece : pieces)
      for(Border_piece::End& end : piece.ends)
        end.along += end.shift;
    pieces.erase(std::remove_if(pieces.begin(), pieces.end(), [](const Border_piece& p) { return !(p.length() > 0); }),
                 pieces.end());
    return pieces;
  }

  // With the planes of the shapes that may have points close to those of the shape.
  std::vector<Border_line> lines_near(std::size_t s) const
  {
    std::vector<Border_line> result;
    for(const Near_plane& other : planes_near(s))
      result.push_back(line_of(s, other.plane));
    return result;
  }

  // Between the ends are vertices at the multiples of a power of two that is at most the spacing: those of a coarser shape
  // are among those of a denser one.
  Straight_border border_of(std::size_t s, const Border_piece& piece) const
  {
    const Border_line& line = piece.line;
    const int plane = other_plane(s, line);
    std::vector<std::pair<double, Border_vertex_position>> chain;
    for(const Border_piece::End& end : piece.ends) {
      const Border_vertex_position v = {end.third < 0 ? on_line(line, end.along) : corner_of(s, plane, end.third),
                                        end.third};
      chain.push_back({end.third < 0 ? end.along : line.along(v.point), v});
    }
    const double first = chain[0].first, last = chain[1].first, largest = (std::max)(std::fabs(first), std::fabs(last));
    // Copies of points have a spacing of about nothing: no more than 2^16 vertices, at places that differ.
    const double shortest_step = (std::max)(std::ldexp(last - first, -16), std::ldexp(largest, -50));
    const double step = std::ldexp(1, std::ilogb((std::max)(double(piece.spacing), shortest_step)));
    for(double i = std::ceil(first / step + .5); i * step < last - step / 2; ++i)
      chain.push_back({i * step, {on_line(line, i * step), -1}});
    for(const Border_vertex_position& c : piece.crossings)
      chain.push_back({line.along(c.point), c});
    std::sort(chain.begin(), chain.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if(!piece.is_left)
      std::reverse(chain.begin(), chain.end());
    Straight_border border = {{}, piece.spacing, float(piece.reach)};
    for(const auto& [along, vertex] : chain)
      border.chain.push_back(vertex);
    return border;
  }

  Kernel::Point_3 on_line(const Border_line& line, double along) const
  {
    return point_at(point_on_planes({planes[std::size_t(line.planes[0])], planes[std::size_t(line.planes[1])]},
                                    line.origin + along * line.direction));
  }

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

  double overhang(float spacing, const Border_line& line) const { return spacing + maximum_distance / line.sine; }
  double reach(float spacing, const Border_line& line) const { return 2 * spacing + maximum_distance / line.sine; }
  Kernel::Vector_3 normal_of(std::size_t s) const { return shapes.plane(s).orthogonal_vector(); }

  // In ascending order.
  std::vector<Near_plane> planes_near(std::size_t s) const
  {
    std::map<int, Near_plane> found;
    for(std::size_t t : near[s]) {
      Near_plane& other = found[int(shapes.coplanar_group(t))];
      other.plane = int(shapes.coplanar_group(t));
      other.shapes.push_back(t);
      other.box += boxes[t];
    }
    found.erase(int(shapes.coplanar_group(s)));
    std::vector<Near_plane> result;
    for(const auto& [plane, other] : found) {
      const std::size_t t = shape_of_plane[std::size_t(plane)];
      if(CGAL::cross_product(normal_of(s), normal_of(t)).squared_length() >= smallest_sine * smallest_sine)
        result.push_back(other);
    }
    return result;
  }

  Border_line line_of(std::size_t s, int plane) const
  {
    const int own = int(shapes.coplanar_group(s)), low = (std::min)(own, plane), high = (std::max)(own, plane);
    const Shapes::Coefficients &a = planes[std::size_t(low)], &b = planes[std::size_t(high)];
    const Kernel::Vector_3 direction =
      CGAL::cross_product(Kernel::Vector_3(a[0], a[1], a[2]), Kernel::Vector_3(b[0], b[1], b[2]));
    const double sine = std::sqrt(direction.squared_length());
    const Kernel::Point_3& near_point = all[shape_of_plane[std::size_t(low)]].points[0];
    return {{low, high}, point_at(point_on_planes({a, b}, near_point)), direction / sine, sine};
  }

  // Of the points in a box, and somewhat around it. Sorted along the line. `across` is positive to the left of the line.
  std::vector<Near_point> points_near(std::size_t s, const Border_line& line, const CGAL::Bbox_3& box,
                                      std::size_t& comparisons) const
  {
    const Shape_points& shape = all[s];
    const Kernel::Vector_3 left = CGAL::cross_product(normal_of(s), line.direction);
    const auto is_near = [&](const Point_blocks::Block& block) {
      const CGAL::Bbox_3& b = block.box;
      const Kernel::Vector_3 half((b.xmax() - b.xmin()) / 2, (b.ymax() - b.ymin()) / 2, (b.zmax() - b.zmin()) / 2);
      const Kernel::Vector_3 center = Kernel::Point_3(b.xmin(), b.ymin(), b.zmin()) + half - line.origin;
      ++comparisons;
      return std::fabs(center * left) <=
               std::sqrt(half.squared_length()) + reach(block.spacing, line) + 2 * block.spacing &&
             CGAL::do_overlap(grown(b, 2 * shortest * block.spacing), box);
    };
    std::vector<Near_point> result;
    blocks[s].for_each(is_near, [&](std::size_t i) {
      const Kernel::Vector_3 v = shape.points[i] - line.origin;
      const Near_point p = {v * line.direction, v * left, shape.spacing[i], std::uint32_t(i)};
      ++comparisons;
      if(std::fabs(p.across) <= reach(p.spacing, line) + 2 * p.spacing)
        result.push_back(p);
    });
    std::sort(result.begin(), result.end(), [](const Near_point& p, const Near_point& q) {
      return std::make_pair(p.along, p.position) < std::make_pair(q.along, q.position);
    });
    return result;
  }

  // The shape ends at the other plane where points of both are close to their line, and it has points farther away from
  // the line on one side only.
  void find_pieces(std::size_t s, const Near_plane& other, Border_pieces& pieces, Straight_borders& result) const
  {
    const Border_line line = line_of(s, other.plane);
    const auto is_near = [&](const Near_point& p) { return std::fabs(p.across) <= reach(p.spacing, line); };
    const std::vector<Near_point> near_points = points_near(s, line, other.box, result.comparisons);
    const Intervals own = runs(near_points, is_near);
    if(own.empty())
      return;
    std::vector<Near_point> of_other;
    for(std::size_t t : other.shapes) {
      const std::vector<Near_point> more = points_near(t, line, boxes[s], result.comparisons);
      of_other.insert(of_other.end(), more.begin(), more.end());
    }
    std::sort(of_other.begin(), of_other.end(),
              [](const Near_point& p, const Near_point& q) { return p.along < q.along; });
    const Intervals common = intersection(own, runs(of_other, is_near));
    if(common.empty())
      return;
    const Intervals left = runs(near_points, [&](const Near_point& p) { return p.across > overhang(p.spacing, line); });
    const Intervals right =
      runs(near_points, [&](const Near_point& p) { return -p.across > overhang(p.spacing, line); });
    for(bool is_left : {true, false})
      for(const Interval& i : bridged(intersection(common, is_left ? difference(left, right) : difference(right, left)),
                                      is_left ? right : left, 16 * median_spacing(near_points))) {
        std::vector<Near_point> inside;
        for(const Near_point& p : near_points)
          if(p.along >= i.first && p.along <= i.last)
            inside.push_back(p);
        if(inside.empty())
          continue;
        const float spacing = median_spacing(inside);
        if(!(spacing > 0) || i.length() < shortest * spacing) // 0: all points are on a line
          continue;
        pieces.push_back({line, {{i.first}, {i.last}}, is_left, spacing, reach(spacing, line), {}});
        for(const Near_point& p : inside)
          if((p.across > 0) != is_left && std::fabs(p.across) <= overhang(p.spacing, line))
            result.cut.push_back(p.position);
      }
  }

  // For each piece those that may meet it within their reach.
  std::vector<std::vector<std::size_t>> near_pieces(const Border_pieces& pieces) const
  {
    std::vector<CGAL::Bbox_3> boxes;
    for(const Border_piece& p : pieces) {
      const auto at = [&](double along) { return (p.line.origin + along * p.line.direction).bbox(); };
      boxes.push_back(grown(at(p.ends[0].along) + at(p.ends[1].along), 1.01 * p.reach));
    }
    return near_boxes(boxes);
  }

  // Of two lines that are close to each other, the shape ends at the inner one.
  void drop_outer(std::size_t s, Border_pieces& pieces, std::size_t& comparisons) const
  {
    const Border_pieces all_pieces = std::exchange(pieces, {});
    const auto near_piece = near_pieces(all_pieces);
    for(std::size_t o = 0; o < all_pieces.size(); ++o) {
      const Border_piece& outer = all_pieces[o];
      const Kernel::Vector_3 left = CGAL::cross_product(normal_of(s), outer.line.direction);
      Intervals rest = {{outer.ends[0].along, outer.ends[1].along}};
      for(std::size_t i : near_piece[o]) {
        const Border_piece& inner = all_pieces[i];
        const double cosine = inner.line.direction * outer.line.direction;
        const Kernel::Vector_3 shift = inner.line.origin - outer.line.origin;
        const double depth = (outer.is_left ? 1 : -1) * (shift * left);
        ++comparisons;
        if(other_plane(s, inner.line) == other_plane(s, outer.line) || std::fabs(cosine) < largest_cosine ||
           (cosine > 0) != (inner.is_left == outer.is_left) || depth < 0 || depth > outer.reach)
          continue;
        const auto along = [&](double x) { return shift * outer.line.direction + x * cosine; };
        const double a = along(inner.ends[0].along), b = along(inner.ends[1].along);
        rest = difference(rest, {{(std::min)(a, b), (std::max)(a, b)}});
      }
      for(const Interval& i : rest)
        if(i.length() >= shortest * outer.spacing) {
          pieces.push_back(outer);
          pieces.back().ends[0].along = i.first;
          pieces.back().ends[1].along = i.last;
        }
    }
  }

  void join_at_corners(std::size_t s, Border_pieces& pieces, std::size_t& comparisons) const
  {
    const auto near_piece = near_pieces(pieces);
    for(std::size_t i = 0; i < pieces.size(); ++i)
      for(std::size_t j : near_piece[i]) {
        ++comparisons;
        if(j < i)
          join_at_corner(s, pieces[i], pieces[j]);
      }
  }

  // Ends that are close to the common point of the three planes move there. A piece that passes it gets it as a vertex.
  void join_at_corner(std::size_t s, Border_piece& a, Border_piece& b) const
  {
    const int plane_a = other_plane(s, a.line), plane_b = other_plane(s, b.line);
    if(plane_a == plane_b ||
       CGAL::cross_product(a.line.direction, b.line.direction).squared_length() < smallest_sine * smallest_sine)
      return;
    const Kernel::Point_3 corner = corner_of(s, plane_a, plane_b);
    const auto touches = [&](const Border_piece& p) {
      const double x = p.line.along(corner);
      return x > p.ends[0].along - p.reach && x < p.ends[1].along + p.reach;
    };
    if(!touches(a) || !touches(b))
      return;
    for(auto [piece, third] : {std::make_pair(&a, plane_b), std::make_pair(&b, plane_a)}) {
      const double x = piece->line.along(corner);
      const double shift[2] = {x - piece->ends[0].along, x - piece->ends[1].along};
      const int nearer = std::fabs(shift[0]) < std::fabs(shift[1]) ? 0 : 1;
      Border_piece::End& end = piece->ends[nearer];
      if(std::fabs(shift[nearer]) > piece->reach)
        piece->crossings.push_back({corner, third});
      else if(end.third < 0 || std::fabs(shift[nearer]) < std::fabs(end.shift)) {
        end.third = third;
        end.shift = shift[nearer];
      }
    }
  }

  int other_plane(std::size_t s, const Border_line& line) const
  {
    return line.other_than(int(shapes.coplanar_group(s)));
  }

  // The same for each of the three shapes.
  Kernel::Point_3 corner_of(std::size_t s, int plane, int other) const
  {
    std::size_t groups[3] = {std::size_t(shapes.coplanar_group(s)), std::size_t(plane), std::size_t(other)};
    std::sort(groups, groups + 3);
    return point_at(point_on_planes({planes[groups[0]], planes[groups[1]], planes[groups[2]]},
                                    all[shape_of_plane[groups[0]]].points[0]));
  }

  const Shapes& shapes;
  const std::vector<Shape_points>& all;
  double maximum_distance;
  std::vector<Shapes::Coefficients> planes;   // of the coplanar groups
  std::vector<std::size_t> shape_of_plane;    // the first of each coplanar group
  std::vector<Point_blocks> blocks;           // of each shape
  std::vector<CGAL::Bbox_3> boxes;            // of each shape, with the reach of its points
  std::vector<std::vector<std::size_t>> near; // shapes that may have points close to those of each shape
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_BORDER_FINDER_H
