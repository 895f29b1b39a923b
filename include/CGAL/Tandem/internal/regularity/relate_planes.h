// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step for planes that another method has found: see regularize_planes().

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_RELATE_PLANES_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_RELATE_PLANES_H

#include <CGAL/Tandem/Plane_relations.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/regularity/given_directions.h>
#include <CGAL/Tandem/internal/regularity/Great_circle_index.h>
#include <CGAL/Tandem/internal/regularity/regularize.h>

#include <vector>

namespace CGAL::Tandem::internal {

// --- Planes that another method has found, with their points on the grid, as input of the regularity step. Computes fits
// and an estimate of epsilon. It is for relate_planes() only; the detection has fits of its own. Nothing is changed here.

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
  return fused(c[0], p.x, fused(c[1], p.y, fused(c[2], p.z, c[3])));
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
struct Input_planes {
  Shape_fits fits;
  std::vector<char> is_excluded; // by shape: without a normal, or with points that determine no plane; no relations

  // The points of the smallest of the others; 0 if there is none.
  double smallest_size() const
  {
    double smallest = 0;
    for(std::size_t s = 0; s < fits.size(); ++s)
      if(!is_excluded[s] && (smallest == 0 || fits[s].scatter.count < smallest))
        smallest = fits[s].scatter.count;
    return smallest;
  }
};

// plane_of: by imported point, -1 if it has none. The points must be on the grid: see put_on_grid(). Points on a line, of
// a second eigenvalue near 0, determine no plane.
inline Input_planes input_planes(const Import& in, const std::vector<int>& plane_of,
                                 const std::vector<Coefficients>& planes)
{
  std::vector<Moments> moments(planes.size());
  for(std::size_t i = 0; i < plane_of.size(); ++i)
    if(plane_of[i] >= 0)
      moments[std::size_t(plane_of[i])].add(in.point[i]);
  Input_planes given;
  for(std::size_t s = 0; s < planes.size(); ++s) {
    const Scatter scatter = make_scatter(moments[s]);
    const Eigen_system e = eigen_system(scatter.matrix);
    const Vector n = {planes[s][0], planes[s][1], planes[s][2]};
    given.fits.push_back({scatter, fit_plane(scatter)});
    given.is_excluded.push_back(!(dot(n, n) > 0) || moments[s].count < 3 ||
                                !(e.value[1] > tuning::exactness::minimum_width_ratio2 * e.value[2]));
  }
  return given;
}

// Without points, or without noise and offset, any positive length serves.
inline double resolve_maximum_distance(const Import& in, const std::vector<int>& plane_of,
                                       const std::vector<Coefficients>& planes, const Parameters& p)
{
  if(p.maximum_distance > 0)
    return p.maximum_distance;
  const double estimate = (std::max)(estimate_maximum_distance(in, plane_of, planes), p.maximum_offset);
  const double extent = in.size() > 0 ? in.box.extent() : 0;
  const double smallest = extent > 0 ? extent * tuning::estimation::smallest_distance : 1;
  return bounded_length((std::max)(estimate, smallest));
}

// No two points are that far apart, so a larger tolerance has no other effect.
inline double bounded_by_extent(double length, const Import& in)
{
  const double extent = in.size() > 0 ? in.box.extent() : 0;
  const double largest = bounded_length(extent * tuning::grid::maximum_distance_per_extent);
  return extent > 0 ? (std::min)(length, largest) : length;
}

// Whether the step left a plane to itself.
inline std::vector<char> find_unrelated(const Relations& r, const Shape_fits& fits)
{
  std::vector<int> size(r.directions.size(), 0);
  for(int d : r.direction_of)
    ++size[d];
  std::vector<char> is_unrelated;
  for(std::size_t s = 0; s < fits.size(); ++s) {
    const int d = r.direction_of[s];
    is_unrelated.push_back(size[d] == 1 && r.directions[d] == canonical(fits[s].fit.normal));
  }
  return is_unrelated;
}

// The new planes in the caller's coordinates, oriented as the given ones, which stay where nothing relates them.
inline std::vector<Coefficients> related_planes(const Relations& r, const std::vector<Coefficients>& given,
                                                const std::vector<char>& is_unrelated, const Grid& grid)
{
  std::vector<Coefficients> result;
  for(std::size_t s = 0; s < given.size(); ++s) {
    Coefficients c = is_unrelated[s] ? given[s] : to_caller(r.planes[r.plane_of[s]], grid);
    if(dot({c[0], c[1], c[2]}, {given[s][0], given[s][1], given[s][2]}) < 0)
      c = {-c[0], -c[1], -c[2], -c[3]};
    result.push_back(c);
  }
  return result;
}

// For the caller's information only: no decision depends on the angle.
inline double angle_between_deg(const Coefficients& a, const Coefficients& b)
{
  const Vector m = {a[0], a[1], a[2]}, n = {b[0], b[1], b[2]};
  return a == b ? 0 : std::atan2(length(cross(m, n)), std::fabs(dot(m, n))) / angles::radians_per_degree;
}

inline void measure_planes(const Import& in, const std::vector<int>& plane_of, const std::vector<Coefficients>& planes,
                           Plane_relations& result)
{
  result.largest_distance.assign(planes.size(), 0);
  for(std::size_t i = 0; i < in.size(); ++i)
    if(plane_of[i] >= 0) {
      double& largest = result.largest_distance[plane_of[i]];
      largest = (std::max)(largest, std::fabs(signed_distance(planes[plane_of[i]], in.position(i))));
    }
}

// All but reading from and writing to the caller's ranges. p: with the angle as maximum_angle. `planes` are replaced;
// their normals are unit or null then.
template <class Backend>
Plane_relations relate_planes(Backend& backend, Import& in, const std::vector<int>& plane_of, Parameters p,
                              std::vector<Coefficients>& planes)
{
  for(Coefficients& c : planes)
    c = normalized(c);
  Plane_relations result;
  result.maximum_distance = bounded_by_extent(resolve_maximum_distance(in, plane_of, planes, p), in);
  p.maximum_distance = result.maximum_distance;
  p.maximum_offset = bounded_by_extent(p.maximum_offset, in);
  put_on_grid(backend, in, p.maximum_distance);
  const Input_planes given = input_planes(in, plane_of, planes);
  const auto options = make_regularity_parameters(p, p.maximum_angle, in.grid.step, given.smallest_size());
  const Relations r = regularize(given.fits, given.is_excluded, options);
  const std::vector<char> is_unrelated = find_unrelated(r, given.fits);
  const std::vector<Coefficients> old = planes;
  planes = related_planes(r, old, is_unrelated, in.grid);
  result.parallel_group = r.direction_of;
  result.coplanar_group = r.plane_of;
  result.is_rolled_back.assign(r.is_rolled_back.begin(), r.is_rolled_back.end());
  for(std::size_t s = 0; s < planes.size(); ++s) {
    result.is_changed.push_back(!is_unrelated[s]);
    result.angle.push_back(angle_between_deg(planes[s], old[s]));
  }
  // A plane without normal is orthogonal to nothing.
  result.orthogonal_groups = orthogonal_pairs(group_directions(result.parallel_group, planes));
  measure_planes(in, plane_of, planes, result);
  return result;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_RELATE_PLANES_H
