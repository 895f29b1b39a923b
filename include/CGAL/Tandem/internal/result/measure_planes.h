// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The uncertainty of each plane of a result, from the moments of the points that its shape has in the end. The moments
// are sums of integers; what follows from them is computed on the host. See the manual, "Uncertainty of Planes".

#ifndef CGAL_TANDEM_INTERNAL_RESULT_MEASURE_PLANES_H
#define CGAL_TANDEM_INTERNAL_RESULT_MEASURE_PLANES_H

#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/result/Engine_result.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL::Tandem::internal {

// The variance of a normal along an axis of the plane, of which `spread` is the sum of the squared coordinates about the
// centroid: noise^2 / spread, as of any line that is fitted, corrected for the noise that `spread` itself has. Where the
// points are no wider than thick, or of no width but rounding, nothing is known.
inline double normal_variance(double spread, double count, double noise2, double rounding)
{
  const double width = fused(-count, noise2, spread);
  return width > rounding ? (std::min)(noise2 * (spread / width) / width, 1.) : 1;
}

// Of a plane with these points, in one unit. maximum_distance: the noise of three points, which have no residual.
inline Plane_uncertainty plane_uncertainty(const Scatter& s, const Regular_plane& plane, double maximum_distance)
{
  const double mean = dot(plane.normal, s.centroid) - plane.offset;
  const double squares = fused(s.count * mean, mean, (std::max)(quadratic_form(s.matrix, plane.normal), 0.));
  const double noise2 = s.count > 3 ? squares / (s.count - 3) : maximum_distance * maximum_distance;
  Plane_uncertainty u;
  u.centroid = {s.centroid.x, s.centroid.y, s.centroid.z};
  u.noise = std::sqrt(noise2);
  u.offset_deviation = std::sqrt(noise2 / s.count);
  // The scatter within the plane, by two orthogonal axes, and a third eigenvalue that is the smallest one.
  const Vector a = unit(cross(plane.normal, farthest_axis(plane.normal))), b = cross(plane.normal, a);
  const Vector ma = s.matrix * a;
  const double aa = dot(a, ma), ab = dot(b, ma), bb = quadratic_form(s.matrix, b);
  const Eigen_system e = eigen_system({aa, ab, 0, bb, 0, -1 - aa - bb});
  const double rounding = tuning::exactness::squared_distance_margin * e.value[2];
  double largest = 0;
  Symmetric_matrix m = {};
  for(int i = 1; i < 3; ++i) {
    const double variance = normal_variance(e.value[i], s.count, noise2, rounding);
    m = add_square(m, variance, add_scaled(e.vector[i].x * a, e.vector[i].y, b));
    largest = (std::max)(largest, variance);
  }
  u.normal_covariance = {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz};
  u.angle_deg = std::sqrt(largest) * (180 / 3.14159265358979323846);
  return u;
}

// For each cell: the moments and boxes of the shapes of the result. Of a surfel, the points count that have its label
// in the end. Successive surfels often have the same shape, so each lane sums a run of them before it looks up a slot.
template <class Backend>
struct Sum_moments {
  Cloud_view cloud;
  Cells_view cells;
  Final_shapes shapes;
  Shared_moments* sum; // by shape

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Moment_table& table, std::uint32_t c) const
  {
    const Range cell = cells[c];
    if(cell.size() == 0)
      return;
    const Grid_point& base = cloud.point[cell.first];
    const Cell_sums sums = {cloud.surfels, base, sum};
    const auto add = [&](const Shape_run& run) { table.template add<Backend>(block, run, sums); };
    table.clear(block);
    block.template accumulate<Shape_run>(
      cell.size(),
      [&](std::uint32_t at, Shape_run& run) {
        const std::uint32_t i = cell.first + at, s = shapes.shape[i];
        if(s == no_index)
          return;
        if(s != run.shape) {
          add(run);
          run = Shape_run();
          run.shape = s;
        }
        shapes.labels.for_each_point(i, [&](std::uint32_t p) { run.add_point(cloud.surfels, p, base, 1); });
      },
      add);
    table.template flush<Backend>(block, sums);
  }
};

// From the grid to the caller's units.
inline Plane_uncertainty to_caller(Plane_uncertainty u, const Grid& grid)
{
  const double origin[3] = {grid.origin.x, grid.origin.y, grid.origin.z};
  for(int c = 0; c < 3; ++c)
    u.centroid[c] = fused(grid.step, u.centroid[c], origin[c]);
  u.noise *= grid.step;
  u.offset_deviation *= grid.step;
  return u;
}

// Of the shapes of a result, whose planes and maximum_distance are in the caller's units.
template <class Backend>
void measure_planes(Labeled_cloud<Backend>& points, const Final_shapes& shapes, const Grid& grid,
                    double maximum_distance, std::vector<Engine_shape>& result)
{
  Backend& backend = points.backend;
  auto sums = filled_buffer(backend, result.size(), Shared_moments());
  backend.template for_each_cell<Moment_table>(
    points.number_of_parts(), Sum_moments<Backend>{points.cloud.view(), points.parts(), shapes, sums.data()});
  sum_moments(backend, points.ranks, sums.size(), sums.data());
  const std::vector<Shared_moments> moments = to_vector(backend, sums);
  for(std::size_t s = 0; s < result.size(); ++s) {
    const Scatter scatter = make_scatter(moments[s].moments());
    const Regular_plane plane = to_grid(result[s].plane, grid);
    result[s].uncertainty = to_caller(plane_uncertainty(scatter, plane, maximum_distance / grid.step), grid);
  }
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_MEASURE_PLANES_H
