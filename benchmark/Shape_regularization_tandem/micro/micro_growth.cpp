// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Growth alone: what comes before the first pass, and one pass over all cells after
// some rounds of growth and local fits without any regularity.

#include "micro_scan.h"

#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

using namespace CGAL::Tandem::benchmark;
namespace internal = CGAL::Tandem::internal;

namespace {

// As after prepare().
template <class State>
void clear_shapes(State& t)
{
  t.shapes = {};
  t.points.backend.for_each(t.seeds.cursor.size(), internal::Fill<std::uint32_t>{t.seeds.cursor.data(), 0});
  internal::clear_labels(t.points);
}

template <class State>
void fit_shapes(State& t)
{
  internal::require(t.points, t.shapes, internal::tables::fits);
  for(internal::Shape& shape : t.shapes.table())
    shape.plane = shape.local;
  internal::apply_planes(t.points, t.shapes, t.options, internal::identity_targets(t.points.backend, t.shapes.size));
}

template <class State>
std::size_t grow_shapes(State& t)
{
  return internal::grow_shapes(t.points, t.shapes, t.seeds, t.options.growth);
}

// Arguments: points, rounds before.
template <class Backend>
void grow_pass(benchmark::State& state)
{
  Prepared_scan<Backend> scan(std::size_t(state.range(0)), true);
  double gained = 0;
  for(auto _ : state) {
    state.PauseTiming();
    clear_shapes(scan.state);
    for(int round = 0; round < state.range(1); ++round) {
      grow_shapes(scan.state);
      fit_shapes(scan.state);
    }
    state.ResumeTiming();
    gained += double(grow_shapes(scan.state));
  }
  state.counters["gained"] = benchmark::Counter(gained, benchmark::Counter::kAvgIterations);
  state.counters["shapes"] = double(internal::count_live(scan.backend, scan.state.shapes).shapes);
  count_points(state);
}

// The order of the candidates of each cell.
template <class Backend>
void order_seeds(benchmark::State& state)
{
  Prepared_scan<Backend> scan(std::size_t(state.range(0)), true);
  auto& t = scan.state;
  for(auto _ : state) {
    auto seeds =
      internal::order_seeds(t.points, {t.options.growth.tolerance, t.options.tight, t.options.growth.cell_size});
    benchmark::DoNotOptimize(seeds.seed.data());
  }
  count_points(state);
}
TANDEM_MICRO(order_seeds);

void on_rounds(benchmark::internal::Benchmark* b)
{
  b->ArgsProduct({{100000, 1000000}, {0, 1, 4, 16}})->ArgNames({"points", "rounds"});
  b->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK_TEMPLATE(grow_pass, internal::Sequential_backend)->Apply(on_rounds);
#ifdef CGAL_LINKED_WITH_TBB
BENCHMARK_TEMPLATE(grow_pass, internal::Tbb_backend)->Apply(on_rounds);
#endif

} // namespace

BENCHMARK_MAIN();
