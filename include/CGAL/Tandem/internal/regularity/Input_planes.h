// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes that another method has found, with their points on the grid, as input of the regularity step. Computes fits
// and an estimate of epsilon. It is for relate_planes() only; the detection has fits of its own. Nothing is changed here.

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_INPUT_PLANES_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_INPUT_PLANES_H

#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/regularity/regularize.h>

#include <limits>
#include <numeric>

namespace CGAL {
namespace Tandem {
namespace internal {

// With a unit normal. Null where the normal is null or a coefficient is not finite. Divided by the largest component
// first, so that no square overflows.
inline Coefficients normalized(const Coefficients& c)
{
  const double largest = largest_component({c[0], c[1], c[2]});
  if(!(largest > 0) || !std::isfinite(c[0]) || !std::isfinite(c[1]) || !std::isfinite(c[2]) || !std::isfinite(c[3]))
    return {0, 0, 0, 0};
  const Vector scaled = {c[0] / largest, c[1] / largest, c[2] / largest};
  const Vector n = unit(scaled);
  return {n.x, n.y, n.z, c[3] / largest / length(scaled)};
}

// To a plane of unit normal, in the caller's coordinates.
inline double signed_distance(const Coefficients& c, const Vector& p)
{
  return std::fma(c[0], p.x, std::fma(c[1], p.y, std::fma(c[2], p.z, c[3])));
}

// epsilon where the caller gives none: some times the root mean square distance of the points to their planes. Sums are
// integers, so the order of the points does not matter. 0 if all points lie on their planes.
inline double estimate_maximum_distance(const Import& in, const std::vector<int>& plane_of,
                                        const std::vector<Coefficients>& planes)
{
  double largest = 0, count = 0;
  auto for_each_distance = [&](auto f) {
    for(std::size_t i = 0; i < in.size(); ++i)
      if(plane_of[i] >= 0)
        f(std::fabs(signed_distance(planes[plane_of[i]], in.position(i))));
  };
  for_each_distance([&](double d) {
    largest = (std::max)(largest, d);
    ++count;
  });
  if(!(largest > 0) || !std::isfinite(largest))
    return 0;
  std::int64_t sum = 0; // of squares, in units of 2^-15: 2^30 times at most 2^31 points
  for_each_distance([&](double d) {
    const std::int64_t scaled = llrint(d / largest * 32768);
    sum += scaled * scaled;
  });
  return tuning::estimation::distance_per_rms * largest * std::sqrt(double(sum) / count) / 32768;
}

// The shapes are the planes, in the caller's order.
class Input_planes {
public:
  // plane_of: by imported point, -1 if it has none. The points must be on the grid: see put_on_grid().
  Input_planes(const Import& in, const std::vector<int>& plane_of, const std::vector<Coefficients>& planes)
  {
    std::vector<Moments> moments(planes.size());
    for(std::size_t i = 0; i < plane_of.size(); ++i)
      if(plane_of[i] >= 0)
        moments[std::size_t(plane_of[i])].add(in.point[i]);
    for(std::size_t s = 0; s < planes.size(); ++s)
      add_plane(planes[s], moments[s]);
  }

  const Shape_fits& fits() const { return fits_; }

  // By shape: planes without a normal, or with points that determine no plane, get no relations.
  const std::vector<char>& is_excluded() const { return is_excluded_; }

  // The points of the smallest of the others; 0 if there is none.
  double smallest_size() const
  {
    double smallest = 0;
    for(std::size_t s = 0; s < fits_.size(); ++s)
      if(!is_excluded_[s] && (smallest == 0 || fits_[s].scatter.count < smallest))
        smallest = fits_[s].scatter.count;
    return smallest;
  }

private:
  // Fits the points of plane s. Points on a line, of a second eigenvalue near 0, determine no plane.
  void add_plane(const Coefficients& c, const Moments& moments)
  {
    const Scatter scatter = make_scatter(moments);
    const Eigen_system e = eigen_system(scatter.matrix);
    const Vector n = {c[0], c[1], c[2]};
    fits_.push_back({scatter, fit_plane(scatter)});
    is_excluded_.push_back(!(dot(n, n) > 0) || moments.count < 3 ||
                           !(e.value[1] > tuning::exactness::minimum_width_ratio2 * e.value[2]));
  }

  Shape_fits fits_;
  std::vector<char> is_excluded_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_INPUT_PLANES_H
