// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/straight_borders.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace program {

namespace {

constexpr double smallest_sine = .25;  // about 15 degrees: flatter lines are not well defined by their points
constexpr double largest_cosine = .97; // of directions that differ
constexpr std::size_t block_size = 64;

CGAL::Bbox_3 grown(const CGAL::Bbox_3& b, double d)
{
  return {b.xmin() - d, b.ymin() - d, b.zmin() - d, b.xmax() + d, b.ymax() + d, b.zmax() + d};
}

template <class Near_point>
float median_spacing(const std::vector<Near_point>& points)
{
  std::vector<float> all;
  for(const Near_point& p : points)
    all.push_back(p.spacing);
  std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(all.size() / 2), all.end());
  return all[all.size() / 2];
}

Kernel::Vector_3 normal_of(const Shapes& shapes, std::size_t s) { return shapes.oriented_plane(s).orthogonal_vector(); }

} // namespace

Border_finder::Border_finder(const Shapes& shapes, const std::vector<Shape_points>& all)
  : shapes(shapes), all(all), maximum_distance(shapes.parameters().maximum_distance), blocks(all.size()),
    members(shapes.number_of_coplanar_groups())
{
  for(std::size_t s = 0; s < all.size(); ++s) {
    const Shape_points& shape = all[s];
    CGAL::Bbox_3 box;
    for(std::size_t i = 0; i < shape.points.size(); ++i) {
      if(i % block_size == 0)
        blocks[s].push_back({shape.points[i].bbox(), 0});
      Block& block = blocks[s].back();
      block.box += shape.points[i].bbox();
      block.spacing = (std::max)(block.spacing, shape.spacing[i]);
    }
    for(const Block& block : blocks[s])
      box += grown(block.box, 2. * block.spacing + maximum_distance / smallest_sine);
    boxes.push_back(box);
    members[shapes.coplanar_group(s)].push_back(s);
  }
}

// Planes of shapes that may have points close to those of `s`.
std::vector<int> Border_finder::planes_near(std::size_t s) const
{
  std::vector<int> result;
  for(std::size_t g = 0; g < members.size(); ++g) {
    if(g == shapes.coplanar_group(s))
      continue;
    const Kernel::Vector_3 across = CGAL::cross_product(normal_of(shapes, s), normal_of(shapes, members[g][0]));
    if(across.squared_length() < smallest_sine * smallest_sine)
      continue;
    if(std::any_of(members[g].begin(), members[g].end(),
                   [&](std::size_t t) { return CGAL::do_overlap(boxes[s], boxes[t]); }))
      result.push_back(int(g));
  }
  return result;
}

Border_finder::Line Border_finder::line_of(std::size_t s, int plane) const
{
  const std::size_t t = members[std::size_t(plane)][0];
  const Kernel::Vector_3 direction = CGAL::cross_product(normal_of(shapes, s), normal_of(shapes, t));
  const double sine = std::sqrt(direction.squared_length());
  const Position p = point_on_planes({shapes.coefficients(s), shapes.coefficients(t)}, all[s].points[0]);
  return {plane, Kernel::Point_3(p[0], p[1], p[2]), direction / sine, sine};
}

// Sorted along the line. `across` is positive to the left of the line.
std::vector<Border_finder::Near_point> Border_finder::points_near(std::size_t s, const Line& line) const
{
  const Shape_points& shape = all[s];
  const Kernel::Vector_3 left = CGAL::cross_product(normal_of(shapes, s), line.direction);
  std::vector<Near_point> result;
  for(std::size_t b = 0; b < blocks[s].size(); ++b) {
    const CGAL::Bbox_3& box = blocks[s][b].box;
    const Kernel::Vector_3 half((box.xmax() - box.xmin()) / 2, (box.ymax() - box.ymin()) / 2,
                                (box.zmax() - box.zmin()) / 2);
    const Kernel::Vector_3 center = Kernel::Point_3(box.xmin(), box.ymin(), box.zmin()) + half - line.origin;
    if(std::fabs(center * left) >
       std::sqrt(half.squared_length()) + reach(blocks[s][b].spacing, line) + 2 * blocks[s][b].spacing)
      continue;
    const std::size_t end = (std::min)(shape.points.size(), (b + 1) * block_size);
    for(std::size_t i = b * block_size; i < end; ++i) {
      const Kernel::Vector_3 v = shape.points[i] - line.origin;
      const Near_point p = {v * line.direction, v * left, shape.spacing[i], std::uint32_t(i)};
      if(std::fabs(p.across) <= reach(p.spacing, line) + 2 * p.spacing)
        result.push_back(p);
    }
  }
  std::sort(result.begin(), result.end(), [](const Near_point& p, const Near_point& q) {
    return std::make_pair(p.along, p.position) < std::make_pair(q.along, q.position);
  });
  return result;
}

