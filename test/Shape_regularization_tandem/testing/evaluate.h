// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is judged of the labels and planes that any detector made: the paper's criteria, and how few and how large its
// shapes are. Nothing of the package takes part.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_H

#include "plane_relations.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace CGAL::Tandem::benchmark {

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
  std::size_t points = 0, assigned = 0, shapes = 0;
  std::size_t beyond_epsilon = 0, beyond_alpha = 0, beyond_either = 0; // points
  double mean_distance_in_epsilons = 0, max_distance_in_epsilons = 0;
  Relation_counts relations; // within 1e-6

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
  const Fidelity fidelity(tolerances);
  double sum = 0, largest = 0;
  for(std::size_t i = 0; i < points.size(); ++i) {
    if(detection.label[i] < 0)
      continue;
    const Plane& plane = detection.planes[std::size_t(detection.label[i])];
    const double d = distance(plane, points[i]);
    ++criteria.assigned;
    sum += d;
    largest = (std::max)(largest, d);
    const bool is_beyond_epsilon = fidelity.is_beyond_epsilon(plane, points[i]);
    const bool is_beyond_alpha = !normals.empty() && fidelity.is_beyond_alpha(plane, normals[i]);
    criteria.beyond_epsilon += is_beyond_epsilon;
    criteria.beyond_alpha += is_beyond_alpha;
    criteria.beyond_either += is_beyond_epsilon || is_beyond_alpha;
  }
  const double count = double((std::max)(criteria.assigned, std::size_t(1)));
  criteria.mean_distance_in_epsilons = sum / count / tolerances.maximum_distance;
  criteria.max_distance_in_epsilons = largest / tolerances.maximum_distance;
}

inline Relation_counts count_relations(const std::vector<Plane>& planes, const Extent& extent)
{
  const Plane_relations r(planes, extent.diagonal, extent.center);
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
  shape_sizes(detection); // throws for labels that no plane has
  check_points(points, normals, detection, tolerances, criteria);
  criteria.relations = count_relations(detection.planes, extent_of(points));
  return criteria;
}

// How few and how large the shapes are: the ratio of the points in the N largest shapes, and in the N largest distinct
// planes. Points beyond the tolerances of their plane do not count. So a detector gains nothing by planes that are far
// from their points. The largest first. Sizes are ratios of all points of the cloud.
class Size_curve {
public:
  Size_curve() = default;
  Size_curve(const std::vector<std::size_t>& sizes, std::size_t points)
  {
    for(std::size_t size : sizes)
      ratios_.push_back(double(size) / double(points));
    std::sort(ratios_.begin(), ratios_.end(), std::greater<double>());
  }

  std::size_t size() const { return ratios_.size(); }

  // The ratio of the points in the n largest.
  double top(std::size_t n) const
  {
    return std::accumulate(ratios_.begin(), ratios_.begin() + std::ptrdiff_t((std::min)(n, size())), 0.);
  }

  // How many are needed for that ratio of the points; size() + 1 if all of them are not enough.
  std::size_t needed_for(double ratio) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < size(); ++i)
      if((sum += ratios_[i]) >= ratio)
        return i + 1;
    return size() + 1;
  }

private:
  std::vector<double> ratios_;
};

// The degrees of freedom of the planes of as many of the largest shapes as a clean coverage needs: of the directions, and
// one for each plane. 0 where the detection has less.
struct Needed_freedom {
  double coverage = 0;
  std::size_t degrees_of_freedom = 0;
};

struct Curves {
  Size_curve shapes, planes;
  std::array<Needed_freedom, 5> needed = {{{.5}, {.6}, {.7}, {.8}, {.9}}};
};

// The points of each shape with fits(plane, point) for its own plane.
template <class Fits>
std::vector<std::vector<std::size_t>> clean_points(const Detection& detection, Fits fits)
{
  std::vector<std::vector<std::size_t>> clean(detection.planes.size());
  for(std::size_t i = 0; i < detection.label.size(); ++i)
    if(detection.label[i] >= 0 && fits(std::size_t(detection.label[i]), i))
      clean[std::size_t(detection.label[i])].push_back(i);
  return clean;
}

// The distinct planes of the shapes in this order, with the number of their clean points. A shape belongs to the first
// plane that nine tenths of its clean points fit, or else its own plane is a further one. One rule for all detectors,
// whether their planes are equal or nearly so.
template <class Fits>
std::vector<std::size_t> sizes_of_planes(const std::vector<std::vector<std::size_t>>& clean,
                                         const std::vector<std::size_t>& order, Fits fits)
{
  std::vector<std::size_t> distinct, size;
  for(std::size_t s : order) {
    const auto explains = [&](std::size_t f) {
      const std::size_t tolerated = clean[s].size() / 10;
      std::size_t misfits = 0;
      return std::none_of(clean[s].begin(), clean[s].end(),
                          [&](std::size_t i) { return !fits(f, i) && ++misfits > tolerated; });
    };
    const std::size_t plane = std::size_t(std::find_if(distinct.begin(), distinct.end(), explains) - distinct.begin());
    if(plane == distinct.size()) {
      distinct.push_back(s);
      size.push_back(0);
    }
    size[plane] += clean[s].size();
  }
  return size;
}

// `normals` may be empty. The arguments are those of evaluate(), which checks them.
inline Curves evaluate_curves(const std::vector<Vec>& points, const std::vector<Vec>& normals,
                              const Detection& detection, const Tolerances& tolerances)
{
  const Fidelity fidelity(tolerances);
  const auto fits = [&](std::size_t s, std::size_t i) {
    return fidelity.fits(detection.planes[s], points, normals, i);
  };
  const auto clean = clean_points(detection, fits);
  std::vector<std::size_t> order; // of shapes with clean points, the largest first
  for(std::size_t s = 0; s < clean.size(); ++s)
    if(!clean[s].empty())
      order.push_back(s);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return clean[a].size() > clean[b].size(); });

  Curves curves;
  std::vector<std::size_t> sizes;
  for(std::size_t s : order)
    sizes.push_back(clean[s].size());
  curves.shapes = Size_curve(sizes, points.size());
  curves.planes = Size_curve(sizes_of_planes(clean, order, fits), points.size());

  const Extent extent = extent_of(points);
  for(Needed_freedom& needed : curves.needed) {
    const std::size_t n = curves.shapes.needed_for(needed.coverage);
    if(n > order.size())
      continue;
    std::vector<Plane> planes;
    for(std::size_t i = 0; i < n; ++i)
      planes.push_back(detection.planes[order[i]]);
    const Relation_counts counts = count_relations(planes, extent);
    needed.degrees_of_freedom = counts.degrees_of_freedom + counts.planes;
  }
  return curves;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_H
