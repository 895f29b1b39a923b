// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tolerances of points follow the noise about them, smoothly, and neither the order of the points nor the back end.

#include "testing/checks.h"
#include "testing/noisy_clouds.h"

#include <CGAL/Shape_regularization_tandem/estimate_local_distances.h>
#include <CGAL/Shape_regularization_tandem/estimate_noise.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <array>
#include <numeric>
#include <string>

BOOST_AUTO_TEST_SUITE(test_local_distances)

using namespace noisy_clouds;
using CGAL::Tandem::estimate_local_distances;

double distance_of(const Points& points) { return CGAL::Tandem::estimate_parameters(points).maximum_distance; }

// A corridor and its tolerances, in units of the true noise.
struct Measured_corridor {
  Corridor corridor;
  std::vector<double> ratio;

  Measured_corridor(int width, int height, Random& random)
    : corridor(width, height, 5, random), ratio(estimate_local_distances(corridor.points))
  {
    const double per_noise = CGAL::Tandem::internal::tuning::estimation::local_margin * distance_of(corridor.points) /
                             CGAL::Tandem::estimate_noise(corridor.points);
    for(std::size_t i = 0; i < ratio.size(); ++i)
      ratio[i] /= per_noise * corridor.noise[i];
  }

  // Mean and mean absolute error of the points that are chosen.
  template <class F>
  std::array<double, 2> compare(F is_chosen) const
  {
    double sum = 0, error = 0, count = 0;
    for(std::size_t i = 0; i < ratio.size(); ++i)
      if(is_chosen(i)) {
        sum += ratio[i];
        error += std::fabs(ratio[i] - 1);
        ++count;
      }
    return {sum / count, error / count};
  }
};

BOOST_AUTO_TEST_CASE(test_corridor)
{
  for(unsigned seed = 1; seed <= 2; ++seed) {
    Random random(seed);
    const Measured_corridor measured(seed == 1 ? 200 : 240, seed == 1 ? 150 : 180, random);
    const Corridor& corridor = measured.corridor;
    const auto depth = [&](std::size_t i) { return corridor.points[i].z(); };
    for(const double z : {2.2, 2.6, 3., 3.4, 3.8}) {
      const auto [mean, error] = measured.compare([&](std::size_t i) { return depth(i) >= z && depth(i) < z + .4; });
      CHECK_AT(mean > .85 && mean < 1.15 && error < .15,
               std::to_string(z) + ": " + std::to_string(mean) + ", " + std::to_string(error));
    }
    const auto is_inner = [&](std::size_t i) {
      return corridor.is_end[i] && std::fabs(corridor.points[i].x()) < .8 && std::fabs(corridor.points[i].y()) < .8;
    };
    const auto [mean, error] = measured.compare(is_inner);
    CHECK_AT(mean > .75 && mean < 1.25, "end wall: " + std::to_string(mean) + ", " + std::to_string(error));
  }
}

// Where the noise is the same everywhere, so are the tolerances, and they are that of the cloud.
BOOST_AUTO_TEST_CASE(test_even_noise)
{
  Random random(3);
  const Points points = Pose(3, 100)(room(12000, .004, random));
  const double distance = distance_of(points);
  for(const double d : estimate_local_distances(points))
    CHECK_AT(d > .7 * distance && d < 1.3 * distance, std::to_string(d / distance));
}

// The values of the points, and not their order, count.
BOOST_AUTO_TEST_CASE(test_order)
{
  Random random(4);
  const Corridor corridor(80, 60, 5, random);
  const std::vector<double> distance = estimate_local_distances(corridor.points);
  CHECK(estimate_local_distances<CGAL::Sequential_tag>(corridor.points) == distance);
  std::vector<std::size_t> order(distance.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::mt19937 engine(5);
  std::shuffle(order.begin(), order.end(), engine);
  Points shuffled;
  for(const std::size_t i : order)
    shuffled.push_back(corridor.points[i]);
  const std::vector<double> again = estimate_local_distances(shuffled);
  for(std::size_t i = 0; i < order.size(); ++i)
    CHECK(again[i] == distance[order[i]]);
}

BOOST_AUTO_TEST_CASE(test_degenerate)
{
  CHECK(estimate_local_distances(Points()).empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto distance = estimate_local_distances(Points{{0, 0, 0}, {nan, 0, 0}, {1, 0, 0}});
  CHECK(distance.size() == 3 && distance[0] > 0 && std::isnan(distance[1]) && distance[2] == distance[0]);
  for(const double d : estimate_local_distances(Points(50, {1, 2, 3})))
    CHECK(d > 0);
  // Without noise all have the same.
  Random random(6);
  const Points points = room(3000, 0, random);
  const double estimate = distance_of(points);
  for(const double d : estimate_local_distances(points))
    CHECK(d == estimate);
}

BOOST_AUTO_TEST_SUITE_END()
