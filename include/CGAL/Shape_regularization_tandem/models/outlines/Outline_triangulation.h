// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outline of a shape, and the triangulation of its points in its plane that it comes
// from. Triangles whose circumscribed circle is small, compared with the spacing of the points there, are inside.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/outline_types.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <unordered_map>
#include <vector>

namespace CGAL::Tandem::internal::outlines {

// --- Points of a plane without those that are close to another one

// No two places are closer to each other than the distance, and each point is closer than that to its place, the first
// one of these.
struct Distinct_places {
  static constexpr double shortest = 0x1p-50;

  std::vector<Kernel::Point_2> places;
  std::vector<std::size_t> place_of; // of each point

  // Coordinates are up to 1, and the distance is at least `shortest`.
  Distinct_places(const std::vector<Kernel::Point_2>& points, double distance)
  {
    const auto column = [&](double x) { return std::int64_t(std::floor(x / distance)); };
    const auto key = [](std::int64_t i, std::int64_t j) { // squares that have the same one are looked at together
      return std::uint64_t(i) * 0x9e3779b97f4a7c15u ^ std::uint64_t(j) * 0xc2b2ae3d27d4eb4fu;
    };
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> places_of_square;
    place_of.reserve(points.size());
    for(const Kernel::Point_2& p : points) {
      std::size_t place = places.size();
      for(std::int64_t i = -1; i <= 1; ++i)
        for(std::int64_t j = -1; j <= 1; ++j) {
          const auto square = places_of_square.find(key(column(p.x()) + i, column(p.y()) + j));
          if(square == places_of_square.end())
            continue;
          for(std::size_t other : square->second)
            if(other < place && CGAL::squared_distance(places[other], p) < distance * distance)
              place = other;
        }
      place_of.push_back(place);
      if(place < places.size())
        continue;
      places.push_back(p);
      places_of_square[key(column(p.x()), column(p.y()))].push_back(place);
    }
  }
};

class Outline_triangulation {
public:
  // Fastest if points that are close in the sequence are close in the plane. Points that are closer to each other than
  // the resolution may be copies of one.
  explicit Outline_triangulation(const std::vector<Kernel::Point_2>& points, double resolution = 0)
  {
    vertices.reserve(points.size());
    Face_handle hint;
    for(const Kernel::Point_2& p : points) {
      vertices.push_back(triangulation.insert(p, hint));
      hint = vertices.back()->face();
    }
    has_area = triangulation.dimension() == 2;
    if(!has_area)
      return;
    measure_spacings([](std::size_t number_of_edges) { return number_of_edges / 2; });
    for(Vertex_handle v : triangulation.finite_vertex_handles()) {
      Vertex_info& info = v->info(); // beside denser points more than the mean
      info.spacing = std::exp((std::max)(info.spacing, (std::min)(info.measured, info.spacing + .25f)));
    }
    if(resolution > Distinct_places::shortest)
      take_spacings_of_places(points, resolution);
  }

  // Of each point: the median length of the edges at it, smoothed; 0 if all points are on a line. Edges cross the gaps
  // between scan lines, too. Copies have the spacing of their places.
  std::vector<float> spacings() const
  {
    std::vector<float> result;
    for(Vertex_handle v : vertices)
      result.push_back(v->info().spacing);
    return result;
  }

  // Of each point: the length of the second shortest edge at it, smoothed. So two directions count: along a scan line, it
  // is the distance of its points.
  std::vector<float> second_distances()
  {
    if(!has_area)
      return std::vector<float>(vertices.size(), 0);
    measure_spacings([](std::size_t) { return std::size_t(1); });
    std::vector<float> result = spacings();
    for(float& logarithm : result)
      logarithm = std::exp(logarithm);
    return result;
  }

  void insert(const Straight_border& border, const Plane_frame& frame)
  {
    if(!has_area)
      return;
    Vertex_handle last;
    for(const Border_vertex_position& position : border.chain) {
      const Vertex_handle v = insert(position, border, frame);
      if(last != Vertex_handle() && last != v) {
        triangulation.insert_constraint(last, v);
        border_edges.emplace_back(last, v);
      }
      last = v;
    }
    ++number_of_borders;
  }

  // The points beyond a straight border take no part.
  void cut(std::size_t point) { vertices[point]->info().is_cut = true; }