// The shape ends at the other plane where points of both are close to their line, and it has points farther away from
// the line on one side only.
void Border_finder::find_pieces(std::size_t s, const Line& line, std::vector<Piece>& pieces,
                                std::vector<std::uint32_t>& cut) const
{
  const auto is_near = [&](const Near_point& p) { return std::fabs(p.across) <= reach(p.spacing, line); };
  const std::vector<Near_point> near_points = points_near(s, line);
  const Intervals own = runs(near_points, is_near);
  if(own.empty())
    return;
  std::vector<Near_point> of_other;
  for(std::size_t t : members[std::size_t(line.plane)])
    if(CGAL::do_overlap(boxes[s], boxes[t])) {
      const std::vector<Near_point> more = points_near(t, line);
      of_other.insert(of_other.end(), more.begin(), more.end());
    }
  std::sort(of_other.begin(), of_other.end(),
            [](const Near_point& p, const Near_point& q) { return p.along < q.along; });
  const Intervals common = intersection(own, runs(of_other, is_near));
  if(common.empty())
    return;
  const Intervals left = runs(near_points, [&](const Near_point& p) { return p.across > overhang(p.spacing, line); });
  const Intervals right = runs(near_points, [&](const Near_point& p) { return -p.across > overhang(p.spacing, line); });
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
      pieces.push_back({line, i, is_left, spacing, {-1, -1}, {0, 0}, {}});
      for(const Near_point& p : inside)
        if((p.across > 0) != is_left && std::fabs(p.across) <= overhang(p.spacing, line))
          cut.push_back(p.position);
    }
}

Kernel::Point_3 Border_finder::on_line(std::size_t s, const Line& line, double along) const
{
  const std::size_t t = members[std::size_t(line.plane)][0];
  const Position p =
    point_on_planes({shapes.coefficients(s), shapes.coefficients(t)}, line.origin + along * line.direction);
  return Kernel::Point_3(p[0], p[1], p[2]);
}

// The same for each of the three shapes.
Kernel::Point_3 Border_finder::corner_of(std::size_t s, int plane, int other) const
{
  int planes[3] = {int(shapes.coplanar_group(s)), plane, other};
  std::sort(planes, planes + 3);
  std::vector<Shapes::Coefficients> coefficients;
  for(int p : planes)
    coefficients.push_back(shapes.coefficients(members[std::size_t(p)][0]));
  const Position p = point_on_planes(coefficients, all[members[std::size_t(planes[0])][0]].points[0]);
  return Kernel::Point_3(p[0], p[1], p[2]);
}

