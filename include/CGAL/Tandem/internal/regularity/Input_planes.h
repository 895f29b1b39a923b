// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planes that another method has found, with their points on the grid, as input of the regularity step. Computes fits,
// counts of misfits, and an estimate of epsilon. It is for relate_planes() only; the detection has fits and counts of
// its own. Nothing is changed here.

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

// The shapes are the planes, in the caller's order. It is the callback of regularize() that counts misfits. Its
// executor is In_order: all runs on one thread.
class Input_planes : public In_order {
public:
  // plane_of: by imported point, -1 if it has none. The points must be on the grid: see put_on_grid().
  Input_planes(const Import& in, const std::vector<int>& plane_of, const std::vector<Coefficients>& planes,
               double epsilon)
    : first(planes.size() + 1, 0), tolerance(llrint(epsilon / in.grid.step * normal_scale))
  {
    sort_points(in, plane_of);
    for(std::size_t s = 0; s < planes.size(); ++s)
      add_plane(planes[s], in.grid, s);
  }

  const Shape_fits& fits() const { return fits_; }

  // By shape: planes without a normal, or with points that determine no plane, get no relations.
  const std::vector<char>& is_excluded() const { return is_excluded_; }

  // Adds to counts[k] the points of shapes[k] within epsilon of its input plane, but not of candidates[k]. Normals of
  // points play no part, as the input has none.
  void operator()(const std::vector<int>& shapes, const Regular_planes& candidates,
                  std::vector<std::int64_t>& counts) const
  {
    for(std::size_t k = 0; k < shapes.size(); ++k) {
      const int s = shapes[k];
      const Plane candidate = on_grid(candidates[k], fits_[s].scatter.centroid);
      for(std::size_t i = first[s]; i < first[s + 1]; ++i)
        counts[k] += is_near(given[s], point[i], tolerance) && !is_near(candidate, point[i], tolerance);
    }
  }

private:
  // Sorts the points by plane, by counting, so that those of a plane are consecutive.
  void sort_points(const Import& in, const std::vector<int>& plane_of)
  {
    for(int s : plane_of)
      if(s >= 0)
        ++first[s + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    point.resize(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for(std::size_t i = 0; i < plane_of.size(); ++i)
      if(plane_of[i] >= 0)
        point[next[plane_of[i]]++] = in.point[i];
  }

  // The integer plane of p. It is most accurate near the point that it is made of. This is the foot of the
  // perpendicular from `near`.
  static Plane on_grid(const Regular_plane& p, const Vector& near)
  {
    return make_plane(p.normal, add_scaled(near, p.offset - dot(p.normal, near), p.normal));
  }

  // Fits the points of plane s. Points on a line, of a second eigenvalue near 0, determine no plane.
  void add_plane(const Coefficients& c, const Grid& grid, std::size_t s)
  {
    Moments moments;
    for(std::size_t i = first[s]; i < first[s + 1]; ++i)
      moments.add(point[i]);
    const Scatter scatter = make_scatter(moments);
    const Eigen_system e = eigen_system(scatter.matrix);
    const Vector n = {c[0], c[1], c[2]};
    const bool has_normal = dot(n, n) > 0;
    fits_.push_back({scatter, fit_plane(scatter)});
    is_excluded_.push_back(!has_normal || moments.count < 3 ||
                           !(e.value[1] > tuning::exactness::minimum_width_ratio2 * e.value[2]));
    given.push_back(has_normal ? given_plane({n, -(dot(n, grid.origin) + c[3]) / grid.step}, scatter.centroid)
                               : Plane{0, 0, 0, 0});
  }

  // The integers hold the planes near the grid. A plane that is farther from its points is far from all of them.
  static Plane given_plane(const Regular_plane& p, const Vector& near)
  {
    constexpr double largest = double(std::int64_t(1) << 30); // steps
    const bool is_far = !(std::fabs(p.offset - dot(p.normal, near)) <= largest);
    return is_far ? Plane{0, 0, 0, (std::numeric_limits<std::int64_t>::max)()} : on_grid(p, near);
  }

  std::vector<Grid_point> point;  // those of a plane together
  std::vector<std::size_t> first; // of each plane in that table, and the end
  Shape_fits fits_;
  std::vector<char> is_excluded_;
  std::vector<Plane> given; // input planes on the grid; null without a normal
  std::int64_t tolerance;   // epsilon in 2^-28 steps
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_INPUT_PLANES_H
