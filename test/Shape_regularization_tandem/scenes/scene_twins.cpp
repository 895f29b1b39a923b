// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scene_twins.h"

namespace CGAL::Tandem::scenes {

const std::vector<Twin>& twins()
{
  static const std::vector<Twin> all = {
    {"terrestrial", make_house, {0.003, 0, 0, 0.002, 0, 1}, 0.01, true, 0.03, 25.842, 0.1, 3e-4},
    {"kinect", make_study, {0.003, 2, 0.0028, 0.006, 0, 1}, 0.01, true, 0.03, 36.87, 0.1, 7e-4},
    {"street", make_street, {0.008, 0, 0, 0.01, 0, 1}, 0.02, true, 0.06, 36.87, 0.3, 4e-4},
    {"aerial", make_village, {0.03, 0, 0, 0, 0, 1}, 0.03, false, 0.15, 25.842, 1, 3e-4},
    {"multiview", make_tower, {0.006, 0, 0, 0, 0.015, 0.4}, 0.01, true, 0.03, 36.87, 0.1, 3e-4},
    {"mechanical", make_part, {}, 0, false, 0.02, 25.842, 0.1, 7e-4},
    {"curved", make_curved, {0.003, 0, 0, 0, 0, 1}, 0, false, 0.03, 25.842, 0.2, 5e-4}};
  return all;
}

const Twin& twin(const std::string& name)
{
  for(const Twin& t : twins())
    if(t.name == name)
      return t;
  throw std::invalid_argument("unknown twin: " + name);
}

namespace {

// Smooth noise in [-1, 1]^3 with a period of about 2: random vectors on a grid, interpolated.
Vec smooth_noise(const Vec& p, std::uint64_t seed)
{
  auto corner = [&](double x, double y, double z) {
    auto bits = [](double c) { return std::uint64_t(std::int64_t(c)); };
    Random random(seed ^ (bits(x) * 0x9e3779b97f4a7c15u) ^ (bits(y) * 0xc2b2ae3d27d4eb4fu) ^
                  (bits(z) * 0x165667b19e3779f9u));
    double a = random.uniform(), b = random.uniform(), c = random.uniform();
    return Vec{2 * a - 1, 2 * b - 1, 2 * c - 1};
  };
  Vec low{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, t = p - low, sum{0, 0, 0};
  auto smooth = [](double s) { return s * s * std::fma(-2, s, 3.0); };
  Vec w{smooth(t.x), smooth(t.y), smooth(t.z)};
  for(int i = 0; i < 8; ++i) {
    bool x = i & 1, y = i & 2, z = i & 4;
    double weight = (x ? w.x : 1 - w.x) * (y ? w.y : 1 - w.y) * (z ? w.z : 1 - w.z);
    sum = add_scaled(sum, weight, corner(low.x + x, low.y + y, low.z + z));
  }
  return sum;
}

// The range as the sensor reports it.
double measured_range(double range, const Sensor_errors& sensor, Random& random)
{
  double sigma = sensor.range_noise;
  for(int i = 0; i < sensor.range_power; ++i)
    sigma *= range;
  double measured = std::fma(sigma, random.gaussian(), range), step = sensor.depth_step * range * range;
  return step > 0 ? step * std::floor(measured / step + 0.5) : measured;
}

void apply_errors(const Sensor_errors& sensor, const std::vector<Vec>& scanners, std::uint64_t seed, Scene& scene)
{
  Random random(seed ^ 0x73656e736f72u);
  std::vector<Vec> offset;
  for(std::size_t s = 0; s < scanners.size(); ++s)
    offset.push_back(sensor.registration * random.gaussian_vector());
  for(Vec& p : scene.points) {
    const auto squared = [&](const Vec& s) { return dot(s - p, s - p); };
    const auto nearest = std::min_element(scanners.begin(), scanners.end(),
                                          [&](const Vec& a, const Vec& b) { return squared(a) < squared(b); });
    const Vec ray = p - *nearest,
              rough = sensor.roughness > 0 ? smooth_noise((2 / sensor.wavelength) * p, seed) : Vec{0, 0, 0};
    const double range = length(ray);
    p = add_scaled(*nearest, measured_range(range, sensor, random) / range, ray) +
        offset[std::size_t(nearest - scanners.begin())];
    p = add_scaled(p, sensor.roughness, rough);
  }
}

} // namespace

Scene make_twin(const Twin& twin, std::size_t points, std::uint64_t seed)
{
  Model model = twin.model();
  Scene scene = make_scene(model, {points, 0, twin.outliers, twin.varies_density, Normals::none, 0, seed});
  apply_errors(twin.sensor, model.scanners, seed, scene);
  return scene;
}

} // namespace CGAL::Tandem::scenes
