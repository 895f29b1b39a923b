// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures of the outlines of shapes: their edges, the distances of border points from them, and the areas that they miss
// or have too much where the truth is known.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_OUTLINE_FIGURES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_OUTLINE_FIGURES_H

#include "clouds/outline_cloud.h"

#include <CGAL/Shape_regularization_tandem/models/outlines/Outline_triangulation.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace benchmark {

using Outline_areas = Shape_polygons_3<Outline_kernel>;

struct Outline_figures {
  std::size_t shapes = 0, polygons = 0, holes = 0, edges = 0, regular_edges = 0;
  double length = 0, regular_length = 0;       // of edges
  std::size_t corners = 0, shared_corners = 0; // those that several shapes have, to the last bit
  std::size_t crossing_loops = 0;              // that are not simple
  std::size_t border_points = 0;
  double sum_of_distances = 0; // of border points, in spacings
};

inline void count_corners(const Outline_areas& areas, Outline_figures& f)
{
  std::map<Outline_kernel::Point_3, std::set<std::size_t>> shapes_at;
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const Indexed_polygon& polygon : areas.polygons(s)) {
      for(std::uint32_t i : polygon.outer)
        shapes_at[areas.points()[i]].insert(s);
      for(const Indexed_polygon::Loop& hole : polygon.holes)
        for(std::uint32_t i : hole)
          shapes_at[areas.points()[i]].insert(s);
    }
  f.corners = shapes_at.size();
  for(const auto& [p, shapes] : shapes_at)
    f.shared_corners += shapes.size() > 1;
}

inline void count_crossing_loops(const Outline_areas& areas, Outline_figures& f)
{
  for(std::size_t s = 0; s < areas.number_of_entries(); ++s)
    for(const auto& polygon : areas.polygons_2(s)) {
      f.crossing_loops += !polygon.outer_boundary().is_simple();
      for(const auto& hole : polygon.holes())
        f.crossing_loops += !hole.is_simple();
    }
}

// All edges of an entry, as segments.
inline std::vector<Outline_kernel::Segment_3> edges_of(const Outline_areas& areas, std::size_t s)
{
  std::vector<Outline_kernel::Segment_3> result;
  const auto add = [&](const Indexed_polygon::Loop& loop) {
    for(std::size_t i = 0; i < loop.size(); ++i)
      result.emplace_back(areas.points()[loop[i]], areas.points()[loop[(i + 1) % loop.size()]]);
  };
  for(const Indexed_polygon& polygon : areas.polygons(s)) {
    add(polygon.outer);
    for(const Indexed_polygon::Loop& hole : polygon.holes)
      add(hole);
  }
  return result;
}

// Whether the edge has the direction of the line with another parallel group, or the one orthogonal to it, up to 1e-9.
inline bool is_regular(const Outline_shapes& shapes, std::size_t s, const Outline_kernel::Segment_3& edge)
{
  const auto normal_of = [&](std::size_t t) {
    const auto& c = shapes.coefficients(t);
    return Outline_kernel::Vector_3(c[0], c[1], c[2]);
  };
  const Outline_kernel::Vector_3 d = edge.to_vector() / std::sqrt(edge.squared_length());
  for(std::size_t t = 0; t < shapes.number_of_shapes(); ++t) {
    const Outline_kernel::Vector_3 cross = CGAL::cross_product(normal_of(s), normal_of(t));
    const double sine = std::sqrt(cross.squared_length());
    if(sine > 1e-3 &&
       ((std::min)(std::fabs(d * cross), std::sqrt(CGAL::cross_product(d, cross).squared_length())) < 1e-9 * sine))
      return true;
  }
  return false;
}

// The points of the outline without straight borders, and without straightening; each with the spacing there.
inline std::vector<std::pair<Outline_kernel::Point_3, double>>
border_points_of(const Outline_cloud& cloud, const Outline_shapes& shapes, std::size_t s)
{
  namespace outlines = internal::outlines;
  const outlines::Plane_frame frame(shapes, s, cloud[shapes.points(s)[0]].first);
  std::vector<outlines::Kernel::Point_2> flat;
  for(std::size_t i : shapes.points(s))
    flat.push_back(frame.flat(cloud[i].first));
  std::vector<std::pair<Outline_kernel::Point_3, double>> result;
  for(const outlines::Outline_loop& loop : outlines::Outline_triangulation(flat).outline(outlines::Outline_limits()))
    for(const outlines::Outline_vertex& v : loop)
      result.emplace_back(frame.lifted(v.point), v.spacing);
  return result;
}

