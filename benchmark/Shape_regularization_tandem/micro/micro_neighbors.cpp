// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The 12 nearest neighbors of all points of a scan, with what each method needs
// before its first query: Tandem's exact search on the grid against the kd-tree of
// CGAL, the query of region growing, and nanoflann.

#include "micro_scan.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR < 1050600000
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#else
#include <CGAL/Shape_detection/Region_growing/Point_set.h>
#endif

#ifdef TANDEM_MICRO_NANOFLANN
#include <nanoflann.hpp>
#endif

#include <memory>
#include <numeric>

using namespace CGAL::Tandem::benchmark;
namespace internal = CGAL::Tandem::internal;

namespace {

// The order along the curve, which the search needs, is part of it.
template <class Backend>
void tandem_neighbors(benchmark::State& state)
{
  const internal::Import in = micro_import(std::size_t(state.range(0)), true);
  Backend backend;
  for(auto _ : state) {
    const internal::Code_frame frame = internal::make_code_frame(in.point.data(), in.size());
    const auto order = internal::sort_along_curve(backend, {in.point.data(), in.size()}, frame);
    typename Backend::template Buffer<internal::Grid_point> sorted(in.size());
    backend.for_each(in.size(), [&](std::size_t i) { sorted[i] = in.point[order.view().index(i)]; });
    typename Backend::template Buffer<std::uint32_t> rows(in.size() * k_neighbors);
    internal::find_neighbors(backend, sorted.data(), std::uint32_t(in.size()), k_neighbors, rows.data());
    benchmark::DoNotOptimize(rows.data());
  }
  count_points(state);
}
TANDEM_MICRO(tandem_neighbors);

class Position_map {
public:
  using key_type = std::size_t;
  using value_type = Kernel::Point_3;
  using reference = const value_type&;
  using category = boost::readable_property_map_tag;

  explicit Position_map(const Range& range) : range_(&range) {}
  const value_type& operator[](std::size_t i) const { return (*range_)[i].first; }
  friend const value_type& get(const Position_map& map, std::size_t i) { return map[i]; }

private:
  const Range* range_;
};

void cgal_kd_tree(benchmark::State& state)
{
  using Traits = CGAL::Search_traits_adapter<std::size_t, Position_map, CGAL::Search_traits_3<Kernel>>;
  using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
  const Range range = micro_range(std::size_t(state.range(0)));
  const Traits traits{Position_map(range)};
  std::vector<std::size_t> position(range.size());
  std::iota(position.begin(), position.end(), std::size_t(0));
  std::vector<std::uint32_t> rows(range.size() * k_neighbors);
  for(auto _ : state) {
    typename Search::Tree tree(position.begin(), position.end(), typename Search::Splitter(), traits);
    tree.build();
    const typename Search::Distance distance{Position_map(range)};
    for(std::size_t i = 0; i < range.size(); ++i) {
      std::size_t at = i * k_neighbors;
      for(const auto& found : Search(tree, range[i].first, k_neighbors + 1, 0, true, distance))
        if(found.first != i && at < (i + 1) * k_neighbors)
          rows[at++] = std::uint32_t(found.first);
    }
    benchmark::DoNotOptimize(rows.data());
  }
  count_points(state);
}
BENCHMARK(cgal_kd_tree)->Apply(on_points);

namespace on_point_sets = CGAL::Shape_detection::Point_set;

// The interface of region growing changed with CGAL 5.6: items were positions, they are iterators.
#if CGAL_VERSION_NR < 1050600000

using Item = std::size_t;
using Neighbor_query = on_point_sets::K_neighbor_query<Kernel, Range, Point_map>;

Neighbor_query make_query(const Range& range) { return Neighbor_query(range, k_neighbors + 1); }
Item item_at(const Range&, std::size_t i) { return i; }

#else

using Item = Range::const_iterator;

struct Item_map {
  using key_type = Item;
  using value_type = Kernel::Point_3;
  using reference = const value_type&;
  using category = boost::readable_property_map_tag;

  friend reference get(const Item_map&, const Item& item) { return item->first; }
};

using Neighbor_query = on_point_sets::K_neighbor_query<Kernel, Item, Item_map>;

Neighbor_query make_query(const Range& range)
{
  return Neighbor_query(range, CGAL::parameters::k_neighbors(k_neighbors + 1).point_map(Item_map()));
}
Item item_at(const Range& range, std::size_t i) { return range.begin() + std::ptrdiff_t(i); }

#endif

// Among the points that it returns is the query point itself.
void cgal_neighbor_query(benchmark::State& state)
{
  const Range range = micro_range(std::size_t(state.range(0)));
  std::size_t sum = 0;
  for(auto _ : state) {
    const Neighbor_query query = make_query(range);
    std::vector<Item> row;
    for(std::size_t i = 0; i < range.size(); ++i) {
      row.clear();
      query(item_at(range, i), row);
      sum += row.size();
    }
  }
  benchmark::DoNotOptimize(sum);
  count_points(state);
}
BENCHMARK(cgal_neighbor_query)->Apply(on_points);

#ifdef TANDEM_MICRO_NANOFLANN

struct Flann_cloud {
  const std::vector<CGAL::Tandem::scenes::Vec>& points;

  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const
  {
    return axis == 0 ? points[i].x : axis == 1 ? points[i].y : points[i].z;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const
  {
    return false;
  }
};

void nanoflann_kd_tree(benchmark::State& state)
{
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Flann_cloud>, Flann_cloud, 3,
                                                   std::uint32_t>;
  const Flann_cloud cloud = {micro_scene(std::size_t(state.range(0))).points};
  std::vector<std::uint32_t> rows(cloud.points.size() * k_neighbors);
  for(auto _ : state) {
    Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    std::uint32_t found[k_neighbors + 1];
    double squared[k_neighbors + 1];
    for(std::size_t i = 0; i < cloud.points.size(); ++i) {
      tree.knnSearch(&cloud.points[i].x, k_neighbors + 1, found, squared);
      std::copy(found + 1, found + k_neighbors + 1, rows.data() + i * k_neighbors);
    }
    benchmark::DoNotOptimize(rows.data());
  }
  count_points(state);
}
BENCHMARK(nanoflann_kd_tree)->Apply(on_points);

#endif

} // namespace

BENCHMARK_MAIN();
