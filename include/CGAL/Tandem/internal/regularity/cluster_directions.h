// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clusters of unoriented normals on the Gauss map (section 4.1 of the paper). Groups of normals are found by mean
// shift; normals and shapes do not change. See the manual, "Gauss Map Clustering".

#ifndef CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_DIRECTIONS_H
#define CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_DIRECTIONS_H

#include <CGAL/Tandem/internal/regularity/Direction_index.h>
#include <CGAL/Tandem/internal/regularity/Mean_shift.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace CGAL {
namespace Tandem {
namespace internal {

// Normals and weights gathered in small cubes. So the cost of the mean shift depends on the number of different
// directions, not of shapes. Sums are integers: bins do not depend on the order of the shapes.
// normal[b] is the mean direction of bin b, rounded; weight[b] the sum of weights.
struct Direction_bins {
  std::vector<Vector> normal;
  std::vector<double> weight;
};

// Bins of the given width, sorted by cube. n log n for n normals.
template <class Executor>
Direction_bins make_direction_bins(const std::vector<Vector>& normals, const std::vector<double>& weights, double width,
                                   const Executor& executor)
{
  using Item = std::array<std::int64_t, 4>; // weighted normal, weight
  const std::size_t n = normals.size();
  // 21 bits a coordinate: for tolerances below a thousandth of a degree, bins are wider.
  const double cubes = 1 / (std::max)(width, std::ldexp(1.0, -19));
  const double scale = double(1 << 26); // times at most 2^32 points fits int64
  std::vector<Item> items(n);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(n); // by cube
  executor.for_each(n, [&](std::size_t i) {
    const Vector v = canonical(normals[i]);
    std::uint64_t cube = 0;
    for(double c : {v.x, v.y, v.z})
      cube = cube << 21 | std::uint64_t(llrint(c * cubes) + (1 << 20));
    const std::int64_t w = llrint(weights[i]);
    items[i] = {w * llrint(v.x * scale), w * llrint(v.y * scale), w * llrint(v.z * scale), w};
    order[i] = {cube, std::uint32_t(i)};
  });
  std::sort(order.begin(), order.end());
  Direction_bins bins;
  for(std::size_t i = 0, j; i < n; i = j) {
    Item sum = {0, 0, 0, 0};
    for(j = i; j < n && order[j].first == order[i].first; ++j)
      for(std::size_t k = 0; k < 4; ++k)
        sum[k] += items[order[j].second][k];
    bins.normal.push_back(rounded_normal(canonical(unit({double(sum[0]), double(sum[1]), double(sum[2])}))));
    bins.weight.push_back(double(sum[3]));
  }
  return bins;
}

// Groups of normals within the radius (a sine) of a mode, as lists of positions in the input. A normal joins the
// nearest mode; of equally near ones, the denser. Those that no mode reaches are clustered again, and stay alone at
// last. Each position is in one group. For the executor see Mean_shift.
template <class Executor>
std::vector<std::vector<int>> cluster_directions(const std::vector<Vector>& normals, const std::vector<double>& weights,
                                                 double radius, const Executor& executor)
{
  std::vector<std::vector<int>> groups;
  std::vector<int> rest(normals.size());
  for(std::size_t i = 0; i < rest.size(); ++i)
    rest[i] = int(i);
  for(int pass = 0; pass < tuning::clustering::maximum_passes && !rest.empty(); ++pass) {
    std::vector<Vector> n(rest.size());
    std::vector<double> w(rest.size());
    for(std::size_t k = 0; k < rest.size(); ++k) {
      n[k] = normals[std::size_t(rest[k])];
      w[k] = weights[std::size_t(rest[k])];
    }
    const Direction_bins bins =
      make_direction_bins(n, w, radius / tuning::clustering::direction_bins_per_radius, executor);
    const std::vector<Vector> modes = Mean_shift<Direction_index>(bins.normal, bins.weight, radius).modes(executor);
    const Direction_index index(modes, radius);
    const std::size_t start = groups.size();
    groups.resize(start + modes.size());
    std::vector<std::pair<double, std::size_t>> nearest(rest.size(), {2.0, 0});
    executor.for_each(rest.size(), [&](std::size_t k) {
      index.near(n[k], [&](std::size_t m, double q) { nearest[k] = (std::min)(nearest[k], {q, m}); });
    });
    // A squared sine is at most 1: larger means that no mode is near.
    std::vector<int> left;
    for(std::size_t k = 0; k < rest.size(); ++k)
      (nearest[k].first <= 1 ? groups[start + nearest[k].second] : left).push_back(rest[k]);
    rest.swap(left);
  }
  for(int i : rest)
    groups.push_back({i});
  groups.erase(std::remove_if(groups.begin(), groups.end(), [](const std::vector<int>& g) { return g.empty(); }),
               groups.end());
  return groups;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_REGULARITY_CLUSTER_DIRECTIONS_H