  // Simple closed lines without common points, the inside to their left. None if all points are on a line. Vertices are
  // written as they are, and only those of straight borders have positions.
  std::vector<Outline_loop> outline(const Outline_limits& limits)
  {
    if(!has_area)
      return {};
    mark_inside(limits);
    drop_crumbs(limits);
    separate_pieces();
    drop_crumbs(limits);
    const auto is_inside = [](Face_handle f) { return f->info().is_inside; };
    std::vector<Outline_loop> result;
    using Walk = Boundary_walk<Triangulation, decltype(is_inside)>;
    for(const auto& edges : Walk(triangulation, is_inside).loops()) {
      std::vector<Vertex_handle> loop;
      for(const auto& e : edges)
        loop.push_back(Walk::source(e));
      result.push_back(straight_loop(loop));
    }
    return result;
  }

private:
  struct Vertex_info {
    int border = -1;   // position in border_vertices
    float spacing = 0; // 0: not of the points
    float measured = 0;
    bool is_cut = false;
  };
  struct Face_info {
    bool is_inside = false, is_beyond = false; // beyond a straight border
    int component = -1;
  };
  struct Border_vertex {
    Position position;
    bool is_corner;
    std::vector<int> borders;
    float reach;
  };
  using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<Vertex_info, Kernel>,
                                         CGAL::Triangulation_face_base_with_info_2<
                                           Face_info, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>>,
    CGAL::Exact_predicates_tag>;
  using Vertex_handle = Triangulation::Vertex_handle;
  using Face_handle = Triangulation::Face_handle;

  static constexpr int smoothing_rounds = 8;
  static constexpr double smallest_square = 0x1p-200; // of a spacing; coordinates are up to 1
  static constexpr std::size_t fewest_places = 20;    // of a piece

  // The logarithm of the length of an edge at a vertex, so many of whose edges are shorter, smoothed.
  template <class Number_of_shorter>
  void measure_spacings(Number_of_shorter number_of_shorter)
  {
    std::vector<double> squared;
    for(Vertex_handle v : triangulation.finite_vertex_handles()) {
      squared.clear();
      for_each_neighbor(v, [&](Vertex_handle u) { squared.push_back(CGAL::squared_distance(u->point(), v->point())); });
      const auto chosen = squared.begin() + std::ptrdiff_t(number_of_shorter(squared.size()));
      std::nth_element(squared.begin(), chosen, squared.end());
      v->info().spacing = v->info().measured = float(std::log((std::max)(*chosen, smallest_square)) / 2);
    }
    for(int round = 0; round < smoothing_rounds; ++round)
      smooth_spacings();
  }

  // The geometric mean with the neighbors: a few stray points get the spacing of the many around them.
  void smooth_spacings()
  {
    std::vector<float> smooth;
    smooth.reserve(triangulation.number_of_vertices());
    for(Vertex_handle v : triangulation.finite_vertex_handles()) {
      float sum = v->info().spacing, count = 1;
      for_each_neighbor(v, [&](Vertex_handle u) {
        sum += u->info().spacing;
        ++count;
      });
      smooth.push_back(sum / count);
    }
    auto next = smooth.begin();
    for(Vertex_handle v : triangulation.finite_vertex_handles())
      v->info().spacing = *next++;
  }

  // Points closer to each other than a distance are taken as one place. On a surface or a line that the points cover, places
  // at half of the distance are half as far from each other. Where they are not, the points are copies of these places. So
  // the distance is halved, until places are no farther apart than the points.
  void take_spacings_of_places(const std::vector<Kernel::Point_2>& points, double resolution)
  {
    struct Place {
      float spacing = 0, second = 0;
      bool is_known = false;
    };
    const std::vector<float> own = spacings();
    std::vector<float> sorted = own;
    const double smallest = (std::max)(double(median(sorted)), Distinct_places::shortest);
    std::vector<Place> before(points.size());
    for(double distance = 2 * resolution; distance >= smallest; distance /= 2) {
      const Distinct_places distinct(points, distance);
      if(distinct.places.size() < fewest_places)
        continue;
      Outline_triangulation coarse(distinct.places);
      const std::vector<float> spacing = coarse.spacings(), second = coarse.second_distances();
      for(std::size_t i = 0; i < points.size(); ++i) {
        Place& place = before[i];
        if(place.is_known)
          continue;
        const std::size_t next = distinct.place_of[i];
        place.is_known = place.second > 0 && second[next] * std::sqrt(2.f) > place.second;
        if(!place.is_known)
          place = {spacing[next], second[next], false};
        else if(place.spacing > 2 * own[i])
          vertices[i]->info().spacing = place.spacing;
      }
    }
  }

