// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Few points that are too far for the grid are left free and counted, and the others have the shapes that they have
// alone. Where they are many the cloud is refused: see test_bad_input.

#include "testing/test_support.h"

#include <CGAL/Tandem/internal/cloud/far_points.h>

#include <algorithm>

BOOST_AUTO_TEST_SUITE(test_far_points)

using namespace CGAL::Tandem::internal;

// Against a sort.
BOOST_AUTO_TEST_CASE(quantiles)
{
  Sequential_backend backend;
  const Ranks<Sequential_backend> ranks(backend);
  scenes::Random random(3);
  for(std::size_t n = 1; n < 40; ++n) {
    std::vector<double> values;
    for(std::size_t i = 0; i < n; ++i)
      values.push_back(i % 4 == 0 ? std::round(4 * random.gaussian()) : std::ldexp(random.gaussian(), int(i)));
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for(const tuning::Ratio& ratio : {tuning::Ratio{1, 2}, tuning::Ratio{99, 100}, tuning::Ratio{0, 1}})
      check_equal(quantile_of_all(
                    ranks, n, [&](std::size_t i) { return values[i]; }, ratio),
                  sorted[std::size_t(ratio.of(std::int64_t(n)))], std::to_string(n) + " values");
  }
}

void check_far_points(std::size_t number, const Kernel::Point_3& where)
{
  const std::string name = std::to_string(number) + " far points";
  const Parameters parameters = make_parameters(.02, 60);
  Cloud cloud = transformed(to_cloud(scenes::make_scene("house", scene_options(8000))), 1, {694386.25, 5155487.5, 380});
  const Shapes alone = detect(cloud, parameters);
  for(std::size_t i = 0; i < number; ++i)
    cloud.insert(cloud.begin() + std::ptrdiff_t(i * 90), {where, Kernel::Vector_3(0, 0, 1)});
  for(const Given given : {Given::normals, Given::nothing}) {
    const Shapes shapes = detect_valid(name, cloud, parameters, given);
    check_equal(shapes.statistics().number_of_far_points, number, name);
    check_equal(shapes.statistics().number_of_ignored_points(), number, name + ": ignored");
    for(std::size_t i = 0; i < number; ++i)
      check_equal(shapes.shape_index(i * 90), -1, name);
    if(given == Given::normals)
      check_same_planes(shapes, alone, name);
  }
}

BOOST_AUTO_TEST_CASE(few_far_points)
{
  check_far_points(20, {0, 0, 0});
  check_far_points(3, {1e12, -1e9, 1e11});
}

BOOST_AUTO_TEST_SUITE_END()