// Ends that are close to the common point of the three planes move there. A piece that passes it gets it as a vertex.
void Border_finder::join_at_corner(std::size_t s, Piece& a, Piece& b) const
{
  if(a.line.plane == b.line.plane ||
     CGAL::cross_product(a.line.direction, b.line.direction).squared_length() < smallest_sine * smallest_sine)
    return;
  const Kernel::Point_3 corner = corner_of(s, a.line.plane, b.line.plane);
  const auto along = [&](const Piece& p) { return (corner - p.line.origin) * p.line.direction; };
  const auto slack = [&](const Piece& p) { return reach(p.spacing, p.line); };
  const auto touches = [&](const Piece& p) {
    return along(p) > p.interval.first - slack(p) && along(p) < p.interval.last + slack(p);
  };
  if(!touches(a) || !touches(b))
    return;
  for(auto [piece, other] : {std::make_pair(&a, &b), std::make_pair(&b, &a)}) {
    const double x = along(*piece);
    const double shift[2] = {x - piece->interval.first, x - piece->interval.last};
    const int end = std::fabs(shift[0]) < std::fabs(shift[1]) ? 0 : 1;
    if(std::fabs(shift[end]) > slack(*piece))
      piece->crossings.push_back({corner, other->line.plane});
    else if(piece->third[end] < 0 || std::fabs(shift[end]) < std::fabs(piece->shift[end])) {
      piece->third[end] = other->line.plane;
      piece->shift[end] = shift[end];
    }
  }
}

// Of two lines that are close to each other, the shape ends at the inner one.
void Border_finder::drop_outer(std::size_t s, std::vector<Piece>& pieces) const
{
  const std::vector<Piece> all_pieces = std::exchange(pieces, {});
  for(const Piece& outer : all_pieces) {
    const Kernel::Vector_3 left = CGAL::cross_product(normal_of(shapes, s), outer.line.direction);
    Intervals rest = {outer.interval};
    for(const Piece& inner : all_pieces) {
      const double cosine = inner.line.direction * outer.line.direction;
      const Kernel::Vector_3 shift = inner.line.origin - outer.line.origin;
      const double depth = (outer.is_left ? 1 : -1) * (shift * left);
      if(inner.line.plane == outer.line.plane || std::fabs(cosine) < largest_cosine ||
         (cosine > 0) != (inner.is_left == outer.is_left) || depth < 0 || depth > reach(outer.spacing, outer.line))
        continue;
      const auto along = [&](double x) { return shift * outer.line.direction + x * cosine; };
      const auto [first, last] = std::minmax(along(inner.interval.first), along(inner.interval.last));
      rest = difference(rest, {{first, last}});
    }
    for(const Interval& i : rest)
      if(i.length() >= shortest * outer.spacing) {
        pieces.push_back(outer);
        pieces.back().interval = i;
      }
  }
}

Straight_border Border_finder::border_of(std::size_t s, const Piece& piece) const
{
  const Line& line = piece.line;
  const double first = piece.interval.first + piece.shift[0], last = piece.interval.last + piece.shift[1];
  std::vector<std::pair<double, Border_vertex_position>> chain;
  const auto add = [&](double along, int third) {
    if(third < 0) {
      chain.push_back({along, {on_line(s, line, along), -1}});
      return;
    }
    chain.push_back({along, {corner_of(s, line.plane, third), third}});
  };
  add(first, piece.third[0]);
  add(last, piece.third[1]);
  const double steps = std::floor((last - first) / piece.spacing);
  for(int i = 1; i < steps; ++i)
    add(first + i * (last - first) / steps, -1);
  for(const Border_vertex_position& c : piece.crossings)
    chain.push_back({(c.point - line.origin) * line.direction, c});
  std::sort(chain.begin(), chain.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  if(!piece.is_left)
    std::reverse(chain.begin(), chain.end());
  Straight_border border = {line.plane, {}, piece.spacing, float(reach(piece.spacing, line))};
  for(const auto& [along, vertex] : chain)
    border.chain.push_back(vertex);
  return border;
}

Straight_borders Border_finder::borders_of(std::size_t s) const
{
  Straight_borders result;
  std::vector<Piece> pieces;
  for(int plane : planes_near(s))
    find_pieces(s, line_of(s, plane), pieces, result.cut);
  drop_outer(s, pieces);
  for(std::size_t i = 0; i < pieces.size(); ++i)
    for(std::size_t j = 0; j < i; ++j)
      join_at_corner(s, pieces[i], pieces[j]);
  for(const Piece& piece : pieces)
    if(piece.interval.length() + piece.shift[1] - piece.shift[0] > 0)
      result.borders.push_back(border_of(s, piece));
  return result;
}

} // namespace program
