// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the place of the sensor tells of shapes: which are veils, and through which other ones they were seen.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SIGHT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SIGHT_H

#include <CGAL/Shape_regularization_tandem/models/facts/Shape_cells.h>
#include <CGAL/Shape_regularization_tandem/models/facts/Surface_fit.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Shape_regularization_tandem/models/models.h>
#include <CGAL/Shape_regularization_tandem/models/outlines/Plane_frame.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::facts {

// From the sensor to a point.
struct Ray {
  Vector from, to;

  friend bool operator<(const Ray& r, const Ray& s)
  {
    const auto key = [](const Ray& t) { return std::tie(t.from.x, t.from.y, t.from.z, t.to.x, t.to.y, t.to.z); };
    return key(r) < key(s);
  }
};

// The median angle, in radians, between neighboring directions on a great circle or near it, of which
// these are axes.
inline double angular_step(const std::vector<Vector>& directions, const Vector& first, const Vector& second)
{
  constexpr std::size_t asked = 256; // tell the median as well as all do
  std::vector<std::pair<double, Vector>> along;
  for(const Vector& d : directions)
    along.emplace_back(std::atan2(dot(d, second), dot(d, first)), d);
  std::sort(along.begin(), along.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> steps;
  const std::size_t n = along.size();
  for(std::size_t i = 0; i < n; i += 1 + n / asked) {
    double nearest = HUGE_VAL;
    const auto is_nearer = [&](std::size_t j) {
      nearest = (std::min)(nearest, length(along[j].second - along[i].second));
      return std::fabs(along[j].first - along[i].first) < nearest;
    };
    for(std::size_t j = i + 1; j < n && is_nearer(j);)
      ++j;
    for(std::size_t j = i; j > 0 && is_nearer(j - 1);)
      --j;
    steps.push_back(nearest);
  }
  return outlines::median(steps);
}

// A shape as rays cross it: at the cells of its plane that have points. Rays past its border may cross a cell there, but
// not more than in two rows.
class Crossed_shape {
public:
  explicit Crossed_shape(const Shape_patch& patch)
    : reach(patch.length), frame(patch.centroid, patch.normal, spacings * (patch.spacing > 0 ? patch.spacing : 1)),
      centroid(patch.centroid), normal(patch.normal)
  {
    for(const Vector& p : patch.points)
      cells.push_back(cell_of(p));
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }

  // Where a ray crosses it, as a part of the ray: from 0 to 1, or 1 where it does not. `distance`: of the point behind,
  // from the plane.
  double crossing(const Ray& ray, double distance) const
  {
    const double before = dot(normal, ray.from - centroid), behind = dot(normal, ray.to - centroid);
    if(!(before * behind < 0 && std::fabs(behind) > distance))
      return 1;
    const double part = before / (before - behind);
    const Vector place = add_scaled(ray.from, part, ray.to - ray.from);
    const bool is_near = length(place - centroid) <= reach;
    return is_near && std::binary_search(cells.begin(), cells.end(), cell_of(place)) ? part : 1;
  }

private:
  using Cell = std::array<std::int64_t, 2>;

  static constexpr double spacings = 2; // between points, of a cell: few inside of a surface are empty

  Cell cell_of(const Vector& p) const
  {
    const Vector v = frame(p);
    return {std::int64_t(std::floor(v.x)), std::int64_t(std::floor(v.y))};
  }

  double reach;
  Height_frame frame;
  Vector centroid, normal;
  std::vector<Cell> cells;
};

// The shapes as the stations see them.
class Sight {
public:
  Sight(const std::vector<Position>& points, const outlines::Shapes& shapes, const outlines::Unit& unit,
        const Stations& stations)
    : points(points), shapes(shapes), unit(unit), stations(stations),
      tolerance(unit.in(shapes.parameters().maximum_distance))
  {}

  // Of each shape. Coplanar shapes are pieces of one surface, as of a wall that the rays graze.
  std::vector<char> veils() const
  {
    std::vector<std::vector<std::size_t>> groups(shapes.number_of_shapes()); // some may be empty
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      groups[shapes.coplanar_group(s)].push_back(s);
    std::vector<char> result(shapes.number_of_shapes());
    for_each_in_parallel(groups.size(), [&](std::size_t g) {
      const char is_one = are_veils(groups[g]) ? 1 : 0;
      for(std::size_t s : groups[g])
        result[s] = is_one;
    });
    return result;
  }

  // The shape that most rays to a shape cross first, or -1, unless more than half of the rays cross some shape.
  int behind(std::size_t s, const std::vector<Crossed_shape>& crossed) const
  {
    constexpr std::size_t asked = 64;       // rays tell what most of all do
    const double clearance = 4 * tolerance; // twice that of both shapes: layers of noise are closer
    const std::vector<Ray> rays = rays_to({s});
    const std::size_t step = 1 + rays.size() / asked;
    std::vector<std::size_t> crossing(crossed.size() + 1, 0); // the last one is of those that cross none
    std::size_t number = 0;
    for(std::size_t i = 0; i < rays.size(); i += step, ++number) {
      double nearest = 1;
      std::size_t first = crossed.size();
      for(std::size_t t = 0; t < crossed.size(); ++t)
        if(const double part = crossed[t].crossing(rays[i], clearance); part < nearest) {
          nearest = part;
          first = t;
        }
      ++crossing[first];
    }
    return 2 * crossing.back() < number ? int(std::max_element(crossing.begin(), crossing.end() - 1) - crossing.begin())
                                        : -1;
  }

private:
  // From places that are known, sorted.
  std::vector<Ray> rays_to(const std::vector<std::size_t>& group) const
  {
    const auto vector_of = [&](const Position& p) { return Vector{unit.in(p[0]), unit.in(p[1]), unit.in(p[2])}; };
    std::vector<Ray> rays;
    for(std::size_t s : group)
      for(std::uint32_t i : shapes.points(s))
        if(const Position& place = stations.places[stations.of_point[i]]; std::isfinite(place[0]))
          rays.push_back({vector_of(place), vector_of(points[i])});
    std::sort(rays.begin(), rays.end());
    return rays;
  }

  // Whether more than half of the points are in veils of their stations.
  bool are_veils(const std::vector<std::size_t>& group) const
  {
    const std::vector<Ray> rays = rays_to(group);
    std::size_t number = 0, in_veils = 0;
    for(std::size_t s : group)
      number += shapes.size(s);
    for(auto first = rays.begin(); first != rays.end();) {
      const auto last = std::find_if(first, rays.end(), [&](const Ray& r) { return !(r.from == first->from); });
      in_veils += is_veil({first, last}) ? std::size_t(last - first) : 0;
      first = last;
    }
    return 2 * in_veils > number;
  }

  // Whether these points, all seen from one place, lie edge-on to it, deep, and in less than three rows of rays: then
  // mixed pixels between a near and a far surface are like that. In k rows, the variance of the angle to the middle one is
  // (k^2 - 1) / 12 steps squared.
  bool is_veil(const std::vector<Ray>& rays) const
  {
    constexpr double rows = 3;
    const double n = double(rays.size());
    std::vector<Vector> ends, directions;
    Symmetric_matrix squares = {0, 0, 0, 0, 0, 0};
    for(const Ray& ray : rays) {
      ends.push_back(ray.to);
      directions.push_back(internal::unit(ray.to - ray.from));
      squares = add_square(squares, 1 / n, directions.back());
    }
    const Eigen_system surface = eigen_system(scatter_of(ends).matrix), sight = eigen_system(squares);
    const double depth2 = 12 * surface.value[1] / n;
    if(!(depth2 > 4 * tolerance * tolerance) ||
       length(cross(surface.vector[0], sight.vector[0])) > outlines::smallest_sine)
      return false;
    const double step = angular_step(directions, sight.vector[2], sight.vector[1]);
    return 12 * sight.value[0] < (rows * rows - 1) * step * step;
  }

  const std::vector<Position>& points;
  const outlines::Shapes& shapes;
  const outlines::Unit& unit;
  const Stations& stations;
  double tolerance;
};

} // namespace CGAL::Tandem::internal::facts

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SIGHT_H
