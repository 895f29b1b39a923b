// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the micro-benchmarks share: one generated scan, as CGAL sees it and as the
// engine does. Sixteen turned houses, noise of a third of epsilon, 5 % outliers.

#ifndef CGAL_TANDEM_BENCHMARK_MICRO_SCAN_H
#define CGAL_TANDEM_BENCHMARK_MICRO_SCAN_H

#include "testing/scenes.h"

#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/engine/prepare.h>
#include <CGAL/Tandem/internal/backend/Sequential_backend.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/property_map.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <CGAL/Tandem/internal/backend/Tbb_backend.h>
#endif

#include <benchmark/benchmark.h>

#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace benchmark {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Range = std::vector<Point_with_normal>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;

constexpr int k_neighbors = 12;
constexpr double epsilon = 0.12;

inline Parameters micro_parameters()
{
  Parameters p;
  p.maximum_distance = p.maximum_offset = epsilon;
  p.minimum_region_size = 200;
  p.k_neighbors = k_neighbors;
  return p;
}

// Made once for each size.
inline const scenes::Scene& micro_scene(std::size_t points)
{
  static std::map<std::size_t, scenes::Scene> made;
  auto at = made.find(points);
  if(at == made.end()) {
    scenes::Options o;
    o.points = points;
    o.noise = 0.0003;
    o.outliers = 0.05;
    o.normals = scenes::Normals::perturbed;
    at = made.emplace(points, scenes::make_scene("village", o)).first;
  }
  return at->second;
}

inline Range micro_range(std::size_t points)
{
  Range range;
  const scenes::Scene& scene = micro_scene(points);
  for(std::size_t i = 0; i < scene.points.size(); ++i) {
    const scenes::Vec &p = scene.points[i], &n = scene.normals[i];
    range.emplace_back(Kernel::Point_3(p.x, p.y, p.z), Kernel::Vector_3(n.x, n.y, n.z));
  }
  return range;
}

// On the grid, in the order of the scene.
inline internal::Import micro_import(std::size_t points, bool has_normals)
{
  const scenes::Scene& scene = micro_scene(points);
  internal::Import in;
  internal::start_import<double>(in, scene.points.size(), has_normals);
  for(std::size_t i = 0; i < in.count; ++i) {
    const double p[3] = {scene.points[i].x, scene.points[i].y, scene.points[i].z};
    const double n[3] = {scene.normals[i].x, scene.normals[i].y, scene.normals[i].z};
    std::copy(p, p + 3, in.coordinates.data<double>() + 3 * i);
    if(has_normals)
      std::copy(n, n + 3, in.normals.data<double>() + 3 * i);
    in.box.add(in.position(i));
  }
  internal::Sequential_backend backend;
  internal::put_on_grid(backend, in, epsilon);
  return in;
}

// Before the first round of the engine.
template <class Backend>
struct Prepared_scan {
  Backend backend;
  internal::Import in;
  internal::Tandem_state<Backend> state;
  Stage_times times;
  Work work;

  Prepared_scan(std::size_t size, bool has_normals) : in(micro_import(size, has_normals)), state(backend)
  {
    internal::Progress progress;
    internal::prepare(state, in, micro_parameters(), {times, work}, progress);
  }
};

// Items are points; wall time, since other threads work, too.
inline void on_points(::benchmark::internal::Benchmark* b)
{
  b->Arg(100000)->Arg(1000000)->Unit(::benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

inline void count_points(::benchmark::State& state) { state.SetItemsProcessed(state.iterations() * state.range(0)); }

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#ifdef CGAL_LINKED_WITH_TBB
#define TANDEM_MICRO(function)                                                                                         \
  BENCHMARK_TEMPLATE(function, CGAL::Tandem::internal::Sequential_backend)->Apply(on_points);                          \
  BENCHMARK_TEMPLATE(function, CGAL::Tandem::internal::Tbb_backend)->Apply(on_points)
#else
#define TANDEM_MICRO(function)                                                                                         \
  BENCHMARK_TEMPLATE(function, CGAL::Tandem::internal::Sequential_backend)->Apply(on_points)
#endif

#endif // CGAL_TANDEM_BENCHMARK_MICRO_SCAN_H
