// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Spacing and noise of a cloud, from a sample of its octree cells, to estimate parameters that are not set. The
// sample does not depend on the order of the points. Where noise exceeds the spacing, the nearest neighbors of a point
// form a ball instead of a disk. They do not show the noise, so the sample is thinned until they reach farther.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/cloud/cells.h>
#include <CGAL/Tandem/internal/neighbors/Cloud_measure.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>

#include <algorithm>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// A leaf of the octree of which a cell is in a sample.
struct Sampled_leaf {
  std::uint64_t first_cell, points;
};

// A sample of about tuning::estimation::sampled_points points of all ranks, in the order of the curve. Whole cells are
// taken at a constant stride, since neighbors of a point must be in the sample as well. Copies of a point count once.
template <class Backend>
std::vector<Grid_point> sample_cells(Backend& backend, const Host_buffer<Grid_point>& point)
{
  using namespace tuning::estimation;
  const Ranks<Backend> ranks(backend);
  Box box;
  for(const Grid_point& p : point)
    box.add(p);
  for(const Box& part : ranks.gather(std::vector<Box>{box}))
    box.add(part);
  const Code_frame frame = make_code_frame(box);
  auto order = sort_along_curve(backend, point.data(), point.size(), frame);
  const std::vector<Octant> leaves = find_leaves(backend, order, frame, sampled_cell_size);
  const std::uint64_t stride = (ranks.total(point.size()) + sampled_points - 1) / sampled_points;
  std::vector<Sampled_leaf> chosen;
  std::vector<Grid_point> own;
  std::uint64_t cell = 0;
  for(const Octant& leaf : leaves) {
    const std::uint64_t end = cell + leaf.number_of_cells(sampled_cell_size);
    if((cell + stride - 1) / stride * stride < end) {
      chosen.push_back({cell, leaf.total});
      for(std::uint32_t i = leaf.own.first; i < leaf.own.last; ++i)
        own.push_back(point[order.view().index(i)]);
    }
    cell = end;
  }
  // A leaf of several cells is cut when all of its points are here.
  const std::vector<Grid_point> all = ranks.gather(std::move(own));
  if constexpr(Ranks<Backend>::are_many)
    order = sort_along_curve(backend, all.data(), all.size(), frame);
  std::vector<Grid_point> sample;
  std::size_t first = 0;
  for(const Sampled_leaf& leaf : chosen) {
    for(std::uint64_t i = 0; i < leaf.points; ++i)
      if((leaf.first_cell + i / sampled_cell_size) % stride == 0)
        sample.push_back(all[Ranks<Backend>::are_many ? order.view().index(first + i) : first + i]);
    first += leaf.points;
  }
  const auto are_copies = [](const Grid_point& a, const Grid_point& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  };
  sample.erase(std::unique(sample.begin(), sample.end(), are_copies), sample.end());
  return sample;
}

inline double grid_distance(const Grid_point& a, const Grid_point& b)
{
  const std::int64_t x = std::int64_t(a.x) - b.x, y = std::int64_t(a.y) - b.y, z = std::int64_t(a.z) - b.z;
  return std::sqrt(double(std::uint64_t(x * x) + std::uint64_t(y * y) + std::uint64_t(z * z)));
}

// The measure of point i, in grid steps, from its row of neighbors.
inline Cloud_measure measure_neighborhood(const Grid_point* point, std::uint32_t i, const std::uint32_t* row)
{
  Moments moments;
  moments.add(point[i]);
  double sum = 0;
  int spaced = 0;
  for(int j = 0; j < tuning::estimation::noise_neighbors && row[j] != no_index; ++j) {
    moments.add(point[row[j]]);
    if(j < tuning::estimation::spacing_neighbors) {
      sum += grid_distance(point[i], point[row[j]]);
      ++spaced;
    }
  }
  const Eigen_system e = eigen_system(make_scatter(moments).matrix);
  const double smallest = e.value[0] > 0 ? e.value[0] : 0;
  return {spaced > 0 ? sum / spaced : 0, std::sqrt(smallest / double(moments.count)),
          e.value[1] > 0 ? std::sqrt(smallest / e.value[1]) : 0};
}

// The q-quantile of the values, which are reordered, in linear time.
inline double quantile(std::vector<double>& values, double q)
{
  const auto nth = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// The measure of a sample, by quantiles over its points, in grid steps. A point of one cell may lack neighbors in cells
// that are not sampled; these few hardly change medians and quartiles.
template <class Backend>
Cloud_measure measure_sample(Backend& backend, const std::vector<Grid_point>& sample)
{
  std::vector<std::uint32_t> neighbor(sample.size() * tuning::estimation::noise_neighbors);
  find_neighbors(backend, sample.data(), std::uint32_t(sample.size()), tuning::estimation::noise_neighbors,
                 neighbor.data());
  std::vector<double> spacing(sample.size()), noise(sample.size()), thickness(sample.size());
  backend.for_each(sample.size(), [&](std::size_t i) {
    const Cloud_measure m =
      measure_neighborhood(sample.data(), std::uint32_t(i), neighbor.data() + i * tuning::estimation::noise_neighbors);
    spacing[i] = m.spacing;
    noise[i] = m.noise;
    thickness[i] = m.thickness;
  });
  using namespace tuning::estimation;
  return {quantile(spacing, spacing_quantile), quantile(noise, noise_quantile),
          quantile(thickness, thickness_quantile)};
}

// One point of so many of the sample, in the order of the curve. Of every fourth point the spacing on a surface is twice
// as wide.
inline std::vector<Grid_point> thinned(const std::vector<Grid_point>& sample)
{
  std::vector<Grid_point> thin;
  for(std::size_t i = 0; i < sample.size(); i += tuning::estimation::thinning)
    thin.push_back(sample[i]);
  return thin;
}

// The measure of an import, in the units of its coordinates; zeros if all points are equal, or closer than any epsilon.
// It works on a grid of its own, since epsilon is not known yet. The spacing is that of the cloud before it is thinned.
template <class Backend>
Cloud_measure measure_cloud(Backend& backend, const Import& in)
{
  if(!(in.box.extent() > smallest_length))
    return Cloud_measure();
  using namespace tuning::estimation;
  const Grid grid = make_grid(in.box, std::ldexp(in.box.extent(), measured_distance_bits)); // up to 2^27 steps
  const double inverse_step = 1 / grid.step;
  Host_buffer<Grid_point> point(in.size());
  in.download_values();
  backend.for_each(in.size(),
                   [&](std::size_t i) { point[i] = to_grid(grid, inverse_step, in.position(i), no_normal); });
  std::vector<Grid_point> sample = sample_cells(backend, point);
  Cloud_measure measure = measure_sample(backend, sample);
  const double spacing = measure.spacing;
  for(int i = 0; i < maximum_thinnings && measure.thickness > ball_thickness && sample.size() > minimum_sample; ++i) {
    sample = thinned(sample);
    measure = measure_sample(backend, sample);
  }
  return {spacing * grid.step, measure.noise * grid.step, measure.thickness};
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_MEASURE_CLOUD_H
