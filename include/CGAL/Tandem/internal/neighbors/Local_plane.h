// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane of a sampled point and its neighbors, and the same over growing neighborhoods: first of few and of more
// nearest neighbors, then of as many in samples that are thinned to a quarter, and so reach twice as far, each time.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_LOCAL_PLANE_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_LOCAL_PLANE_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Lengths are in grid steps. Fewer places than a plane can be judged by: `places` is 0.
struct Local_plane {
  int places = 0;       // of neighbors, and of the point itself
  double residual = 0;  // root mean square distance to the plane, for the degrees of freedom
  double thickness = 0; // share of the half-width
  double radius = 0;    // distance of the farthest neighbor
  Vector normal = {0, 0, 0};
};

inline std::uint64_t squared_grid_distance(const Grid_point& a, const Grid_point& b)
{
  const std::int64_t x = std::int64_t(a.x) - b.x, y = std::int64_t(a.y) - b.y, z = std::int64_t(a.z) - b.z;
  return std::uint64_t(x * x) + std::uint64_t(y * y) + std::uint64_t(z * z);
}

// Whether given normals put two points on the two sides of a wall.
inline bool are_opposite(const Grid_point& a, const Grid_point& b)
{
  const Int_vector m = decode_normal(a.normal), n = decode_normal(b.normal);
  return std::int64_t(m.x) * n.x + std::int64_t(m.y) * n.y + std::int64_t(m.z) * n.z < 0;
}

// The plane of point i and its k nearest neighbors, of its row. Those that are close to another one are copies of it and
// count once; those of the other side of a wall do not count.
inline Local_plane make_local_plane(const Grid_point* point, std::uint32_t i, const std::uint32_t* row, int k)
{
  using namespace tuning::estimation;
  const auto neighbors = int(std::find(row, row + k, no_index) - row);
  Local_plane plane;
  if(neighbors == 0)
    return plane;
  const double squared_radius = double(squared_grid_distance(point[i], point[row[neighbors - 1]]));
  std::uint32_t place[maximum_k + 1] = {i};
  int places = 1;
  Moments moments;
  moments.add(point[i]);
  for(int j = 0; j < neighbors; ++j) {
    const Grid_point& p = point[row[j]];
    const auto is_copy = [&](std::uint32_t q) {
      return double(squared_grid_distance(p, point[q])) < copy_distance * copy_distance * squared_radius;
    };
    if(are_opposite(point[i], p) || std::any_of(place, place + places, is_copy))
      continue;
    place[places++] = row[j];
    moments.add(p);
  }
  const Eigen_system e = eigen_system(make_scatter(moments).matrix);
  if(places < minimum_places || !(e.value[1] > 0))
    return plane;
  const double smallest = e.value[0] > 0 ? e.value[0] : 0;
  return {places, std::sqrt(smallest / (places - 3)), std::sqrt(smallest / e.value[1]), std::sqrt(squared_radius),
          e.vector[0]};
}

// The planes of one of 4^thinnings points of the sample.
struct Plane_level {
  int thinnings;
  int neighbors; // of a point
  std::vector<Local_plane> plane;

  // Copies share a place.
  double places_per_point(std::size_t i) const
  {
    return plane[i].places / ((neighbors + 1.) * double(std::size_t(1) << (2 * thinnings)));
  }
};

// Appends the planes of the points and their k nearest neighbors, and before, if few > 0, of their few nearest ones.
template <class Backend>
void add_levels(Backend& backend, const std::vector<Grid_point>& point, int thinnings, std::pair<int, int> few_and_k,
                std::vector<Plane_level>& levels)
{
  const auto [few, k] = few_and_k;
  const std::size_t n = point.size(), row_size = std::size_t(k);
  std::vector<std::uint32_t> neighbor(n * row_size);
  find_neighbors(backend, point.data(), std::uint32_t(n), k, neighbor.data());
  for(const int neighbors : {few, k}) {
    if(neighbors == 0)
      continue;
    std::vector<Local_plane> plane(n);
    backend.for_each(n, [&](std::size_t i) {
      plane[i] = make_local_plane(point.data(), std::uint32_t(i), neighbor.data() + i * row_size, neighbors);
    });
    levels.push_back({thinnings, neighbors, std::move(plane)});
  }
}

// The planes of a sample, in the order of the curve. On a surface, of every fourth point the spacing is twice as wide.
template <class Backend>
std::vector<Plane_level> measure_planes(Backend& backend, std::vector<Grid_point> sample)
{
  using namespace tuning::estimation;
  std::vector<Plane_level> levels;
  for(int thinnings = 0; sample.size() >= std::size_t(thinnings == 0 ? minimum_places : noise_neighbors); ++thinnings) {
    const bool is_last = sample.size() <= 4 * std::size_t(noise_neighbors);
    const int k = is_last ? int((std::min)(sample.size() - 1, std::size_t(maximum_k))) : noise_neighbors;
    add_levels(backend, sample, thinnings, {thinnings == 0 && k > few_neighbors ? few_neighbors : 0, k}, levels);
    std::vector<Grid_point> thin;
    for(std::size_t i = 0; i < sample.size(); i += 4)
      thin.push_back(sample[i]);
    sample = std::move(thin);
  }
  return levels;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_LOCAL_PLANE_H
