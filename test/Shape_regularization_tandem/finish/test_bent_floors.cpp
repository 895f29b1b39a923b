// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bent floor is cut as the score says, and layers near each other stay apart.

#include "testing/test_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

BOOST_AUTO_TEST_SUITE(test_bent_floors)

namespace {

constexpr double epsilon = 0.01, width = 6;

// A floor, with noise; z and the slope dz/dx are functions of x in [-1, 1]. Slopes are those of the full width.
template <class Height, class Slope>
void add_floor(Cloud& cloud, std::size_t points, double noise, Height height, Slope slope)
{
  scenes::Random random(points);
  for(std::size_t i = 0; i < points; ++i) {
    const double x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1;
    const double dz = 2 / width * slope(x), length = std::sqrt(1 + dz * dz);
    cloud.emplace_back(Kernel::Point_3(x * width / 2, y * width / 2, height(x) + noise * random.gaussian()),
                       Kernel::Vector_3(-dz / length, 0, 1 / length));
  }
}

// n equal pieces of a parabola lose 4 / 45 (sag / n^2)^2 of a point each, in the mean, and the bonus for size
// mu log2(n). The floor has about as many shapes as the score is largest for: where it is cut first depends on the
// points.
void test_bent_floor(double sag)
{
  const double mu = Parameters().simplicity;
  const auto loss = [&](double n) { return 4. / 45 * std::pow(sag / (n * n), 2) + mu * std::log2(n); };
  double best = 1;
  while(loss(best + 1) < loss(best))
    ++best;
  const std::size_t clouds = 6;
  double share = 0, number = 0;
  for(std::size_t c = 0; c < clouds; ++c) {
    Cloud cloud;
    add_floor(
      cloud, 30000 + c, epsilon / 20, [&](double x) { return -sag * epsilon * x * x; },
      [&](double x) { return -2 * sag * epsilon * x; });
    const Shapes shapes = detect(cloud, make_parameters(epsilon, 200));
    number += double(shapes.number_of_shapes()) / clouds;
    if(shapes.number_of_shapes() > 0)
      share += double(shapes.points(0).size()) / double(cloud.size() * clouds);
  }
  const std::string name = "floor that sags by " + std::to_string(sag) + " epsilon, best cut into " +
                           std::to_string(int(best)) + ": " + std::to_string(number) +
                           " shapes, the largest one with " + std::to_string(share) + " of the points";
  std::puts(name.c_str());
  CHECK_AT(number <= best + 1 && share >= .95 / (best + 1), name);
}

// Two floors stay two, and each one keeps its points.
void test_layers(double distance, double noise)
{
  Cloud cloud;
  const std::size_t points = 20000;
  for(int layer : {0, 1})
    add_floor(
      cloud, points + std::size_t(layer), noise * epsilon, [&](double) { return layer * distance * epsilon; },
      [](double) { return 0.; });
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 200));
  std::map<int, std::array<std::size_t, 2>> points_of;
  for(std::size_t i = 0; i < cloud.size(); ++i)
    ++points_of[shapes.shape_index(i)][i < points ? 0 : 1];
  std::size_t right = 0;
  for(const auto& shape : points_of)
    if(shape.first >= 0)
      right += (std::max)(shape.second[0], shape.second[1]);
  CHECK_AT(right > .93 * double(cloud.size()), "layers at a distance of " + std::to_string(distance) + ": " +
                                                 std::to_string(right) + " points in shapes of their own layer");
}

// Noisy faces within epsilon of larger ones keep their points. A face is found if a shape has most of its points, and
// they are most of the shape.
void test_noisy_layers()
{
  std::size_t faces = 0, found = 0;
  for(unsigned seed : {1u, 2u, 5u}) {
    scenes::Options options = scene_options(200000, .002, .2);
    options.normals = scenes::Normals::perturbed;
    options.normal_noise_deg = 8;
    options.seed = seed;
    const scenes::Scene scene = scenes::make_scene("house", options);
    Parameters parameters = make_parameters(.2, 200);
    parameters.maximum_angle = 36.87;
    const Shapes shapes = detect(to_cloud(scene), parameters);
    std::map<std::pair<int, int>, std::size_t> common; // by face and shape
    std::map<int, std::size_t> size;
    for(std::size_t i = 0; i < scene.label.size(); ++i) {
      ++common[{scene.label[i], shapes.shape_index(i)}];
      ++size[scene.label[i]];
    }
    for(const auto& face : size)
      faces += face.first >= 0 && face.second >= parameters.minimum_region_size;
    for(const auto& c : common) {
      const auto [face, shape] = c.first;
      found += face >= 0 && shape >= 0 && size[face] >= parameters.minimum_region_size &&
               2 * c.second > (std::max)(size[face], shapes.points(shape).size());
    }
  }
  CHECK_AT(double(found) > .9 * double(faces), std::to_string(found) + " of " + std::to_string(faces) + " noisy faces");
}

} // namespace

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(double sag : {.5, 1., 2., 4.})
    test_bent_floor(sag);
  test_layers(1.3, .2);
  test_layers(2, .3);
  test_noisy_layers();
}

BOOST_AUTO_TEST_SUITE_END()