  Vertex_handle insert(const Border_vertex_position& position, const Straight_border& border, const Plane_frame& frame)
  {
    const Face_handle hint = border_edges.empty() ? Face_handle() : border_edges.back().second->face();
    const Vertex_handle v = triangulation.insert(frame.flat(position.point), hint);
    Vertex_info& info = v->info();
    if(info.border < 0) {
      info.border = int(border_vertices.size());
      border_vertices.push_back(
        {{position.point.x(), position.point.y(), position.point.z()}, false, {}, border.reach});
    }
    info.is_cut = false;
    if(!(info.spacing > 0))
      info.spacing = border.spacing;
    Border_vertex& vertex = border_vertices[std::size_t(info.border)];
    vertex.reach = (std::max)(vertex.reach, border.reach);
    vertex.borders.push_back(number_of_borders);
    vertex.is_corner |= position.third >= 0;
    return v;
  }

  // Infinite for a sliver, whose area is within the rounding of its computation: it would be divided by that. Points of
  // a lattice that are on a line in space form slivers in the plane of the shape.
  static double squared_radius(Face_handle f)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Kernel::Point_2 &p = f->vertex(0)->point(), &q = f->vertex(1)->point(), &r = f->vertex(2)->point();
    const Kernel::Vector_2 a = q - p, b = r - p;
    const double s = a.x() * b.y(), t = a.y() * b.x();
    if(!(std::fabs(s - t) > 4 * std::numeric_limits<double>::epsilon() * (std::fabs(s) + std::fabs(t))))
      return infinity;
    const double squared = CGAL::squared_radius(p, q, r);
    return std::isfinite(squared) ? squared : infinity;
  }

  // Of the longest edge.
  static double squared_length(Face_handle f)
  {
    double longest = 0;
    for(int i = 0; i < 3; ++i)
      longest = (std::max)(longest, CGAL::squared_distance(f->vertex(i)->point(), f->vertex((i + 1) % 3)->point()));
    return longest;
  }

  // The mean of the corners.
  static double spacing(Face_handle f)
  {
    return (double(f->vertex(0)->info().spacing) + f->vertex(1)->info().spacing + f->vertex(2)->info().spacing) / 3;
  }

  // A point close to a straight border makes a flat face with a large circle there, so that is decided by edges.
  bool is_inside(Face_handle f, double radius) const
  {
    double largest = radius * spacing(f);
    bool is_at_border = false;
    for(int i = 0; i < 3; ++i) {
      const Vertex_info& info = f->vertex(i)->info();
      if(info.is_cut)
        return false;
      if(info.border < 0)
        continue;
      is_at_border = true;
      largest = (std::max)(largest, double(border_vertices[std::size_t(info.border)].reach));
    }
    if(f->info().is_beyond)
      return false;
    return is_at_border ? squared_length(f) <= 4 * largest * largest : squared_radius(f) <= largest * largest;
  }

  void mark_inside(const Outline_limits& limits)
  {
    for(const auto& [u, v] : border_edges) { // to their right
      Face_handle f;
      int i;
      if(triangulation.is_edge(u, v, f, i))
        f->info().is_beyond = true;
    }
    for(Face_handle f : triangulation.finite_face_handles())
      f->info().is_inside = is_inside(f, limits.radius);
  }

  // Pieces that share edges, of the inside and of the outside; returns their areas, in squares of the spacing.
  std::vector<double> find_components()
  {
    for(Face_handle f : triangulation.all_face_handles())
      f->info().component = -1;
    std::vector<double> areas;
    std::vector<Face_handle> stack;
    for(Face_handle start : triangulation.all_face_handles()) {
      if(start->info().component >= 0)
        continue;
      const int component = int(areas.size());
      double area = 0;
      start->info().component = component;
      for(stack.assign(1, start); !stack.empty();) {
        const Face_handle f = stack.back();
        stack.pop_back();
        area += triangulation.is_infinite(f) ? std::numeric_limits<double>::infinity()
                                             : triangulation.triangle(f).area() / (spacing(f) * spacing(f));
        for(int i = 0; i < 3; ++i) {
          Face_info& next = f->neighbor(i)->info();
          if(next.component >= 0 || next.is_inside != f->info().is_inside)
            continue;
          next.component = component;
          stack.push_back(f->neighbor(i));
        }
      }
      areas.push_back(area);
    }
    return areas;
  }

