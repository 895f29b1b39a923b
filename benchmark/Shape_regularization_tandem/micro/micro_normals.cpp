// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals of a scan, neighbors included: Tandem's estimation, whose neighborhoods
// grow with the noise and end at edges, against CGAL's fits to 12 and 20 neighbors.

#include "micro_scan.h"

#include <CGAL/Shape_regularization_tandem.h>

#include <CGAL/jet_estimate_normals.h>
#include <CGAL/pca_estimate_normals.h>

using namespace CGAL::Tandem::benchmark;

namespace {

#ifdef CGAL_LINKED_WITH_TBB
using Cgal_tag = CGAL::Parallel_tag;
#else
using Cgal_tag = CGAL::Sequential_tag;
#endif

// What comes before the first round, of points without normals.
template <class Tag>
void tandem_normals(benchmark::State& state)
{
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Range, Point_map, CGAL::Default, Tag>;
  const Range range = micro_range(std::size_t(state.range(0)));
  const auto np = CGAL::Tandem::parameters::settings(micro_parameters()).point_map(Point_map());
  double estimation = 0;
  for(auto _ : state) {
    const CGAL::Tandem::Planar_shape_detection_3<Traits> detection(range, np);
    state.PauseTiming();
    estimation += detection.shapes().statistics().times.normals;
    state.ResumeTiming();
  }
  state.counters["estimation_s"] = benchmark::Counter(estimation, benchmark::Counter::kAvgIterations);
  count_points(state);
}
BENCHMARK_TEMPLATE(tandem_normals, CGAL::Sequential_tag)->Apply(on_points);
#ifdef CGAL_LINKED_WITH_TBB
BENCHMARK_TEMPLATE(tandem_normals, CGAL::Parallel_tag)->Apply(on_points);
#endif

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
