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
  std::uint32_t station;

  friend bool operator<(const Ray& r, const Ray& s)
  {
    const auto key = [](const Ray& t) { return std::tie(t.from.x, t.from.y, t.from.z, t.to.x, t.to.y, t.to.z); };
    return key(r) < key(s);
  }
};

// The median angle, in radians, between each direction and the nearest other one, but for copies. 0 if there are only
// copies.
inline double angular_step(std::vector<Vector> directions)
{
  constexpr std::size_t asked = 256; // tell the median as well as all do
  Vector low = {1, 1, 1}, high = {-1, -1, -1};
  for(const Vector& d : directions) {
    low = {(std::min)(low.x, d.x), (std::min)(low.y, d.y), (std::min)(low.z, d.z)};
    high = {(std::max)(high.x, d.x), (std::max)(high.y, d.y), (std::max)(high.z, d.z)};
  }
  const Vector extent = high - low;
  const auto along = [&](const Vector& d) {
    return extent.x >= extent.y && extent.x >= extent.z ? d.x : extent.y >= extent.z ? d.y : d.z;
  };
  const auto key = [&](const Vector& d) { return std::make_tuple(along(d), d.x, d.y, d.z); };
  std::sort(directions.begin(), directions.end(), [&](const Vector& a, const Vector& b) { return key(a) < key(b); });
  std::vector<double> steps;
  const std::size_t n = directions.size();
  for(std::size_t i = 0; i < n; i += 1 + n / asked) {
    double nearest = HUGE_VAL;
    const auto is_nearer = [&](std::size_t j) {
      const double angle = length(directions[j] - directions[i]);
      nearest = angle > 0 ? (std::min)(nearest, angle) : nearest;
      return std::fabs(along(directions[j]) - along(directions[i])) < nearest;
    };
    for(std::size_t j = i + 1; j < n && is_nearer(j);)
      ++j;
    for(std::size_t j = i; j > 0 && is_nearer(j - 1);)
      --j;
    if(nearest < HUGE_VAL)
      steps.push_back(nearest);
  }
  return steps.empty() ? 0 : outlines::median(steps);
}

// A shape as rays cross it: at the cells of its plane that have points. Rays past its border may cross a cell there, but
// not more than in two rows.
class Crossed_shape {
public:
  explicit Crossed_shape(const Shape_patch& patch)
    : frame(patch.centroid, patch.normal, spacings * (patch.spacing > 0 ? patch.spacing : 1)), centroid(patch.centroid),
      normal(patch.normal)
  {
    for(const Vector& p : patch.points) {
      reach = (std::max)(reach, length(p - centroid));
      cells.push_back(cell_of(p));
    }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  }

  // Whether rays from a place to points within a radius about the center may cross it.
  bool may_cross(const Vector& from, const Vector& center, double radius) const
  {
    const Vector ray = center - from;
    const double before = dot(normal, from - centroid), behind = dot(normal, center - centroid);
    const double part = dot(centroid - from, ray) / (std::max)(dot(ray, ray), 1e-300);
    const Vector nearest = add_scaled(from, (std::min)((std::max)(part, 0.), 1.), ray);
    return (before < 0 ? behind + radius : radius - behind) > 0 && length(nearest - centroid) <= reach + radius;
  }

  // Where a ray crosses it, as a part of the ray: from 0 to 1, or 1 where it does not. `distance`: at least, of both ends
  // from the plane.
  double crossing(const Ray& ray, double distance) const
  {
    const double before = dot(normal, ray.from - centroid), behind = dot(normal, ray.to - centroid);
    if(!(before * behind < 0 && std::fabs(behind) > distance && std::fabs(before) > distance))
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

  double reach = 0; // of the points, from their centroid
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
  {
    std::vector<std::vector<Vector>> directions(stations.places.size());
    for(std::size_t i = 0; i < points.size(); ++i) {
      const Ray ray = ray_to(std::uint32_t(i));
      if(is_known(ray) && std::isfinite(ray.to.x + ray.to.y + ray.to.z))
        directions[stations.of_point[i]].push_back(internal::unit(ray.to - ray.from));
    }
    for(std::vector<Vector>& of_station : directions)
      steps.push_back(angular_step(std::move(of_station)));
  }

  // Of each shape. Coplanar shapes are pieces of one surface, as of a wall that the rays graze. Where most points would be
  // in veils, the places are not those of sensors, and there are none.
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
    std::size_t number = 0, in_veils = 0;
    for(std::size_t s = 0; s < result.size(); ++s) {
      number += shapes.size(s);
      in_veils += result[s] != 0 ? shapes.size(s) : 0;
    }
    return 2 * in_veils < number ? result : std::vector<char>(result.size());
  }