  // Fills small holes, then leaves out small pieces.
  void drop_crumbs(const Outline_limits& limits)
  {
    for(bool is_inside : {false, true}) {
      const std::vector<double> areas = find_components();
      for(Face_handle f : triangulation.finite_face_handles())
        if(f->info().is_inside == is_inside &&
           areas[std::size_t(f->info().component)] < (is_inside ? limits.piece : limits.hole))
          f->info().is_inside = !is_inside;
    }
  }

  // How often the inside begins around a vertex.
  int number_of_fans(Vertex_handle v) const
  {
    int count = 0;
    auto f = triangulation.incident_faces(v);
    const auto end = f;
    bool was_inside = (--f)->info().is_inside;
    f = end;
    do {
      count += f->info().is_inside && !was_inside;
      was_inside = f->info().is_inside;
    } while(++f != end);
    return count;
  }

  // Of several fans of faces of the inside around a vertex, only the largest remains.
  bool separate(Vertex_handle v)
  {
    if(number_of_fans(v) < 2)
      return false;
    auto f = triangulation.incident_faces(v);
    while(f->info().is_inside)
      ++f;
    const Face_handle begin = f; // outside
    std::vector<std::pair<double, std::vector<Face_handle>>> fans;
    bool was_inside = false;
    for(++f; Face_handle(f) != begin; ++f) {
      if(f->info().is_inside) {
        if(!was_inside)
          fans.emplace_back();
        fans.back().first += triangulation.triangle(f).area();
        fans.back().second.push_back(f);
      }
      was_inside = f->info().is_inside;
    }
    const auto largest =
      std::max_element(fans.begin(), fans.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for(auto fan = fans.begin(); fan != fans.end(); ++fan)
      if(fan != largest)
        for(Face_handle out : fan->second)
          out->info().is_inside = false;
    return true;
  }

  // Outlines do not touch themselves or others.
  void separate_pieces()
  {
    std::deque<Vertex_handle> queue;
    for(Vertex_handle v : triangulation.finite_vertex_handles())
      queue.push_back(v);
    for(; !queue.empty(); queue.pop_front()) {
      const Vertex_handle v = queue.front();
      if(separate(v))
        for_each_neighbor(v, [&](Vertex_handle u) { queue.push_back(u); });
    }
  }

  // A straight border that both are on, -1 if there is none.
  int common_border(Vertex_handle u, Vertex_handle v) const
  {
    if(u->info().border < 0 || v->info().border < 0)
      return -1;
    const auto& of_u = border_vertices[std::size_t(u->info().border)].borders;
    const auto& of_v = border_vertices[std::size_t(v->info().border)].borders;
    const auto common = std::find_first_of(of_u.begin(), of_u.end(), of_v.begin(), of_v.end());
    return common == of_u.end() ? -1 : *common;
  }

  // Of a straight border, only the ends remain.
  Outline_loop straight_loop(const std::vector<Vertex_handle>& loop) const
  {
    Outline_loop result;
    const std::size_t n = loop.size();
    for(std::size_t i = 0; i < n; ++i) {
      const Vertex_handle v = loop[i];
      const int before = common_border(loop[(i + n - 1) % n], v), after = common_border(v, loop[(i + 1) % n]);
      if(before >= 0 && before == after)
        continue;
      const bool is_fixed = before >= 0 || after >= 0;
      result.push_back({v->point(), v->info().spacing, is_fixed, {}, v->point()});
      result.back().border = after;
      if(is_fixed) {
        const Border_vertex& vertex = border_vertices[std::size_t(v->info().border)];
        result.back().position = vertex.position;
        result.back().is_corner = vertex.is_corner;
      }
    }
    return result;
  }

  // f(a vertex that shares an edge with v)
  template <class Function>
  void for_each_neighbor(Vertex_handle v, Function f) const
  {
    auto u = triangulation.incident_vertices(v);
    const auto end = u;
    do
      if(!triangulation.is_infinite(u))
        f(Vertex_handle(u));
    while(++u != end);
  }

  Triangulation triangulation;
  std::vector<Vertex_handle> vertices;
  std::vector<Border_vertex> border_vertices;
  std::vector<std::pair<Vertex_handle, Vertex_handle>> border_edges; // the shape is to their left
  int number_of_borders = 0;
  bool has_area; // the points are not on a line
};

} // namespace CGAL::Tandem::internal::outlines

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_H
