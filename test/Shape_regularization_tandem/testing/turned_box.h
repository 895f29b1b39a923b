// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The noisy sides of a turned box in clutter, on the grid, made of integers only:
// the same points with every compiler.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_TURNED_BOX_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_TURNED_BOX_H

#include "scenes/scenes.h"

#include <CGAL/Tandem/internal/cloud/sort_along_curve.h>
#include <CGAL/Tandem/internal/base/types.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace turned_box {

using CGAL::Tandem::internal::Grid_point;
using CGAL::Tandem::internal::hilbert_code;
using CGAL::Tandem::internal::no_normal;

struct Random : CGAL::Tandem::scenes::Random {
  using CGAL::Tandem::scenes::Random::Random;

  std::int64_t below(std::int64_t n) { return std::int64_t(bits() % std::uint64_t(n)); }

  // About normal, of standard deviation sigma.
  std::int64_t noise(std::int64_t sigma)
  {
    std::int64_t sum = -6 * 65536;
    for(int i = 0; i < 12; ++i)
      sum += below(65536);
    return sum * sigma / 65536;
  }
};

// Orthogonal and of length 25, so that a scene is made of integers only.
constexpr std::int64_t axis[3][3] = {{9, 12, -20}, {-20, 15, 0}, {12, 16, 15}};

struct Item {
  Grid_point point;
  int face;      // axis of its normal; of clutter, that of the nearest side
  double height; // of clutter over that side in steps, -1 for the points of a side
};

inline Grid_point turned(const std::int64_t c[3])
{
  std::int64_t p[3];
  for(int i = 0; i < 3; ++i)
    p[i] = (c[0] * axis[0][i] + c[1] * axis[1][i] + c[2] * axis[2][i]) / 25;
  return {std::int32_t(p[0]), std::int32_t(p[1]), std::int32_t(p[2]), no_normal};
}

struct Box_options {
  int points, clutter;
  std::int64_t sigma;
};

constexpr std::int64_t box_size[3] = {60 * 1024, 40 * 1024, 24 * 1024};

// The six sides of a turned box, evenly, and clutter around it.
inline std::vector<Item> make_box(const Box_options& o)
{
  Random random(17);
  std::vector<Item> items;
  for(int i = 0; i < o.points; ++i) {
    const std::int64_t pick = random.below(60 * 40 + 60 * 24 + 40 * 24);
    const int a = pick < 40 * 24 ? 0 : pick < 40 * 24 + 60 * 24 ? 1 : 2;
    const std::int64_t side = random.below(2);
    std::int64_t c[3];
    for(int k = 0; k < 3; ++k)
      c[k] = (k == a ? side * box_size[k] : random.below(box_size[k])) + random.noise(o.sigma);
    items.push_back({turned(c), a, -1});
  }
  for(int i = 0; i < o.clutter; ++i) {
    std::int64_t c[3];
    for(int k = 0; k < 3; ++k)
      c[k] = random.below(box_size[k] + 16 * 1024) - 8 * 1024;
    Item e = {turned(c), 0, 1e9}; // far off, unless it is over a side
    for(int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      const double height = double((std::min)(std::abs(c[k]), std::abs(c[k] - box_size[k])));
      if(c[u] > 0 && c[u] < box_size[u] && c[v] > 0 && c[v] < box_size[v] && height < e.height)
        e = {e.point, k, height};
    }
    items.push_back(e);
  }
  return items;
}

inline void sort_along_curve(std::vector<Item>& items)
{
  auto code = [](const Item& e) {
    auto cell = [](std::int32_t v) { return (std::uint32_t(v) + (1u << 29)) >> 9; };
    return hilbert_code(cell(e.point.x), cell(e.point.y), cell(e.point.z));
  };
  std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) { return code(a) < code(b); });
}

} // namespace turned_box

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_TURNED_BOX_H
