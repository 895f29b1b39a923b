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
  Size_curve(const std::vector<std::size_t>& sizes, std::size_t points)
  {
    for(std::size_t size : sizes)
      shares_.push_back(double(size) / double(points));
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
