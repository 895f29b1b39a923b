// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Growth alone: what comes before the first pass, and one pass over all leaves after
// some rounds of growth and local fits without any regularity.

#include "micro_scan.h"

#include <CGAL/Tandem/internal/growth/grow_shapes.h>
#include <CGAL/Tandem/internal/shapes/update_shapes.h>

using namespace CGAL::Tandem::benchmark;
namespace internal = CGAL::Tandem::internal;

namespace {

// As after prepare().
template <class State>
void forget_shapes(State& t)
{
  t.live.clear();
  t.shapes.resize(t.backend, 0);
  t.plane.clear();
  t.rounds.clear();
  t.is_restarted.clear();
  t.assigned = 0;
  t.seed_cursor.assign(t.number_of_cells, 0);
  t.backend.for_each(t.number_of_cells, internal::Clear_lists{t.cell_shapes.data()});
  t.backend.for_each(t.cloud.size, internal::Free_all{t.labels()});
}

template <class State>
void fit_shapes(State& t)
{
  internal::refit_shapes(t);
  for(std::uint32_t id : t.live)
    t.shapes[id].plane = t.shapes[id].local;
  internal::apply_planes(t, internal::identity_targets(t));
}

// Arguments: points, rounds before.
template <class Backend>
void grow_pass(benchmark::State& state)
{
  Prepared_scan<Backend> scan(std::size_t(state.range(0)), true);
  double gained = 0;
  for(auto _ : state) {
    state.PauseTiming();
    forget_shapes(scan.state);
    for(int round = 0; round < state.range(1); ++round) {
      internal::grow_shapes(scan.state);
      fit_shapes(scan.state);
    }
    state.ResumeTiming();
    gained += double(internal::grow_shapes(scan.state));
  }
  state.counters["gained"] = benchmark::Counter(gained, benchmark::Counter::kAvgIterations);
  state.counters["shapes"] = double(scan.state.live.size());
  count_points(state);
}

// The order of the candidates of each leaf.
template <class Backend>
void order_seeds(benchmark::State& state)
{
  Prepared_scan<Backend> scan(std::size_t(state.range(0)), true);
  const auto& t = scan.state;
  for(auto _ : state) {
    auto seeds = internal::order_seeds(t.backend, t.cloud, t.cells.data(), t.number_of_cells,
                                       {t.options.growth.tolerance, t.options.tight, t.options.cell_size});
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
