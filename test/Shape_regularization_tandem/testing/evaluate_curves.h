// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How few and how large the shapes of a detection are: the share of the points in its N largest shapes, and in its N
// largest distinct planes. Points beyond the tolerances of their plane do not count. So a detector gains nothing by
// planes that are far from their points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_CURVES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_CURVES_H

#include "evaluate.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace CGAL {
namespace Tandem {
namespace benchmark {

// The largest first. Sizes are shares of all points of the cloud.
class Size_curve {
public:
  Size_curve() = default;
  explicit Size_curve(std::vector<double> shares) : shares_(std::move(shares))
  {
    std::sort(shares_.begin(), shares_.end(), std::greater<double>());
  }

  std::size_t size() const { return shares_.size(); }

  // The share of the points in the n largest.
  double top(std::size_t n) const
  {
    return std::accumulate(shares_.begin(), shares_.begin() + std::ptrdiff_t((std::min)(n, size())), 0.);
  }

  // Of the curve of top(1) to top(n), divided by n.
  double area(std::size_t n) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < (std::min)(n, size()); ++i)
      sum += double(n - i) * shares_[i];
    return sum / double(n);
  }

  // How many are needed for that share of the points; size() + 1 if all of them are not enough.
  std::size_t needed_for(double share) const
  {
    double sum = 0;
    for(std::size_t i = 0; i < size(); ++i)
      if((sum += shares_[i]) >= share)
        return i + 1;
    return size() + 1;
  }

private:
  std::vector<double> shares_;
};

// The shapes that are needed for a clean coverage, and the degrees of freedom of their planes: of the directions, and
// one for each plane. 0 where the detection has less.
struct Needed_shapes {
  double coverage = 0;
  std::size_t shapes = 0, degrees_of_freedom = 0;
};

struct Curves {
  Size_curve shapes, planes;
  std::array<Needed_shapes, 5> needed = {{{.5}, {.6}, {.7}, {.8}, {.9}}};
};

// The points of each shape that are within the tolerances of its plane.
inline std::vector<std::vector<std::size_t>> clean_points(const std::vector<Vec>& points,
                                                          const std::vector<Vec>& normals, const Detection& detection,
                                                          const Fidelity& fidelity)
{
  std::vector<std::vector<std::size_t>> clean(detection.planes.size());
  for(std::size_t i = 0; i < points.size(); ++i) {
    if(detection.label[i] < 0)
      continue;
    const std::size_t s = std::size_t(detection.label[i]);
    if(fidelity.fits(detection.planes[s], points, normals, i))
      clean[s].push_back(i);
  }
  return clean;
}

// Of each shape: the first one in the order with which it has a plane in common. That is, nine tenths of its clean
// points are within the tolerances of the plane of that one too. One rule for all detectors, whether their planes are
// equal or nearly so. A first one has none before it.
inline std::vector<std::size_t> distinct_planes(const std::vector<Vec>& points, const std::vector<Vec>& normals,
                                                const Detection& detection, const Fidelity& fidelity,
                                                const std::vector<std::vector<std::size_t>>& clean,
                                                const std::vector<std::size_t>& order)
{
  std::vector<std::size_t> first(clean.size()), distinct;
  const auto explains = [&](std::size_t f, std::size_t s) {
    const std::size_t tolerated = clean[s].size() / 10;
    std::size_t misfits = 0;
    for(std::size_t i : clean[s])
      if(!fidelity.fits(detection.planes[f], points, normals, i) && ++misfits > tolerated)
        return false;
    return true;
  };
  for(std::size_t s : order) {
    const auto found = std::find_if(distinct.begin(), distinct.end(), [&](std::size_t f) { return explains(f, s); });
    first[s] = found == distinct.end() ? s : *found;
    if(first[s] == s)
      distinct.push_back(s);
  }
  return first;
}

// `normals` may be empty. The arguments are those of evaluate(), which checks them.
inline Curves evaluate_curves(const std::vector<Vec>& points, const std::vector<Vec>& normals,
                              const Detection& detection, const Tolerances& tolerances)
{
  const Fidelity fidelity(tolerances);
  const auto clean = clean_points(points, normals, detection, fidelity);
  std::vector<std::size_t> order(clean.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return clean[a].size() > clean[b].size(); });
  order.erase(std::find_if(order.begin(), order.end(), [&](std::size_t s) { return clean[s].empty(); }), order.end());
  const auto share = [&](std::size_t s) { return double(clean[s].size()) / double(points.size()); };

  Curves curves;
  std::vector<double> shares(clean.size(), 0), shares_of_planes(clean.size(), 0);
  const std::vector<std::size_t> first = distinct_planes(points, normals, detection, fidelity, clean, order);
  for(std::size_t s : order) {
    shares[s] = share(s);
    shares_of_planes[first[s]] += share(s);
  }
  const auto drop_empty = [](std::vector<double>& v) { v.erase(std::remove(v.begin(), v.end(), 0.), v.end()); };
  drop_empty(shares);
  drop_empty(shares_of_planes);
  curves.shapes = Size_curve(shares);
  curves.planes = Size_curve(shares_of_planes);

  const Extent extent = extent_of(points);
  for(Needed_shapes& needed : curves.needed) {
    const std::size_t n = curves.shapes.needed_for(needed.coverage);
    if(n > order.size())
      continue;
    std::vector<Plane> planes;
    for(std::size_t i = 0; i < n; ++i)
      planes.push_back(detection.planes[order[i]]);
    const Relation_counts counts = count_relations(planes, relaxed_relations(extent.diagonal, extent.center));
    needed.shapes = n;
    needed.degrees_of_freedom = counts.degrees_of_freedom + counts.planes;
  }
  return curves;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_EVALUATE_CURVES_H
