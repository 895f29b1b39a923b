// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_IMPL_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_IMPL_H

#include <CGAL/Shape_regularization_tandem/models/outlines/Distinct_places.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/face_shapes.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace CGAL {
namespace Tandem {
namespace internal {
namespace outlines {

inline Outline_triangulation::Outline_triangulation(const std::vector<Kernel::Point_2>& points, double resolution)
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
  for(int round = 0; round < smoothing_rounds; ++round)
    smooth_spacings();
  for(Vertex_handle v : triangulation.finite_vertex_handles()) {
    Vertex_info& info = v->info(); // beside denser points more than the mean
    info.spacing = std::exp((std::max)(info.spacing, (std::min)(info.measured, info.spacing + .25f)));
  }
  if(resolution > Distinct_places::shortest)
    take_spacings_of_places(points, resolution);
}

// The logarithm of the length of an edge at a vertex, so many of whose edges are shorter.
template <class Number_of_shorter>
void Outline_triangulation::measure_spacings(Number_of_shorter number_of_shorter)
{
  std::vector<double> squared;
  for(Vertex_handle v : triangulation.finite_vertex_handles()) {
    squared.clear();
    for_each_neighbor(v, [&](Vertex_handle u) { squared.push_back(CGAL::squared_distance(u->point(), v->point())); });
    const auto chosen = squared.begin() + std::ptrdiff_t(number_of_shorter(squared.size()));
    std::nth_element(squared.begin(), chosen, squared.end());
    v->info().spacing = v->info().measured = float(std::log((std::max)(*chosen, smallest_square)) / 2);
  }
}

// The geometric mean with the neighbors: a few stray points get the spacing of the many around them.
inline void Outline_triangulation::smooth_spacings()
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

inline std::vector<float> Outline_triangulation::second_distances()
{
  if(!has_area)
    return std::vector<float>(vertices.size(), 0);
  measure_spacings([](std::size_t) { return std::size_t(1); });
  for(int round = 0; round < smoothing_rounds; ++round)
    smooth_spacings();
  std::vector<float> result = spacings();
  for(float& logarithm : result)
    logarithm = std::exp(logarithm);
  return result;
}

// Points closer to each other than a distance are taken as one place. On a surface or a line that the points cover, places
// at half of the distance are half as far from each other. Where they are not, the points are copies of these places. So
// the distance is halved, until places are no farther apart than the points.
inline void Outline_triangulation::take_spacings_of_places(const std::vector<Kernel::Point_2>& points,
                                                           double resolution)
{
  struct Place {
    float spacing = 0, second = 0;
    bool is_known = false;
  };
  const std::vector<float> own = spacings();
  std::vector<float> sorted = own;
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
  const double smallest = (std::max)(double(sorted[sorted.size() / 2]), Distinct_places::shortest);
  std::vector<Place> before(points.size());
  for(double distance = 2 * resolution; distance >= smallest; distance /= 2) {
    const Distinct_places places(points, distance);
    if(places.places().size() < fewest_places)
      continue;
    Outline_triangulation coarse(places.places());
    const std::vector<float> spacing = coarse.spacings(), second = coarse.second_distances();
    for(std::size_t i = 0; i < points.size(); ++i) {
      Place& place = before[i];
      if(place.is_known)
        continue;
      const std::size_t next = places.place_of(i);
      place.is_known = place.second > 0 && second[next] * std::sqrt(2.f) > place.second;
      if(!place.is_known)
        place = {spacing[next], second[next], false};
      else if(place.spacing > 2 * own[i])
        vertices[i]->info().spacing = place.spacing;
    }
  }
}

// --- Straight borders

inline Outline_triangulation::Vertex_handle Outline_triangulation::insert(const Border_vertex_position& position,
                                                                          const Straight_border& border,
                                                                          const Plane_frame& frame)
{
  const Face_handle hint = border_edges.empty() ? Face_handle() : border_edges.back().second->face();
  const Vertex_handle v = triangulation.insert(frame.flat(position.point), hint);
  Vertex_info& info = v->info();
  if(info.border < 0) {
    info.border = int(border_vertices.size());
    border_vertices.push_back({{position.point.x(), position.point.y(), position.point.z()}, false, {}, border.reach});
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

inline void Outline_triangulation::insert(const Straight_border& border, const Plane_frame& frame)
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

// --- Inside

// A point close to a straight border makes a flat face with a large circle there, so that is decided by edges.
inline bool Outline_triangulation::is_inside(Face_handle f, double radius) const
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

// The faces to the right of straight borders.
inline void Outline_triangulation::mark_beyond()
{
  for(const auto& [u, v] : border_edges) {
    Face_handle f;
    int i;
    if(triangulation.is_edge(u, v, f, i))
      f->info().is_beyond = true;
  }
}

inline void Outline_triangulation::mark_inside(const Outline_limits& limits)
{
  mark_beyond();
  for(Face_handle f : triangulation.finite_face_handles())
    f->info().is_inside = is_inside(f, limits.radius);
}

// Pieces that share edges, of the inside and of the outside; returns their areas, in squares of the spacing.
inline std::vector<double> Outline_triangulation::find_components()
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
inline void Outline_triangulation::drop_crumbs(const Outline_limits& limits)
{
  for(bool is_inside : {false, true}) {
    const std::vector<double> areas = find_components();
    for(Face_handle f : triangulation.finite_face_handles())
      if(f->info().is_inside == is_inside &&
         areas[std::size_t(f->info().component)] < (is_inside ? limits.piece : limits.hole))
        f->info().is_inside = !is_inside;
  }
}

// Of several fans of faces of the inside around a vertex, only the largest remains.
inline bool Outline_triangulation::separate(Vertex_handle v)
{
  if(number_of_fans(triangulation, v) < 2)
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
inline void Outline_triangulation::separate_pieces()
{
  std::deque<Vertex_handle> queue;
  for(Vertex_handle v : triangulation.finite_vertex_handles())
    queue.push_back(v);
  for(; !queue.empty(); queue.pop_front()) {
    const Vertex_handle v = queue.front();
    if(!separate(v))
      continue;
    auto u = triangulation.incident_vertices(v);
    const auto end = u;
    do {
      if(!triangulation.is_infinite(u))
        queue.push_back(u);
    } while(++u != end);
  }
}

} // namespace outlines
} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_OUTLINES_OUTLINE_TRIANGULATION_IMPL_H
