// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The regularity step: shapes of sixteen turned houses whose normals lean by
// about a degree.

#include "testing/scenes.h"

#include <CGAL/Tandem/internal/regularity/regularize.h>

#include <benchmark/benchmark.h>

using namespace CGAL::Tandem::internal;
namespace scenes = CGAL::Tandem::scenes;

namespace {

constexpr double maximum_distance = 1000; // in grid steps
constexpr double angle_tolerance_deg = 8;

Vector as_vector(const scenes::Vec& v) { return {v.x, v.y, v.z}; }

// A rectangle of points, 40 epsilons wide, with noise.
Shape_fit make_shape(const scenes::Frame& house, int axis, scenes::Random& random)
{
  const scenes::Vec axes[3] = {house.x, house.y, house.z};
  const scenes::Vec n = scenes::unit(axes[axis] + 0.015 * random.gaussian_vector());
  const scenes::Vec u = scenes::unit(scenes::cross(n, axes[(axis + 1) % 3])), v = scenes::cross(n, u);
  const double count = 200 + 2000 * random.uniform(), width = 40 * maximum_distance, noise = 0.3 * maximum_distance;
  auto entry = [&](double scenes::Vec::*a, double scenes::Vec::*b) {
    return count * (noise * noise * (n.*a) * (n.*b) + width * width / 12 * ((u.*a) * (u.*b) + (v.*a) * (v.*b)));
  };
  Shape_fit s;
  s.scatter.count = count;
  s.scatter.centroid = as_vector(300 * maximum_distance * random.gaussian_vector());
  s.scatter.matrix = {entry(&scenes::Vec::x, &scenes::Vec::x), entry(&scenes::Vec::x, &scenes::Vec::y),
                      entry(&scenes::Vec::x, &scenes::Vec::z), entry(&scenes::Vec::y, &scenes::Vec::y),
                      entry(&scenes::Vec::y, &scenes::Vec::z), entry(&scenes::Vec::z, &scenes::Vec::z)};
  s.fit = fit_plane(s.scatter);
  return s;
}

Shape_fits make_shapes(std::size_t n)
{
  scenes::Random random(7);
  std::vector<scenes::Frame> houses;
  for(int h = 0; h < 16; ++h)
    houses.push_back(scenes::Frame().turned({0, 0, 1}, 0.06 * h));
  Shape_fits shapes;
  for(std::size_t i = 0; i < n; ++i)
    shapes.push_back(make_shape(houses[random.bits() % 16], int(random.bits() % 3), random));
  return shapes;
}

Regularity_options options()
{
  Regularity_options o;
  o.angle_tolerance_deg = angle_tolerance_deg;
  o.maximum_offset = o.maximum_distance = maximum_distance;
  o.freedom = {10, .01}; // for shapes of at least 100 points
  return o;
}

std::vector<int> all_of(const Shape_fits& shapes)
{
  std::vector<int> all(shapes.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void unite_directions(benchmark::State& state)
{
  const Shape_fits shapes = make_shapes(std::size_t(state.range(0)));
  const Regularity_options o = options();
  std::size_t groups = 0;
  for(auto _ : state)
    groups = Parallel_groups(shapes, o)(all_of(shapes)).size();
  state.counters["groups"] = double(groups);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// Frames and constrained fits of the groups.
void fit_directions(benchmark::State& state)
{
  const Shape_fits shapes = make_shapes(std::size_t(state.range(0)));
  const Regularity_options o = options();
  const std::vector<Direction_group> united = Parallel_groups(shapes, o)(all_of(shapes));
  for(auto _ : state) {
    std::vector<Direction_group> groups = united;
    set_directions(groups, o);
    benchmark::DoNotOptimize(groups.data());
  }
  state.counters["groups"] = double(united.size());
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// All of it, with the coplanar groups.
void regularize_all(benchmark::State& state)
{
  const Shape_fits shapes = make_shapes(std::size_t(state.range(0)));
  const std::vector<char> is_excluded(shapes.size(), 0);
  std::size_t directions = 0;
  for(auto _ : state)
    directions = regularize(shapes, is_excluded, options()).directions.size();
  state.counters["directions"] = double(directions);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void on_shapes(benchmark::internal::Benchmark* b)
{
  b->RangeMultiplier(10)->Range(100, 10000)->Unit(benchmark::kMicrosecond);
}
BENCHMARK(unite_directions)->Apply(on_shapes);
BENCHMARK(fit_directions)->Apply(on_shapes);
BENCHMARK(regularize_all)->Apply(on_shapes);

// Fits of single shapes.
template <class Function>
void for_all_fits(benchmark::State& state, Function function)
{
  const Shape_fits shapes = make_shapes(256);
  std::size_t i = 0;
  for(auto _ : state) {
    benchmark::DoNotOptimize(function(shapes[i % 256], shapes[(i + 1) % 256]));
    ++i;
  }
}

void fit_free(benchmark::State& state)
{
  for_all_fits(state, [](const Shape_fit& a, const Shape_fit&) { return fit_plane(a.scatter); });
}
BENCHMARK(fit_free);

void fit_at_right_angle(benchmark::State& state)
{
  for_all_fits(state, [](const Shape_fit& a, const Shape_fit& b) {
    return fit_orthogonal(a.scatter.matrix, b.fit.normal, a.fit.normal);
  });
}
BENCHMARK(fit_at_right_angle);

void fit_two_in_frame(benchmark::State& state)
{
  const Vector up = {0, 0, 1};
  for_all_fits(state, [&](const Shape_fit& a, const Shape_fit& b) {
    return fit_frame(a.scatter.matrix, b.scatter.matrix, up, a.fit.normal);
  });
}
BENCHMARK(fit_two_in_frame);

} // namespace

BENCHMARK_MAIN();
