// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's region growing of planes, as its manual has it, behind one function for
// both of its interfaces: that until 5.5 and that from 5.6 on.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_REGION_GROWING_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_REGION_GROWING_H

#include "Contestant.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/property_map.h>
#include <CGAL/version.h>

#if CGAL_VERSION_NR >= 1050600000
#define CGAL_TANDEM_HAS_ITEMS_IN_REGION_GROWING
#include <CGAL/Shape_detection/Region_growing/Point_set.h>
#else
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#endif

namespace CGAL {
namespace Tandem {
namespace benchmark {

using Kernel = Exact_predicates_inexact_constructions_kernel;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_range = std::vector<Point_with_normal>;
using Regions = std::vector<std::vector<std::size_t>>; // positions in the range

namespace on_points = Shape_detection::Point_set;

// An item stands for a point: its position, or, from 5.6 on, an iterator.
#ifdef CGAL_TANDEM_HAS_ITEMS_IN_REGION_GROWING
using Item = Point_range::const_iterator;

// What an item refers to.
template <class Value, Value Point_with_normal::*member>
struct Item_map {
  using key_type = Item;
  using value_type = Value;
  using reference = const Value&;
  using category = boost::lvalue_property_map_tag;
  friend reference get(const Item_map&, const Item& item) { return (*item).*member; }
};
using Point_map = Item_map<Kernel::Point_3, &Point_with_normal::first>;
using Normal_map = Item_map<Kernel::Vector_3, &Point_with_normal::second>;
using Neighbor_query = on_points::K_neighbor_query<Kernel, Item, Point_map>;

inline std::size_t position(const Point_range& range, Item item) { return std::size_t(item - range.begin()); }
inline Item item_at(const Point_range& range, std::size_t position) { return range.begin() + std::ptrdiff_t(position); }

inline Neighbor_query make_neighbor_query(const Point_range& range, unsigned k)
{
  return Neighbor_query(range, parameters::k_neighbors(k).point_map(Point_map()));
}
#else
using Item = std::size_t;
using Point_map = First_of_pair_property_map<Point_with_normal>;
using Normal_map = Second_of_pair_property_map<Point_with_normal>;
using Neighbor_query = on_points::K_neighbor_query<Kernel, Point_range, Point_map>;

inline std::size_t position(const Point_range&, Item item) { return item; }
inline Item item_at(const Point_range&, std::size_t position) { return position; }

inline Neighbor_query make_neighbor_query(const Point_range& range, unsigned k) { return Neighbor_query(range, k); }
#endif

// Each neighborhood computed once: a stronger peer than users have.
class Cached_neighbors {
public:
  Cached_neighbors(const Point_range& range, const Neighbor_query& query, unsigned k)
    : range_(range), k_(k), rows_(range.size() * k)
  {
    std::vector<Item> row;
    for(std::size_t i = 0; i < range.size(); ++i) {
      row.clear();
      query(item_at(range, i), row);
      row.resize(k, item_at(range, i));
      for(std::size_t j = 0; j < k; ++j)
        rows_[i * k + j] = std::uint32_t(position(range, row[j]));
    }
  }

  void operator()(Item item, std::vector<Item>& neighbors) const
  {
    neighbors.clear();
    const std::size_t first = position(range_, item) * k_;
    for(std::size_t j = first; j < first + k_; ++j)
      neighbors.push_back(item_at(range_, rows_[j]));
  }

private:
  const Point_range& range_;
  std::size_t k_;
  std::vector<std::uint32_t> rows_;
};

template <class Neighbors>
Regions grow_regions(const Point_range& range, Neighbors& neighbors, const Task& task)
{
#ifdef CGAL_TANDEM_HAS_ITEMS_IN_REGION_GROWING
  using Region = on_points::Least_squares_plane_fit_region<Kernel, Item, Point_map, Normal_map>;
  using Sorting = on_points::Least_squares_plane_fit_sorting<Kernel, Item, Neighbors, Point_map, Normal_map>;
  Sorting sorting(range, neighbors, parameters::point_map(Point_map()).normal_map(Normal_map()));
  sorting.sort();
  Region region(parameters::maximum_distance(task.maximum_distance)
                  .maximum_angle(task.maximum_angle_deg)
                  .minimum_region_size(task.minimum_region_size));
  Shape_detection::Region_growing<Neighbors, Region> growing(range, sorting.ordered(), neighbors, region);
  std::vector<std::pair<Kernel::Plane_3, std::vector<Item>>> found;
  growing.detect(std::back_inserter(found));
  Regions regions;
  for(const auto& shape : found) {
    regions.emplace_back();
    for(const Item& item : shape.second)
      regions.back().push_back(position(range, item));
  }
#else
  using Region = on_points::Least_squares_plane_fit_region<Kernel, Point_range, Point_map, Normal_map>;
  using Sorting = on_points::Least_squares_plane_fit_sorting<Kernel, Point_range, Neighbors, Point_map>;
  Sorting sorting(range, neighbors);
  sorting.sort();
  Region region(range, task.maximum_distance, task.maximum_angle_deg, task.minimum_region_size);
  using Seeds = typename Sorting::Seed_map;
  Shape_detection::Region_growing<Point_range, Neighbors, Region, Seeds> growing(range, neighbors, region,
                                                                                 sorting.seed_map());
  Regions regions;
  growing.detect(std::back_inserter(regions));
#endif
  return regions;
}

inline Regions region_growing(const Point_range& range, const Task& task, bool is_cached)
{
  Neighbor_query query = make_neighbor_query(range, task.k_neighbors);
  if(!is_cached)
    return grow_regions(range, query, task);
  Cached_neighbors cached(range, query, task.k_neighbors);
  return grow_regions(range, cached, task);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_REGION_GROWING_H
