// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// n x n copies of a scene, side by side, have n x n times the shapes of one, however
// the octree cuts them; far copies do not feel each other at all.

#include "testing/test_support.h"

BOOST_AUTO_TEST_SUITE(test_scaling)

Cloud copies(const Cloud& one, int n, double pitch)
{
  Cloud all;
  all.reserve(one.size() * std::size_t(n * n));
  for(int x = 0; x < n; ++x)
    for(int y = 0; y < n; ++y)
      for(const auto& item : one)
        all.emplace_back(item.first + Kernel::Vector_3(pitch * x, pitch * y, 0), item.second);
  return all;
}

// The copies lie along the axes, so many of their faces share a plane.
void test_copies(const std::string& name, const scenes::Options& options, double epsilon, std::size_t directions,
                 int most)
{
  const scenes::Scene scene = scenes::make_scene(name, options);
  const Cloud one = to_cloud(scene);
  const Parameters parameters = make_parameters(epsilon, 60);
  const std::size_t shapes_of_one = detect_valid(name, one, parameters).number_of_shapes();
  CHECK_AT(shapes_of_one >= 6, name);
  for(int n = 2; n <= most; ++n) {
    const std::string full = name + ", " + std::to_string(n) + " x " + std::to_string(n);
    const Shapes shapes = detect_valid(full, copies(one, n, 1.5 * scene.diagonal), parameters);
    check_equal(shapes.number_of_shapes(), shapes_of_one * std::size_t(n * n), full + ": number of shapes");
    check_equal(shapes.number_of_parallel_groups(), directions, full + ": number of directions");
    std::cout << full << ": " << shapes.number_of_points() << " points, " << shapes.number_of_shapes() << " shapes, "
              << shapes.number_of_coplanar_groups() << " planes" << std::endl;
  }
}

// A cube that is turned about the vertical: top and bottom of all copies are two planes.
void test_cubes()
{
  const scenes::Scene scene =
    scenes::make_scene(scenes::make_cube(scenes::Frame().turned({0, 0, 1}, .2)), scene_options(3000, .0005));
  for(int n : {1, 2, 4, 7}) {
    const std::string name = std::to_string(n * n) + " cubes";
    const Shapes shapes = detect_valid(name, copies(to_cloud(scene), n, 2.3), make_parameters(.006, 60));
    // No two walls are in one plane, for the pitch is not that of the direction of the walls.
    // Across 49 cubes the common direction is not as precise as the offsets, and a plane costs more than it is worth.
    check_counts(name, shapes, std::size_t(6 * n * n), 3, std::size_t(4 * n * n + (n < 7 ? 2 : 4)));
  }
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_cubes();
  test_copies("staircase", scene_options(6000, .0003), .006, 2, 3);
  test_copies("cube", scene_options(3000), .005, 3, 5);
}

BOOST_AUTO_TEST_SUITE_END()
