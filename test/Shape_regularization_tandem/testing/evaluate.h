// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's criteria, and comparison with a known truth, of the labels and
// planes that any detector wrote. Nothing of the package takes part.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_H

#include "plane_relations.h"

#include <stdexcept>
#include <string>

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Detection {
  std::vector<std::int32_t> label; // per point: its shape, -1 for none
  std::vector<Plane> planes;       // per shape
};

struct Tolerances {
  double maximum_distance;  // epsilon
  double maximum_angle_deg; // alpha
};

struct Relation_counts {
  std::size_t directions = 0, planes = 0, degrees_of_freedom = 0;
  double complexity = 0;
};

struct Criteria {
  std::size_t points = 0, assigned = 0, shapes = 0, smallest_shape = 0;
  std::size_t beyond_epsilon = 0, beyond_alpha = 0, beyond_either = 0; // points
  std::size_t not_unit = 0;                                            // planes whose normal is not a unit vector
  double mean_distance = 0, max_distance = 0;
  double mean_distance_in_epsilons = 0, max_distance_in_epsilons = 0;
  double mean_normal_angle_deg = 0;
  Relation_counts exact, relaxed;

  double coverage() const { return points == 0 ? 0 : double(assigned) / double(points); }
};

struct Extent {
  double diagonal;
  Vec center;
};

inline Extent extent_of(const std::vector<Vec>& points)
{
  if(points.empty())
    return {0, {0, 0, 0}};
  Vec low = points[0], high = points[0];
  for(const Vec& p : points) {
    low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y), (std::min)(low.z, p.z)};
    high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y), (std::max)(high.z, p.z)};
  }
  return {length(high - low), 0.5 * (low + high)};
}

// In long double: the coordinates may be georeferenced.
inline double distance(const Plane& plane, const Vec& p)
{
  using Real = long double;
  const Vec& n = plane.normal;
  return double(std::abs(Real(n.x) * p.x + Real(n.y) * p.y + Real(n.z) * p.z + Real(plane.offset)));
}

// What a double evaluation of that distance may be wrong by.
inline double rounding(const Plane& plane, const Vec& p)
{
  return 0x1p-51 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) + std::abs(plane.offset));
}

inline double cosine(const Plane& plane, const Vec& normal)
{
  double l = length(normal);
  return l > 0 ? std::abs(dot(plane.normal, normal)) / (l * length(plane.normal)) : 0;
}

// How a point lies to a plane. NaN is beyond every tolerance.
class Fidelity {
public:
  explicit Fidelity(const Tolerances& tolerances)
    : epsilon_(tolerances.maximum_distance),
      minimum_cosine_(std::cos(tolerances.maximum_angle_deg * 0.017453292519943295) - 1e-12)
  {}

  bool is_beyond_epsilon(const Plane& plane, const Vec& p) const
  {
    return !(distance(plane, p) <= epsilon_ + rounding(plane, p));
  }

  bool is_beyond_alpha(const Plane& plane, const Vec& normal) const
  {
    return !(cosine(plane, normal) >= minimum_cosine_);
  }

  // The i-th point, and its normal, where there are normals.
  bool fits(const Plane& plane, const std::vector<Vec>& points, const std::vector<Vec>& normals, std::size_t i) const
  {
    return !is_beyond_epsilon(plane, points[i]) && (normals.empty() || !is_beyond_alpha(plane, normals[i]));
  }

private:
  double epsilon_, minimum_cosine_;
};

inline std::vector<std::size_t> shape_sizes(const Detection& detection)
{
  std::vector<std::size_t> size(detection.planes.size(), 0);
  for(std::size_t i = 0; i < detection.label.size(); ++i) {
    std::int32_t s = detection.label[i];
    if(s < -1 || s >= std::int32_t(size.size()))
      throw std::runtime_error("point " + std::to_string(i) + " has the label " + std::to_string(s) +
                               ", but there are " + std::to_string(size.size()) + " planes");
    if(s >= 0)
      ++size[std::size_t(s)];
  }
  return size;
}

inline void check_points(const std::vector<Vec>& points, const std::vector<Vec>& normals, const Detection& detection,
                         const Tolerances& tolerances, Criteria& criteria)
{
  Fidelity fidelity(tolerances);
  double sum_of_angles = 0;
  for(std::size_t i = 0; i < points.size(); ++i) {
    if(detection.label[i] < 0)
      continue;
    const Plane& plane = detection.planes[std::size_t(detection.label[i])];
    double d = distance(plane, points[i]);
    ++criteria.assigned;
    criteria.mean_distance += d;
    criteria.max_distance = (std::max)(criteria.max_distance, d);
    bool is_beyond_epsilon = fidelity.is_beyond_epsilon(plane, points[i]);
    bool is_beyond_alpha = !normals.empty() && fidelity.is_beyond_alpha(plane, normals[i]);
    double c = normals.empty() ? 1 : cosine(plane, normals[i]);
    criteria.beyond_epsilon += is_beyond_epsilon;
    criteria.beyond_alpha += is_beyond_alpha;
    criteria.beyond_either += is_beyond_epsilon || is_beyond_alpha;
    sum_of_angles += std::acos((std::min)(c, 1.0)) * 57.29577951308232;
  }
  criteria.max_distance_in_epsilons = criteria.max_distance / tolerances.maximum_distance;
  double count = double((std::max)(criteria.assigned, std::size_t(1)));
  criteria.mean_distance /= count;
  criteria.mean_distance_in_epsilons = criteria.mean_distance / tolerances.maximum_distance;
  criteria.mean_normal_angle_deg = sum_of_angles / count;
}

inline Relation_counts count_relations(const std::vector<Plane>& planes, const Relation_tolerance& tolerance)
{
  Plane_relations r(planes, tolerance);
  return {r.directions(), r.planes(), r.degrees_of_freedom(), r.complexity()};
}

// `normals` may be empty. Throws std::runtime_error where sizes or labels do not fit.
inline Criteria evaluate(const std::vector<Vec>& points, const std::vector<Vec>& normals, const Detection& detection,
                         const Tolerances& tolerances)
{
  if(detection.label.size() != points.size())
    throw std::runtime_error(std::to_string(detection.label.size()) + " labels for " + std::to_string(points.size()) +
                             " points");
  Criteria criteria;
  criteria.points = points.size();
  criteria.shapes = detection.planes.size();
  auto sizes = shape_sizes(detection);
  criteria.smallest_shape = sizes.empty() ? 0 : *std::min_element(sizes.begin(), sizes.end());
  for(const Plane& plane : detection.planes)
    criteria.not_unit += !(std::abs(length(plane.normal) - 1) <= 1e-9);
  check_points(points, normals, detection, tolerances, criteria);
  Extent extent = extent_of(points);
  criteria.exact = count_relations(detection.planes, exact_relations());
  criteria.relaxed = count_relations(detection.planes, relaxed_relations(extent.diagonal, extent.center));
  return criteria;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_H