inline Outline_figures figures_of(const Outline_cloud& cloud, const Outline_shapes& shapes, const Outline_areas& areas)
{
  Outline_figures f;
  count_corners(areas, f);
  count_crossing_loops(areas, f);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto edges = edges_of(areas, s);
    f.shapes += !edges.empty();
    f.polygons += areas.polygons(s).size();
    for(const Indexed_polygon& polygon : areas.polygons(s))
      f.holes += polygon.holes.size();
    for(const auto& edge : edges) {
      const double length = std::sqrt(edge.squared_length());
      const bool is_one = is_regular(shapes, s, edge);
      ++f.edges;
      f.regular_edges += is_one;
      f.length += length;
      f.regular_length += is_one ? length : 0;
    }
    for(const auto& [p, spacing] : border_points_of(cloud, shapes, s)) {
      double nearest = HUGE_VAL;
      for(const auto& edge : edges)
        nearest = (std::min)(nearest, CGAL::squared_distance(p, edge));
      if(edges.empty())
        continue;
      ++f.border_points;
      f.sum_of_distances += std::sqrt(nearest) / spacing;
    }
  }
  return f;
}

inline void print(const std::string& name, const Outline_figures& f, double seconds)
{
  std::cout << name << ": shapes " << f.shapes << " polygons " << f.polygons << " holes " << f.holes
            << " edges a shape " << double(f.edges) / double(f.shapes) << " regular edges "
            << double(f.regular_edges) / double(f.edges) << " regular length " << f.regular_length / f.length
            << " mean distance of border points " << f.sum_of_distances / double(f.border_points)
            << " spacings, corners " << f.corners << " shared " << f.shared_corners << " loops that cross themselves "
            << f.crossing_loops << " seconds " << seconds << "\n";
}

struct Area_errors {
  double truth = 0, missing = 0, surplus = 0;
};

// The face that most points of the shape are of, -1 if none.
inline int face_of(const scenes::Scene& scene, const Outline_shapes& shapes, std::size_t s)
{
  std::map<int, std::size_t> count;
  for(std::size_t i : shapes.points(s))
    ++count[scene.label[i]];
  return std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
    ->first;
}

inline bool is_in_face(const scenes::Model& model, const scenes::Face& face, const scenes::Vec& p)
{
  const auto is_in = [&](const std::array<scenes::Vec, 3>& t) {
    for(std::size_t i = 0; i < 3; ++i)
      if(dot(face.normal, cross(t[(i + 1) % 3] - t[i], p - t[i])) < 0)
        return false;
    return true;
  };
  return std::any_of(face.triangles.begin(), face.triangles.end(), is_in) && !model.is_hidden(p, 1e-9);
}

// Squares of two centimeters, of each face that has a shape: of its true area and of the polygons of its shapes.
inline Area_errors errors_of(const scenes::Model& model, const scenes::Scene& scene, const Outline_shapes& shapes,
                             const Outline_areas& areas)
{
  constexpr double side = .02;
  std::map<int, std::vector<std::size_t>> shapes_of;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    shapes_of[face_of(scene, shapes, s)].push_back(s);
  Area_errors errors;
  for(const auto& [label, members] : shapes_of) {
    if(label < 0)
      continue;
    const scenes::Face& face = model.faces[std::size_t(label)];
    const auto& first = face.triangles[0];
    const scenes::Vec u = scenes::unit(first[1] - first[0]), v = cross(face.normal, u), origin = first[0];
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for(const auto& t : face.triangles)
      for(const scenes::Vec& p : t)
        for(int k = 0; k < 2; ++k) {
          low[k] = (std::min)(low[k], dot(k == 0 ? u : v, p - origin) - .5);
          high[k] = (std::max)(high[k], dot(k == 0 ? u : v, p - origin) + .5);
        }
    std::vector<std::pair<Outline_areas::Frame, std::vector<Outline_areas::Polygon_with_holes_2>>> all;
    for(std::size_t s : members)
      all.emplace_back(areas.frame(s), areas.polygons_2(s));
    for(double x = low[0]; x < high[0]; x += side)
      for(double y = low[1]; y < high[1]; y += side) {
        const scenes::Vec p = add_scaled(add_scaled(origin, x, u), y, v);
        const bool is_true = is_in_face(model, face, p);
        const bool is_covered = std::any_of(all.begin(), all.end(), [&](const auto& entry) {
          const auto q = entry.first.to_2d(Outline_kernel::Point_3(p.x, p.y, p.z));
          return std::any_of(entry.second.begin(), entry.second.end(), [&](const auto& polygon) {
            return polygon.outer_boundary().has_on_bounded_side(q) &&
                   std::none_of(polygon.holes_begin(), polygon.holes_end(),
                                [&](const auto& hole) { return !hole.has_on_unbounded_side(q); });
          });
        });
        errors.truth += is_true ? side * side : 0;
        errors.missing += is_true && !is_covered ? side * side : 0;
        errors.surplus += !is_true && is_covered ? side * side : 0;
      }
  }
  return errors;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_OUTLINE_FIGURES_H
