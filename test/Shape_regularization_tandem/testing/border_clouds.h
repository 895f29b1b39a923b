// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clouds at the border of what there can be: equal, joined, moved and bad points, ties, hardly any points.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BORDER_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BORDER_CLOUDS_H

#include "test_support.h"

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

inline Cloud make_cloud(const std::string& scene, std::size_t points, double noise = .001, double outliers = .1)
{
  return to_cloud(scenes::make_scene(scene, scene_options(points, noise, outliers)));
}

inline Cloud repeated(std::size_t n) { return Cloud(n, {Kernel::Point_3(1, 2, 3), Kernel::Vector_3(0, 0, 1)}); }

inline Cloud joined(Cloud a, const Cloud& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Only among the first points: in blocks, those of the first rank.
inline Cloud spoiled(Cloud cloud, std::size_t n)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for(std::size_t i = 0; i < n; ++i)
    if(i % 2 == 0)
      cloud[i].first = Kernel::Point_3(0, i % 4 == 0 ? nan : infinite, 0);
    else
      cloud[i].second = Kernel::Vector_3(0, i % 3 == 0 ? nan : 0, 0);
  return cloud;
}

// One wall; if it is long, it has parts on all ranks.
inline Cloud wall(std::size_t n, double length)
{
  scenes::Random random(3);
  Cloud cloud;
  for(std::size_t i = 0; i < n; ++i)
    cloud.emplace_back(Kernel::Point_3(length * random.uniform(), .003 * random.uniform(), random.uniform()),
                       Kernel::Vector_3(.05 * random.uniform(), 1, 0));
  return cloud;
}

// Two walls of equal distances everywhere. With ten neighbors, ties decide who is one of them, and as some points have
// other normals, links count differently with other ones.
inline Cloud lattice(int n)
{
  Cloud cloud;
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < n; ++j) {
      const double other = (31 * i + 17 * j) % 11 < 3;
      cloud.emplace_back(Kernel::Point_3(i * 0x1p-6, j * 0x1p-6, 0), Kernel::Vector_3(other, other, 1));
      cloud.emplace_back(Kernel::Point_3(0, i * 0x1p-6, (j + 1) * 0x1p-6), Kernel::Vector_3(1, other, other));
    }
  return cloud;
}

// A corner of two faces on lines that are 30 times farther apart than their points, and a cable.
inline Cloud scan_lines()
{
  scenes::Random random(6);
  const auto noise = [&] { return .001 * random.gaussian(); };
  Cloud cloud;
  for(int line = 0; line < 24; ++line)
    for(int i = 0; i < 100; ++i) {
      const double y = .3 * line, along = .01 * i;
      if(i < 70)
        cloud.emplace_back(Kernel::Point_3(along, y, noise()), Kernel::Vector_3(0, 0, 1));
      cloud.emplace_back(Kernel::Point_3(noise(), y, along), Kernel::Vector_3(1, 0, 0));
    }
  for(int i = 0; i < 300; ++i)
    cloud.emplace_back(Kernel::Point_3(2 + .01 * i, 3 + noise(), 2 + noise()), Kernel::Vector_3(0, 0, 1));
  return cloud;
}

// Some have so many points for each rank.
inline std::vector<std::pair<std::string, Cloud>> border_clouds(std::size_t ranks = 1)
{
  const Cloud cube = make_cloud("cube", 1500), house = make_cloud("house", 2000);
  Cloud twice = joined(cube, cube), line;
  shuffle(twice, 1);
  for(int i = 0; i < 2000; ++i)
    line.emplace_back(Kernel::Point_3(.001 * i, .002 * i, -.003 * i), Kernel::Vector_3(2, -1, 0));
  return {{"a lattice", lattice(30)},
          {"nothing", {}},
          {"a point", repeated(1)},
          {"equal points", repeated(700)},
          {"two points for each rank", make_cloud("cube", 2 * ranks)},
          {"a house", house},
          {"a leaf for each rank", make_cloud("cube", 60 * ranks)},
          {"duplicates in order", joined(cube, cube)},
          {"duplicates anywhere", twice},
          {"close twins", joined(cube, transformed(cube, 1, {1e-9, 0, 0}))},
          {"a wall", wall(3000, 30)},
          {"a strip", wall(2000, 3000)},
          {"a line", line},
          {"scan lines", scan_lines()},
          {"two places", joined(cube, transformed(cube, 1, {900, -400, 200}))},
          {"a far point", joined(cube, transformed(repeated(1), 1, {30000, 0, 0}))},
          {"a huge offset", transformed(cube, 1, {4e6, -5e6, 300})},
          {"bad points on one rank", spoiled(cube, cube.size() / ranks)},
          {"nothing but bad points", spoiled(cube, cube.size())},
          {"fewer than a shape needs", make_cloud("cube", 20)}};
}

// Fails at one of the points, if it is not null.
struct Failing_map {
  using key_type = Cloud::value_type;
  using value_type = Kernel::Point_3;
  using reference = const value_type&;
  using category = boost::readable_property_map_tag;

  friend reference get(const Failing_map& map, const key_type& item)
  {
    if(&item == map.failing)
      map.fail();
    return item.first;
  }

  const key_type* failing;
  std::function<void()> fail;
};

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BORDER_CLOUDS_H
