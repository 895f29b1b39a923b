// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals of a scan, neighbors included: Tandem's estimation, whose neighborhoods
// grow with the noise and end at edges, against CGAL's fits to 12 and 20 neighbors.

#include "micro_scan.h"

#include <CGAL/jet_estimate_normals.h>
#include <CGAL/pca_estimate_normals.h>

using namespace CGAL::Tandem::benchmark;
namespace internal = CGAL::Tandem::internal;

namespace {

#ifdef CGAL_LINKED_WITH_TBB
using Cgal_tag = CGAL::Parallel_tag;
#else
using Cgal_tag = CGAL::Sequential_tag;
#endif

template <class Backend>
void tandem_normals(benchmark::State& state)
{
  double estimation = 0;
  for(auto _ : state) {
    state.PauseTiming();
    internal::Import in = micro_import(std::size_t(state.range(0)), false);
    Backend backend;
    internal::Tandem_state<Backend> t(backend);
    CGAL::Tandem::Stage_times times;
    state.ResumeTiming();
    internal::Progress progress;
    internal::prepare(t, in, micro_parameters(), times, progress);
    estimation += times.normals;
  }
  state.counters["estimation_s"] = benchmark::Counter(estimation, benchmark::Counter::kAvgIterations);
  count_points(state);
}
TANDEM_MICRO(tandem_normals);

template <class Function>
void estimate(benchmark::State& state, Function function)
{
  Range range = micro_range(std::size_t(state.range(0)));
  for(auto _ : state)
    function(range, CGAL::parameters::point_map(Point_map()).normal_map(Normal_map()));
  count_points(state);
}

template <class Tag, unsigned k>
void cgal_pca(benchmark::State& state)
{
  estimate(state, [](Range& range, const auto& np) { CGAL::pca_estimate_normals<Tag>(range, k, np); });
}
BENCHMARK_TEMPLATE(cgal_pca, CGAL::Sequential_tag, 12)->Apply(on_points);
BENCHMARK_TEMPLATE(cgal_pca, CGAL::Sequential_tag, 20)->Apply(on_points);

template <class Tag, unsigned k>
void cgal_jet(benchmark::State& state)
{
  estimate(state, [](Range& range, const auto& np) { CGAL::jet_estimate_normals<Tag>(range, k, np); });
}
BENCHMARK_TEMPLATE(cgal_jet, CGAL::Sequential_tag, 20)->Apply(on_points);

#ifdef CGAL_LINKED_WITH_TBB
BENCHMARK_TEMPLATE(cgal_pca, CGAL::Parallel_tag, 12)->Apply(on_points);
BENCHMARK_TEMPLATE(cgal_pca, CGAL::Parallel_tag, 20)->Apply(on_points);
BENCHMARK_TEMPLATE(cgal_jet, CGAL::Parallel_tag, 20)->Apply(on_points);
#endif

} // namespace

BENCHMARK_MAIN();
