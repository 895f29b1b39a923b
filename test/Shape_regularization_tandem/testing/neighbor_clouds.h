// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds on which neighbors are easy to get wrong: ties, duplicates, outliers, the
// largest coordinates, hardly any points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NEIGHBOR_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NEIGHBOR_CLOUDS_H

#include <CGAL/Tandem/internal/cloud/sort_along_curve.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

using Grid_cloud = std::vector<Grid_point>;
using Twister = std::mt19937;
constexpr int coordinate_bits = 29; // one more than the engine uses
constexpr std::int32_t limit = (1 << coordinate_bits) - 1;

inline std::int32_t uniform(Twister& random, std::int32_t low, std::int32_t high)
{
  return std::int32_t(low + std::int64_t(random() % std::uint64_t(std::int64_t(high) - low + 1)));
}

inline Grid_cloud make_cloud(std::size_t n, const std::function<Grid_point(std::size_t)>& point)
{
  Grid_cloud cloud(n);
  for(std::size_t i = 0; i < n; ++i)
    cloud[i] = point(i);
  return cloud;
}

inline void sort_along_curve(Grid_cloud& cloud)
{
  std::vector<std::pair<std::uint64_t, std::size_t>> order(cloud.size());
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    const Grid_point& p = cloud[i];
    auto cell = [](std::int32_t c) {
      return std::uint32_t(c + (1 << coordinate_bits)) >> (coordinate_bits + 1 - curve_bits);
    };
    order[i] = {hilbert_code(cell(p.x), cell(p.y), cell(p.z)), i};
  }
  std::sort(order.begin(), order.end());
  Grid_cloud sorted(cloud.size());
  for(std::size_t i = 0; i < cloud.size(); ++i)
    sorted[i] = cloud[order[i].second];
  cloud.swap(sorted);
}

// Of points that fill the space in different ways, of ties and of duplicates.
inline std::vector<std::pair<std::string, Grid_cloud>> clouds_of_all_kinds()
{
  Twister random(1);
  const auto any = [&](std::int32_t r) { return uniform(random, -r, r); };
  const std::size_t n = 1500;
  std::vector<std::pair<std::string, Grid_cloud>> clouds;
  const auto add = [&](const std::string& name, std::size_t size, const std::function<Grid_point(std::size_t)>& point) {
    clouds.emplace_back(name, make_cloud(size, point));
  };
  add("uniform, whole range", n, [&](std::size_t) { return Grid_point{any(limit), any(limit), any(limit), 0}; });
  add("clusters", n, [&](std::size_t i) {
    const std::int32_t c = std::int32_t(i % 7) * (limit / 8), r = 1 << (2 * (i % 7));
    return Grid_point{c + any(r), -c + any(r), any(r), 0};
  });
  for(std::int32_t step : {1, 1 << 22, 1 << 25})
    add("grid of step " + std::to_string(step), 11 * 11 * 11, [&](std::size_t i) {
      const std::int32_t c = std::int32_t(i);
      return Grid_point{(c % 11 - 5) * step, (c / 11 % 11 - 5) * step, (c / 121 - 5) * step, 0};
    });
  add("all equal", 1000, [&](std::size_t) { return Grid_point{limit, -limit, 7, 0}; });
  add("each point 20 times", 1000, [&](std::size_t i) {
    const std::int32_t c = std::int32_t(i / 20);
    return Grid_point{c * c * 1000, c * 77, -c, 0};
  });
  // Beyond 2^24 float cannot tell these apart; the integers can.
  add("far apart, equal up to one step", 600, [&](std::size_t i) {
    return Grid_point{i % 2 ? (1 << 28) + any(2) : -(1 << 28) + any(2), any(2), any(2), 0};
  });
  return clouds;
}

// check(name, cloud, k, stride) for each cloud; of the large ones, it need look at every
// stride-th point only.
template <class Check>
void on_neighbor_clouds(Check check)
{
  Twister random(3);
  for(int k : {3, 8, 12, 33, 64})
    for(int n : {0, 1, 2, 3, 7, 8, 9, k - 1, k, k + 1, k + 2, 2 * k, 65, 100}) {
      Grid_cloud cloud = make_cloud(std::size_t(n), [&](std::size_t) {
        return Grid_point{uniform(random, -50, 50), uniform(random, -50, 50), uniform(random, -2, 2), 0};
      });
      sort_along_curve(cloud);
      check("few points", cloud, k, 1);
    }
  for(auto& [name, cloud] : clouds_of_all_kinds()) {
    check(name + ", unsorted", cloud, 12, 17);
    sort_along_curve(cloud);
    for(int k : {3, 12, 20, 64})
      check(name, cloud, k, 5);
  }
  // The three points in the middle have 512 others before and 600 after them, all at
  // the same distance. Those after are in the same subtree and found first.
  for(std::int32_t distance : {1, 12345, 1 << 28})
    check("ties of subtrees",
          make_cloud(512 + 3 + 600,
                     [&](std::size_t i) {
                       return Grid_point{i < 512 ? distance : i < 515 ? 0 : -distance, 0, 0, 0};
                     }),
          12, 1);
  // A search that looks at every pair would not come to an end here.
  const std::size_t many = 100000;
  for(const bool are_equal : {true, false}) {
    Grid_cloud cloud = make_cloud(many, [&](std::size_t i) {
      const auto any = [&] { return uniform(random, -(i % 3 ? 1 << 20 : limit), i % 3 ? 1 << 20 : limit); };
      return are_equal ? Grid_point{i % 2 ? limit : -limit, 2, 1, 0} : Grid_point{any(), any(), i % 3 ? 0 : any(), 0};
    });
    sort_along_curve(cloud);
    check(are_equal ? "two equal clusters" : "a third outliers", cloud, 12, many / 20);
  }
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_NEIGHBOR_CLOUDS_H