  // The shape that most rays to a shape cross first, or -1, unless more than half of the rays cross some shape.
  int behind(std::size_t s, const std::vector<Crossed_shape>& crossed) const
  {
    constexpr std::size_t asked = 64;       // rays tell what most of all do
    const double clearance = 4 * tolerance; // twice that of both shapes: layers of noise are closer
    const std::vector<Ray> rays = rays_to({s});
    const std::size_t step = 1 + rays.size() / asked;
    const std::vector<std::size_t> met = crossed_by(rays, crossed);
    std::vector<std::size_t> crossing(crossed.size() + 1, 0); // the last one is of those that cross none
    std::size_t number = 0;
    for(std::size_t i = 0; i < rays.size(); i += step, ++number) {
      double nearest = 1;
      std::size_t first = crossed.size();
      for(std::size_t t : met)
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
  Ray ray_to(std::uint32_t i) const
  {
    const auto vector_of = [&](const Position& p) { return Vector{unit.in(p[0]), unit.in(p[1]), unit.in(p[2])}; };
    const std::uint32_t station = stations.of_point[i];
    return {vector_of(stations.places[station]), vector_of(points[i]), station};
  }

  static bool is_known(const Ray& ray) { return std::isfinite(ray.from.x); }

  // From places that are known, sorted.
  std::vector<Ray> rays_to(const std::vector<std::size_t>& group) const
  {
    std::vector<Ray> rays;
    for(std::size_t s : group)
      for(std::uint32_t i : shapes.points(s))
        if(const Ray ray = ray_to(i); is_known(ray))
          rays.push_back(ray);
    std::sort(rays.begin(), rays.end());
    return rays;
  }

  // Shapes that some of the rays may cross.
  static std::vector<std::size_t> crossed_by(const std::vector<Ray>& rays, const std::vector<Crossed_shape>& crossed)
  {
    Vector center = {0, 0, 0};
    for(const Ray& ray : rays)
      center = add_scaled(center, 1 / double(rays.size()), ray.to);
    double radius = 0;
    std::vector<Vector> places;
    for(const Ray& ray : rays) {
      radius = (std::max)(radius, length(ray.to - center));
      if(places.empty() || !(places.back() == ray.from))
        places.push_back(ray.from);
    }
    std::vector<std::size_t> result;
    for(std::size_t t = 0; t < crossed.size(); ++t)
      if(std::any_of(places.begin(), places.end(),
                     [&](const Vector& place) { return crossed[t].may_cross(place, center, radius); }))
        result.push_back(t);
    return result;
  }

  // Whether more than half of the points whose place is known are in veils of their stations.
  bool are_veils(const std::vector<std::size_t>& group) const
  {
    const std::vector<Ray> rays = rays_to(group);
    std::size_t in_veils = 0;
    for(auto first = rays.begin(); first != rays.end();) {
      const auto last = std::find_if(first, rays.end(), [&](const Ray& r) { return !(r.from == first->from); });
      in_veils += is_veil({first, last}) ? std::size_t(last - first) : 0;
      first = last;
    }
    return 2 * in_veils > rays.size();
  }

  // Whether these points, all seen from one place, lie edge-on to it, deep, and in fewer than three rows of rays, as mixed
  // pixels between a near and a far surface do. In k rows, the variance of the angle to the middle one is (k^2 - 1) / 12
  // steps squared. Nor may there be more points than that many rows have: a sensor has one point in each direction, so
  // others were seen from elsewhere, or are what is left of a denser scan.
  bool is_veil(const std::vector<Ray>& rays) const
  {
    constexpr double rows = 3;
    const double step = steps[rays[0].station];
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
    return 12 * sight.value[0] < (rows * rows - 1) * step * step && n * step < rows * std::sqrt(12 * sight.value[1]);
  }

  const std::vector<Position>& points;
  const outlines::Shapes& shapes;
  const outlines::Unit& unit;
  const Stations& stations;
  double tolerance;
  std::vector<double> steps; // of the stations, between their rays
};

} // namespace CGAL::Tandem::internal::facts

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_SIGHT_H
