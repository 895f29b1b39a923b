// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes are facets of curved surfaces.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_CURVATURE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_CURVATURE_H

#include <CGAL/Shape_regularization_tandem/models/facts/Shape_cells.h>
#include <CGAL/Shape_regularization_tandem/models/facts/Surface_fit.h>
#include <CGAL/Shape_regularization_tandem/models/for_each_in_parallel.h>
#include <CGAL/Tandem/internal/base/linear_algebra.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal::facts {

class Curvature {
public:
  // smallest: the noise that there is at least, in which less than that of the points bends
  Curvature(const std::vector<Shape_patch>& patches, double smallest) : patches(patches), smallest(smallest) {}

  // Of each shape: the share of the squared distances to a plane that a bent surface explains, of the shape alone or with
  // a neighbor, whichever is larger.
  std::vector<double> of_shapes() const
  {
    std::vector<double> result(patches.size());
    for_each_in_parallel(patches.size(), [&](std::size_t s) { result[s] = of_shape(patches[s]); });
    const Shape_pairs pairs = adjacent_shapes(patches);
    std::vector<double> of_pairs(pairs.size());
    for_each_in_parallel(pairs.size(), [&](std::size_t i) { of_pairs[i] = of_pair(pairs[i]); });
    for(std::size_t i = 0; i < pairs.size(); ++i)
      for(std::size_t s : {pairs[i].first, pairs[i].second})
        result[s] = (std::max)(result[s], of_pairs[i]);
    return result;
  }

private:
  static constexpr double smallest_cosine = .5; // of planes whose shapes may have a surface in common: 60 degrees

  double of_shape(const Shape_patch& patch) const
  {
    if(!(patch.length > 0))
      return 0;
    const Height_frame frame(patch.centroid, patch.normal, patch.length);
    Surface_fit fit;
    for(const Vector& p : patch.points)
      fit.add(frame(p));
    return share_of_bend(fit, patch.length);
  }

  // Of the squared distances to the plane; by chance none, as terms that explain nothing cost as much as they explain.
  // Fewer points than twice the terms of degree 3 tell nothing.
  double share_of_bend(const Surface_fit& fit, double scale) const
  {
    const double n = fit.number_of_points();
    if(n < 2 * Surface_fit::terms)
      return 0;
    const std::array<double, 3> rests = fit.rests();
    const double least = n * (smallest / scale) * (smallest / scale);
    return (std::max)(1 - (rests[1] + least) / (n - 6) * ((n - 3) / (rests[0] + least)), 0.);
  }

  // 0, unless one surface of degree 3 is closer to the points of both than their two planes are: those of the smaller
  // shape, and those of the larger one near it.
  double of_pair(const std::pair<std::size_t, std::size_t>& pair) const
  {
    const bool is_first_smaller = patches[pair.first].length < patches[pair.second].length;
    const Shape_patch& smaller = patches[is_first_smaller ? pair.first : pair.second];
    const Shape_patch& larger = patches[is_first_smaller ? pair.second : pair.first];
    const double cosine = dot(smaller.normal, larger.normal);
    if(std::fabs(cosine) < smallest_cosine)
      return 0;
    const Vector normal = unit(smaller.normal + (cosine < 0 ? -larger.normal : larger.normal));
    const Height_frame frame(smaller.centroid, normal, 2 * smaller.length);
    Vector low = smaller.points[0], high = low;
    for(const Vector& p : smaller.points) {
      low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y), (std::min)(low.z, p.z)};
      high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y), (std::max)(high.z, p.z)};
    }
    const double reach = smaller.length;
    const auto is_near = [&](const Vector& p, int axis) {
      const double x = coordinate(p, axis);
      return x >= coordinate(low, axis) - reach && x <= coordinate(high, axis) + reach;
    };
    Surface_fit of_smaller, of_larger;
    const int axis = larger.axis;
    auto p = std::lower_bound(larger.points.begin(), larger.points.end(), coordinate(low, axis) - reach,
                              [axis](const Vector& q, double x) { return coordinate(q, axis) < x; });
    for(; p != larger.points.end() && is_near(*p, axis); ++p)
      if(is_near(*p, 0) && is_near(*p, 1) && is_near(*p, 2))
        of_larger.add(frame(*p));
    if(of_larger.number_of_points() < Surface_fit::terms)
      return 0;
    for(const Vector& q : smaller.points)
      of_smaller.add(frame(q));
    return share_of_common_bend(of_smaller, of_larger, 2 * smaller.length);
  }

  double share_of_common_bend(const Surface_fit& first, const Surface_fit& second, double scale) const
  {
    Surface_fit both = first;
    both += second;
    const double n = both.number_of_points();
    if((std::min)(first.number_of_points(), second.number_of_points()) < Surface_fit::terms)
      return 0;
    const double two_planes = first.rests()[0] + second.rests()[0];
    const bool is_bent = both.rests()[2] / (n - Surface_fit::terms) < two_planes / (n - 6);
    return is_bent ? share_of_bend(both, scale) : 0;
  }

  const std::vector<Shape_patch>& patches;
  double smallest;
};

} // namespace CGAL::Tandem::internal::facts

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FACTS_CURVATURE_H
